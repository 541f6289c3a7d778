//! Reduces a block of rows to parts that must be solved together.
//!
//! Three eliminations are exact in every configuration. Pivots are eliminated first, as long as there is one; the other
//! two are applied to a block that has no closed form (see the end), the ratio before the norm. A single row in one angle
//! is solved together with a redundant row that rotates the same vector, if there is one (`paired`):
//!
//! - *pivot*: a coordinate that is linear in a row with a constant coefficient (origins of pinned bodies, angles of
//!   sliders and gears). The row determines the coordinate, which is eliminated from all other rows. Rows of guides
//!   whose direction is given by parameters are left where they can be (see `pivot`).
//! - *ratio*: an unknown x that is linear in two rows, f₁x + f₀ = 0 and g₁x + g₀ = 0, and appears in no other row. The
//!   combination f₁g₀ − g₁f₀ = 0 does not contain x, and x = −(f₁f₀ + g₁g₀)/(f₁² + g₁²) (the stroke along a turning
//!   guide).
//! - *norm*: an angle θ that rotates a known vector s in two rows, F + A(θ)s = 0, and appears in no other row. The
//!   combination |F|² = |s|² does not contain θ, and A(θ)s = −F determines θ uniquely (a link between two pins
//!   prescribes their distance). If the angle occurs in several loops, it is first removed from all but one of them
//!   (see `angles`).
//!
//! After each elimination the remaining rows are again split into blocks. A block of one row in one angle,
//! a cos φ + b sin φ = c, has two solutions, which are distinguished by a sign; so does a quadratic equation or the
//! intersection of a circle with a line or a circle. A block that has no such closed form is solved by Newton's
//! iteration on its unknowns.

use super::guides::Guides;
use super::matching::blocks;
use super::recognise::recognise;
use super::rewrite::{Substitution, rewrite};
use super::term_sum::{ReaderCache, TermKey, TermReader, TermSum};
use super::tree::{Block, BlockPart, Core, Exchange, Pair, PairValue, Pivot, SolutionMethod};
use crate::expr::{ExprId, Graph, IdMap, Node, Symbol};
use std::collections::{BTreeMap, BTreeSet};

/// The rows during the reduction.
pub(super) struct Reduction<'a> {
    pub(super) graph: &'a mut Graph,
    pub(super) memory: &'a mut ReaderCache,
    /// The current expression of every row.
    pub(super) rows: Vec<ExprId>,
    /// For each row, the original rows that it has been combined from.
    pub(super) source_rows: Vec<BTreeSet<usize>>,
    /// Rows that have been replaced by the combined row of a pair. The combined row of Φ_q (see `rates`) is the
    /// derivative of such a row only up to a factor.
    pub(super) replaced: BTreeSet<usize>,
    /// Cache of the substitution in progress: the rewritten form of each expression.
    pub(super) rewritten: IdMap<ExprId>,
    /// Pairs of a kept row and a redundant row.
    pub(super) paired: Vec<PairedRows>,
    /// The rows of guides whose direction is given by parameters.
    pub(super) guides: Guides,
}

/// Two rows F + A(θ)s = 0, one of them redundant, in which θ rotates the same known vector s. Together they determine θ
/// uniquely; they are consistent if |F| = |s|.
#[derive(Clone, Copy, Debug)]
pub(super) struct PairedRows {
    /// The kept row and the redundant one.
    pub(super) rows: [usize; 2],
    /// The difference (|F|² − |s|²)/2.
    pub(super) difference: ExprId,
    /// The squared length |s|².
    pub(super) square: ExprId,
}

/// An unknown that two rows contain, its value, and the combination of the rows that does not contain it.
pub(super) struct Eliminated {
    pub(super) rows: [usize; 2],
    pub(super) coordinate: u32,
    pub(super) value: PairValue,
    pub(super) row: ExprId,
    /// How the unknown is removed from other rows.
    pub(super) exchanges: Vec<Exchange>,
}

/// Substitutes a value for a coordinate.
struct Replaced {
    coordinate: u32,
    value: ExprId,
}

impl Substitution for Replaced {
    fn symbol(&mut self, _graph: &mut Graph, symbol: Symbol) -> Option<ExprId> {
        (symbol == Symbol::Coordinate(self.coordinate)).then_some(self.value)
    }
}

