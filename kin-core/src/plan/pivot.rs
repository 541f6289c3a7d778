//! The elimination of coordinates that are linear in a row with a constant coefficient.

use super::form::{Form, Key, Reader};
use super::recognise::recognise;
use super::reduce::Reduction;
use crate::expr::{ExprId, Node};
use std::collections::{BTreeMap, BTreeSet};

impl Reduction<'_> {
    /// The next pivot: a coefficient of ±1 is preferred to other numbers, numbers to parameters and products of
    /// parameters, and these to sums, which may be 0; among coefficients of the same rank the row with the fewest
    /// unknowns is taken, which keeps the loops short.
    pub(super) fn pivot(
        &mut self,
        rows: &[usize],
        unknowns: &BTreeSet<u32>,
        forms: &BTreeMap<usize, Form>,
    ) -> Option<(usize, u32)> {
        let mut best = None;
        for &row in rows {
            let form = &forms[&row];
            let of_rest = form.rest.map_or_else(BTreeSet::new, |rest| {
                self.unknowns(&Form { rest: Some(rest), ..Form::default() }, unknowns)
            });
            let own = self.unknowns(form, unknowns);
            let closes = self.closes_with_another((row, &own), rows, unknowns, forms);
            for (key, [coefficient, _]) in &form.terms {
                let &[(coordinate, 1)] = key.powers.as_slice() else { continue };
                let alone = key.turn.is_empty()
                    && !of_rest.contains(&coordinate)
                    && form.terms.keys().filter(|other| other.holds(coordinate)).count() == 1;
                let rank = match self.graph.literal(*coefficient) {
                    Some(value) if value.abs() == 1.0 => 0,
                    Some(_) => 1,
                    None if !closes && self.graph.depends(*coefficient).is_static() => {
                        2 + u8::from(self.is_sum(*coefficient))
                    }
                    None => continue,
                };
                let score = (rank, own.len(), row, coordinate);
                if alone && best.is_none_or(|other| score < other) {
                    best = Some(score);
                }
            }
        }
        best.map(|(_, _, row, coordinate)| (row, coordinate))
    }

    /// True for a row a x + b y = c, whose unknowns are `own`, that has a closed form together with another row in x and y: such a form holds for all
    /// a and b (the direction of a guide, given by parameters), while a pivot fails where its coefficient is 0.
    fn closes_with_another(
        &mut self,
        (row, own): (usize, &BTreeSet<u32>),
        rows: &[usize],
        unknowns: &BTreeSet<u32>,
        forms: &BTreeMap<usize, Form>,
    ) -> bool {
        let coefficient = |k: &u32| forms[&row].terms.get(&Key::power(*k, 1)).map(|&[coefficient, _]| coefficient);
        let is_open = |id: ExprId| self.graph.literal(id).is_none() && self.graph.depends(id).is_static();
        if own.len() != 2 || !own.iter().all(|k| coefficient(k).is_some_and(is_open)) {
            return false;
        }
        let others = rows.iter().filter(|&&other| other != row && self.unknowns(&forms[&other], unknowns) == *own);
        let others: Vec<usize> = others.copied().collect();
        let mut closes =
            |other| recognise(&mut Reader::new(self.graph, self.memory, own), &[row, other], forms).is_some();
        others.into_iter().any(&mut closes)
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
    pub(super) fn solved_for(&mut self, form: &Form, coordinate: u32) -> ExprId {
        let key = Key::power(coordinate, 1);
        let coefficient = form.terms[&key][0];
        let mut others = form.clone();
        others.terms.remove(&key);
        let nothing = BTreeSet::new();
        let rest = Reader::new(self.graph, self.memory, &nothing).written(&others);
        let minus = self.graph.neg(rest);
        self.graph.div(minus, coefficient)
    }
}
