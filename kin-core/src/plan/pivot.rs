//! The elimination of coordinates that are linear in a row with a constant coefficient.
//!
//! A row a x + b y + … = 0 whose coefficients of the two coordinates of an origin are parameters is that of a guide
//! with a direction given by parameters. Either coefficient may be 0, so that a pivot would fail for some directions.
//! Such a row is left for a closed form with another row in x and y, which holds for all directions, or in an iteration
//! (see `with_guides`).

use super::minors;
use super::recognise::recognise;
use super::reduce::Reduction;
use super::term_sum::{TermKey, TermReader, TermSum};
use super::tree::{Block, Core, SolutionMethod};
use crate::expr::{ExprId, Node};
use std::collections::{BTreeMap, BTreeSet};

impl Reduction<'_> {
    /// Reduces a block of the mechanism (see [`block`](Self::block)). Rows of guides are left if this needs as many
    /// iterations as their elimination does, none of them too large for Cramer's rule: such systems are eliminated in a
    /// fixed order, which divides by one component of a guide, too.
    pub(super) fn with_guides(
        &mut self,
        rows: &[usize],
        unknowns: &BTreeSet<u32>,
        removable: &[usize],
    ) -> Option<Block> {
        let state = |reduction: &mut Self| {
            (
                reduction.rows.clone(),
                reduction.source_rows.clone(),
                reduction.replaced.clone(),
                reduction.paired.clone(),
            )
        };
        let restore = |reduction: &mut Self, state| {
            (reduction.rows, reduction.source_rows, reduction.replaced, reduction.paired) = state
        };
        let iterations = |block: &Option<Block>| {
            let is_iterated = |core: &Core| usize::from(matches!(core.method, SolutionMethod::Newton { .. }));
            block.as_ref().map_or(usize::MAX, |block| block.sum(&is_iterated))
        };
        let state_before = state(self);
        (self.guides.skipped, self.guides.found) = (true, false);
        let iterated = self.block(rows, unknowns, removable);
        if !self.guides.found || iterations(&iterated) == 0 {
            return iterated;
        }
        let state_after = state(self);
        restore(self, state_before);
        self.guides.skipped = false;
        let eliminated = self.block(rows, unknowns, removable);
        let too_large = |core: &Core| usize::from(self.is_too_large(core));
        let is_too_large = iterated.as_ref().is_none_or(|block| block.sum(&too_large) > 0);
        if iterations(&eliminated) < iterations(&iterated) || is_too_large {
            return eliminated;
        }
        restore(self, state_after);
        iterated
    }

    /// True for an iteration that is too large for Cramer's rule.
    fn is_too_large(&self, core: &Core) -> bool {
        let SolutionMethod::Newton { residuals } = &core.method else { return false };
        let all = core.coordinates.iter().copied().collect();
        let held =
            residuals.iter().map(|&rest| self.unknowns(&TermSum { rest: Some(rest), ..TermSum::default() }, &all));
        let filled = held.map(|held| core.coordinates.iter().map(|k| held.contains(k)).collect());
        !minors::are_few(&filled.collect::<Vec<_>>())
    }

    /// The next pivot: a coefficient of ±1 is preferred to other numbers, numbers to parameters and products of
    /// parameters, and these to sums, which may be 0; among coefficients of the same rank the row with the fewest
    /// unknowns is taken, which keeps the loops short.
    pub(super) fn pivot(
        &mut self,
        rows: &[usize],
        unknowns: &BTreeSet<u32>,
        forms: &BTreeMap<usize, TermSum>,
    ) -> Option<(usize, u32)> {
        let mut best = None;
        for &row in rows {
            let form = &forms[&row];
            let of_rest = form.rest.map_or_else(BTreeSet::new, |rest| {
                self.unknowns(&TermSum { rest: Some(rest), ..TermSum::default() }, unknowns)
            });
            let row_unknowns = self.unknowns(form, unknowns);
            let guides = self.is_guide(form, unknowns);
            self.guides.found |= guides;
            let is_excluded =
                guides && self.guides.skipped || self.closes_with_another((row, &row_unknowns), rows, unknowns, forms);
            for (key, [coefficient, _]) in &form.terms {
                let &[(coordinate, 1)] = key.powers.as_slice() else { continue };
                let alone = key.angle.is_empty()
                    && !of_rest.contains(&coordinate)
                    && form.terms.keys().filter(|other| other.contains(coordinate)).count() == 1;
                let rank = match self.graph.literal(*coefficient) {
                    Some(value) if value.abs() == 1.0 => 0,
                    Some(_) => 1,
                    None if !is_excluded && self.graph.depends(*coefficient).is_static() => {
                        2 + u8::from(self.is_sum(*coefficient))
                    }
                    None => continue,
                };
                let score = (rank, row_unknowns.len(), row, coordinate);
                if alone && best.is_none_or(|other| score < other) {
                    best = Some(score);
                }
            }
        }
        best.map(|(_, _, row, coordinate)| (row, coordinate))
    }

    /// True for a row a x + b y + …, where x and y are unknown coordinates of one origin and a and b are parameters.
    fn is_guide(&self, form: &TermSum, unknowns: &BTreeSet<u32>) -> bool {
        let open = |k: u32| unknowns.contains(&k) && self.coefficient(form, k).is_some_and(|id| self.is_open(id));
        self.guides.origins.iter().any(|origin| origin.iter().all(|&k| open(k)))
    }

    /// The coefficient of a coordinate to the first power.
    fn coefficient(&self, form: &TermSum, coordinate: u32) -> Option<ExprId> {
        form.terms.get(&TermKey::power(coordinate, 1)).map(|&[coefficient, _]| coefficient)
    }

    /// True if a coefficient depends on parameters alone.
    fn is_open(&self, coefficient: ExprId) -> bool {
        self.graph.literal(coefficient).is_none() && self.graph.depends(coefficient).is_static()
    }

    /// True for a row a x + b y = c, whose unknowns are `row_unknowns`, that has a closed form together with another
    /// row in x and y.
    fn closes_with_another(
        &mut self,
        (row, row_unknowns): (usize, &BTreeSet<u32>),
        rows: &[usize],
        unknowns: &BTreeSet<u32>,
        forms: &BTreeMap<usize, TermSum>,
    ) -> bool {
        let is_open = |&k: &u32| self.coefficient(&forms[&row], k).is_some_and(|id| self.is_open(id));
        if row_unknowns.len() != 2 || !row_unknowns.iter().all(is_open) {
            return false;
        }
        let partners =
            rows.iter().filter(|&&other| other != row && self.unknowns(&forms[&other], unknowns) == *row_unknowns);
        let partners: Vec<usize> = partners.copied().collect();
        let mut closes = |other| {
            recognise(&mut TermReader::new(self.graph, self.memory, row_unknowns), &[row, other], forms).is_some()
        };
        partners.into_iter().any(&mut closes)
    }

    /// True if a factor is a sum or difference, which may be 0 although none of its terms is (r₁ − r₂ for equal
    /// pulleys).
    fn is_sum(&self, id: ExprId) -> bool {
        match self.graph.node(id) {
            Node::Neg(a) | Node::Opaque(a) => self.is_sum(a),
            Node::Mul(a, b) | Node::Div(a, b) => self.is_sum(a) || self.is_sum(b),
            Node::Add(..) | Node::Sub(..) => true,
            _ => false,
        }
    }

    /// The value of a coordinate from a row in which it is linear.
    pub(super) fn solved_for(&mut self, form: &TermSum, coordinate: u32) -> ExprId {
        let key = TermKey::power(coordinate, 1);
        let coefficient = form.terms[&key][0];
        let mut other_terms = form.clone();
        other_terms.terms.remove(&key);
        let nothing = BTreeSet::new();
        let rest = TermReader::new(self.graph, self.memory, &nothing).written(&other_terms);
        let minus = self.graph.neg(rest);
        self.graph.div(minus, coefficient)
    }
}