impl Reduction<'_> {
    /// Reduces `rows` over `unknowns`; `None` if the rows do not determine them. `removable` lists redundant rows that
    /// may be used in addition; the coordinates of other blocks count as known in them.
    pub(super) fn block(&mut self, rows: &[usize], unknowns: &BTreeSet<u32>, removable: &[usize]) -> Option<Block> {
        let (mut rows, mut unknowns) = (rows.to_vec(), unknowns.clone());
        let mut out = Block::default();
        let mut forms: BTreeMap<usize, TermSum> = rows.iter().map(|&row| (row, self.form(row, &unknowns))).collect();
        while let Some((row, coordinate)) = self.pivot(&rows, &unknowns, &forms) {
            let form = forms.remove(&row)?;
            let coefficient = form.terms[&TermKey::power(coordinate, 1)][0];
            let value = self.solved_for(&form, coordinate);
            rows.retain(|&other| other != row);
            unknowns.remove(&coordinate);
            self.rewritten.clear();
            for &other in rows.iter().chain(removable) {
                // A coordinate that cancels out of a row has already been removed from the expression of the row.
                let holds = match forms.get(&other) {
                    Some(form) => self.has(form, coordinate),
                    None => !self.written(other, &BTreeSet::from([coordinate])).is_empty(),
                };
                if holds {
                    let mut replaced = Replaced { coordinate, value };
                    self.rows[other] = rewrite(self.graph, self.rows[other], &mut self.rewritten, &mut replaced);
                    let sources = self.source_rows[row].clone();
                    self.source_rows[other].extend(sources);
                    if rows.contains(&other) {
                        let form = self.form(other, &unknowns);
                        forms.insert(other, form);
                    }
                }
            }
            out.pivots.push(Pivot { row, coordinate, coefficient, value });
        }
        let indices: Vec<u32> = unknowns.iter().copied().collect();
        let held: Vec<Vec<usize>> = rows
            .iter()
            .map(|row| {
                let found = self.unknowns(&forms[row], &unknowns);
                found.iter().filter_map(|k| indices.binary_search(k).ok()).collect()
            })
            .collect();
        let mut removable: Vec<(usize, BTreeSet<u32>)> =
            removable.iter().map(|&row| (row, self.written(row, &unknowns))).collect();
        for (part_rows, part_unknowns) in blocks(&held, indices.len()).ok()? {
            let part_rows: Vec<usize> = part_rows.into_iter().map(|index| rows[index]).collect();
            let part_unknowns: BTreeSet<u32> = part_unknowns.into_iter().map(|index| indices[index]).collect();
            // A redundant row is used in the part that solves for the last of its unknowns.
            removable.iter_mut().for_each(|(_, open)| open.retain(|k| !part_unknowns.contains(k)));
            let known = removable
                .iter()
                .filter(|(row, open)| open.is_empty() && !self.written(*row, &part_unknowns).is_empty());
            let known: Vec<usize> = known.map(|(row, _)| *row).collect();
            out.parts.push(self.part(&part_rows, &part_unknowns, &known)?);
        }
        Some(out)
    }

    fn part(&mut self, rows: &[usize], unknowns: &BTreeSet<u32>, removable: &[usize]) -> Option<BlockPart> {
        if let Some(pair) = removable.iter().find_map(|&removable| self.paired(rows, removable, unknowns)) {
            return Some(BlockPart::Pair(Box::new(pair)));
        }
        // The unknowns of other parts count as known here.
        let forms: BTreeMap<usize, TermSum> = rows.iter().map(|&row| (row, self.form(row, unknowns))).collect();
        let method = recognise(&mut TermReader::new(self.graph, self.memory, unknowns), rows, &forms);
        let pair = match &method {
            Some(_) => None,
            None => (self.ratio(rows, unknowns, &forms))
                .or_else(|| self.norm(rows, unknowns, &forms))
                .or_else(|| self.norm_of_loops(rows, unknowns, &forms)),
        };
        let Some(Eliminated { rows: pair_rows, coordinate, value, row, exchanges }) = pair else {
            let method = method.unwrap_or_else(|| SolutionMethod::Newton {
                residuals: rows.iter().map(|&row| self.rows[row]).collect(),
            });
            return Some(BlockPart::Core(Core {
                rows: rows.to_vec(),
                coordinates: unknowns.iter().copied().collect(),
                method,
            }));
        };
        let [first, second] = pair_rows;
        for exchange in &exchanges {
            let sources: Vec<usize> = pair_rows.iter().flat_map(|&row| self.source_rows[row].iter().copied()).collect();
            self.source_rows[exchange.row].extend(sources);
        }
        let replaced = pair_rows.iter().any(|row| self.replaced.contains(row));
        let value = match value {
            // The combined row of Φ_q is the derivative of a replaced row only up to a factor, so that `square` cannot
            // be reused for the rates.
            PairValue::Angle { turn, cos, sin, size, vectors, .. } if replaced => {
                PairValue::Angle { turn, cos, sin, size, square: None, vectors }
            }
            PairValue::Linear { value, by, .. } if replaced => PairValue::Linear { value, by, square: None },
            other => other,
        };
        self.replaced.insert(first);
        self.rows[first] = row;
        let sources = self.source_rows[second].clone();
        self.source_rows[first].extend(sources);
        let rest: Vec<usize> = rows.iter().copied().filter(|&other| other != second).collect();
        let mut unknowns = unknowns.clone();
        unknowns.remove(&coordinate);
        let free = |&row: &usize| self.written(row, &BTreeSet::from([coordinate])).is_empty();
        let removable: Vec<usize> = removable.iter().copied().filter(free).collect();
        let inner = self.block(&rest, &unknowns, &removable)?;
        Some(BlockPart::Pair(Box::new(Pair { rows: pair_rows, coordinate, value, exchanges, inner })))
    }

    /// The form of a row. Unknowns that cancel out are also removed from the row's expression, because they may not be
    /// known yet when the row is evaluated.
    pub(super) fn form(&mut self, row: usize, unknowns: &BTreeSet<u32>) -> TermSum {
        loop {
            let (form, written) = TermReader::new(self.graph, self.memory, unknowns).read(self.rows[row]);
            let remaining = self.unknowns(&form, unknowns);
            if written.is_subset(&remaining) {
                return form;
            }
            for &coordinate in written.difference(&remaining) {
                let mut replaced = Replaced { coordinate, value: self.graph.zero() };
                // `self.rewritten` belongs to a substitution in progress, so a fresh cache is used.
                self.rows[row] = rewrite(self.graph, self.rows[row], &mut IdMap::default(), &mut replaced);
            }
        }
    }

    /// True if a form contains a coordinate.
    fn has(&self, form: &TermSum, coordinate: u32) -> bool {
        let in_rest = |rest: ExprId| {
            !self
                .unknowns(&TermSum { rest: Some(rest), ..TermSum::default() }, &BTreeSet::from([coordinate]))
                .is_empty()
        };
        form.terms.keys().any(|key| key.contains(coordinate)) || form.rest.is_some_and(in_rest)
    }

    /// The unknowns that a form contains.
    pub(super) fn unknowns(&self, form: &TermSum, unknowns: &BTreeSet<u32>) -> BTreeSet<u32> {
        form.unknowns(|rest| {
            let nodes = self.graph.reachable([rest]).into_iter().map(|id| self.graph.node(id));
            let found = nodes.filter_map(|node| match node {
                Node::Symbol(Symbol::Coordinate(k)) => Some(k).filter(|k| unknowns.contains(k)),
                _ => None,
            });
            found.collect()
        })
    }

    /// The unknowns that occur in a row's expression, including those that would cancel.
    fn written(&self, row: usize, unknowns: &BTreeSet<u32>) -> BTreeSet<u32> {
        self.unknowns(&TermSum { rest: Some(self.rows[row]), ..TermSum::default() }, unknowns)
    }

    /// Combines a single row in one angle with a redundant row in which the angle rotates the same vector. The two rows
    /// always determine the angle, and no sign has to be chosen.
    fn paired(&mut self, rows: &[usize], removable: usize, unknowns: &BTreeSet<u32>) -> Option<Pair> {
        let &[first] = rows else { return None };
        let rows = [first, removable];
        if unknowns.len() != 1 || rows.iter().any(|row| self.replaced.contains(row)) {
            return None;
        }
        let forms: BTreeMap<usize, TermSum> = rows.iter().map(|&row| (row, self.form(row, unknowns))).collect();
        let Eliminated { rows, coordinate, value, row, exchanges } = self.norm(&rows, unknowns, &forms)?;
        let PairValue::Angle { square: Some(square), .. } = value else { return None };
        self.paired.push(PairedRows { rows, difference: row, square });
        Some(Pair { rows, coordinate, value, exchanges, inner: Block::default() })
    }

    /// The two rows for which `found` holds, if exactly two do.
    pub(super) fn only_two(
        rows: &[usize],
        forms: &BTreeMap<usize, TermSum>,
        found: impl Fn(&TermSum) -> bool,
    ) -> Option<[usize; 2]> {
        let mut matching = rows.iter().copied().filter(|row| found(&forms[row]));
        let two = [matching.next()?, matching.next()?];
        matching.next().is_none().then_some(two)
    }

    /// The value of an expression, if it is the same in all configurations (the length of a turning direction, for
    /// example).
    fn constant(&mut self, id: ExprId) -> Option<ExprId> {
        let nodes = self.graph.reachable([id]).into_iter().map(|id| self.graph.node(id));
        let coordinates = nodes.filter_map(|node| match node {
            Node::Symbol(Symbol::Coordinate(k)) => Some(k),
            _ => None,
        });
        let coordinates: BTreeSet<u32> = coordinates.collect();
        let (form, _) = TermReader::new(self.graph, self.memory, &coordinates).read(id);
        let [value, _] = *form.terms.get(&TermKey::default())?;
        let alone = form.rest.is_none() && form.terms.len() == 1;
        (alone && self.graph.depends(value).is_static()).then_some(value)
    }

    /// The elimination *ratio*: an unknown that is linear in two rows and appears in no other.
    fn ratio(
        &mut self,
        rows: &[usize],
        unknowns: &BTreeSet<u32>,
        forms: &BTreeMap<usize, TermSum>,
    ) -> Option<Eliminated> {
        if forms.values().any(|form| form.rest.is_some()) {
            return None;
        }
        for &k in unknowns {
            let Some(two) = Self::only_two(rows, forms, |form| form.terms.keys().any(|key| key.contains(k))) else {
                continue;
            };
            let linear =
                |key: &TermKey| !key.turns(k) && key.powers.iter().all(|&(other, power)| other != k || power == 1);
            if !two.iter().all(|row| forms[row].terms.keys().all(linear)) {
                continue;
            }
            let [f, g] = two.map(|row| split(&forms[&row], k));
            let mut reader = TermReader::new(self.graph, self.memory, unknowns);
            let product = |reader: &mut TermReader<'_>, a: &TermSum, b: &TermSum| reader.product(a, b);
            let (Some(a), Some(b)) = (product(&mut reader, &f.0, &g.1), product(&mut reader, &g.0, &f.1)) else {
                continue;
            };
            let Some(row) = reader.sum(&a, &b, -1.0) else { continue };
            let row = reader.clean(row);
            if row.terms.keys().all(|key| key.powers.is_empty() && key.angle.is_empty()) {
                continue;
            }
            let [f1, f0, g1, g0] = [&f.0, &f.1, &g.0, &g.1].map(|form| reader.written(form));
            let row = reader.written(&row);
            let (top, bottom) = (self.graph.plain_dot([f1, g1], [f0, g0]), self.graph.plain_dot([f1, g1], [f1, g1]));
            let square = self.constant(bottom);
            let quotient = self.graph.div(top, square.unwrap_or(bottom));
            let value = PairValue::Linear { value: self.graph.neg(quotient), by: [f1, g1], square };
            return Some(Eliminated { rows: two, coordinate: k, value, row, exchanges: Vec::new() });
        }
        None
    }
}

/// The coefficients f₁ and f₀ of f₁ x + f₀.
fn split(form: &TermSum, x: u32) -> (TermSum, TermSum) {
    let (mut with, mut without) = (TermSum::default(), TermSum::default());
    for (key, pair) in &form.terms {
        if key.powers.iter().any(|&(k, _)| k == x) {
            let powers = key.powers.iter().copied().filter(|&(k, _)| k != x).collect();
            with.terms.insert(TermKey { powers, angle: key.angle.clone() }, *pair);
        } else {
            without.terms.insert(key.clone(), *pair);
        }
    }
    (with, without)
}

impl TermKey {
    /// True if the key contains an unknown.
    pub(super) fn contains(&self, unknown: u32) -> bool {
        self.turns(unknown) || self.powers.iter().any(|&(k, _)| k == unknown)
    }

    /// True if an unknown is one of the key's angles.
    pub(super) fn turns(&self, unknown: u32) -> bool {
        self.angle.iter().any(|&(k, _)| k == unknown)
    }
}
