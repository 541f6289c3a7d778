//! Elimination of angles: rotation does not change the length of a vector.

use super::reduce::{Eliminated, Reduction};
use super::term_sum::{TermKey, TermReader, TermSum};
use super::tree::{Exchange, PairValue};
use crate::expr::ExprId;
use std::collections::{BTreeMap, BTreeSet};

impl Reduction<'_> {
    /// The elimination *norm* of an angle that appears in exactly two rows and rotates a known vector in each of them
    /// (the same vector or two different ones). If several angles qualify, the one with the fewest terms in its rows is
    /// taken.
    pub(super) fn norm(
        &mut self,
        rows: &[usize],
        unknowns: &BTreeSet<u32>,
        forms: &BTreeMap<usize, TermSum>,
    ) -> Option<Eliminated> {
        let mut candidates = Vec::new();
        for &k in unknowns {
            let held = |form: &TermSum| self.unknowns(form, unknowns).contains(&k);
            let Some(two) = Self::only_two(rows, forms, held) else { continue };
            let of_rest = two.iter().any(|row| {
                let rest = forms[row].rest.map(|rest| TermSum { rest: Some(rest), ..TermSum::default() });
                rest.is_some_and(|rest| self.unknowns(&rest, unknowns).contains(&k))
            });
            let keys: BTreeSet<&TermKey> =
                two.iter().flat_map(|row| forms[row].terms.keys()).filter(|key| key.contains(k)).collect();
            let mut keys = keys.into_iter();
            if let (Some(key), None, false) = (keys.next(), keys.next(), of_rest)
                && key.powers.is_empty()
            {
                let size: usize = two.iter().map(|row| forms[row].terms.len()).sum();
                candidates.push((size, std::cmp::Reverse(k), two, key.clone()));
            }
        }
        candidates.sort();
        candidates.into_iter().find_map(|(_, std::cmp::Reverse(k), two, key)| {
            let (value, row) = self.without_angle(two.map(|row| &forms[&row]), k, &key, unknowns)?;
            Some(Eliminated { rows: two, coordinate: k, value, row, exchanges: Vec::new() })
        })
    }

    /// For two rows F + M (cos θ, sin θ) = 0, the value of θ and the combination of the rows that does not contain θ.
    fn without_angle(
        &mut self,
        [f, g]: [&TermSum; 2],
        k: u32,
        key: &TermKey,
        unknowns: &BTreeSet<u32>,
    ) -> Option<(PairValue, ExprId)> {
        let zero = self.graph.zero();
        let coefficients = |form: &TermSum| form.terms.get(key).copied().unwrap_or([zero; 2]);
        let ([c1, s1], [c2, s2]) = (coefficients(f), coefficients(g));
        let without = |form: &TermSum| {
            let mut form = form.clone();
            form.terms.remove(key);
            form
        };
        let mut reader = TermReader::new(self.graph, self.memory, unknowns);
        let [f, g] = [without(f), without(g)].map(|form| reader.written(&form));
        let (graph, zero_test) = (&mut *self.graph, &mut self.memory.zero_test);
        let minus_c2 = graph.neg(c2);
        let minus_s1 = graph.neg(s1);
        let turn = key.angle.clone();
        let direct = zero_test.equal(graph, s2, c1) && zero_test.equal(graph, c2, minus_s1);
        let reflected = zero_test.opposite(graph, s2, c1) && zero_test.equal(graph, minus_c2, minus_s1);
        if direct || reflected {
            // M is |s| times a rotation or, if its second row has the opposite sign, |s| times a reflection.
            let g = if reflected { graph.neg(g) } else { g };
            let square = graph.plain_dot([c1, s1], [c1, s1]);
            if zero_test.is_zero(graph, square) {
                return None;
            }
            let (a, b) = (graph.plain_cross([s1, c1], [f, g]), graph.plain_dot([s1, c1], [f, g]));
            // cos = −(C f − S g)/|s|², sin = −(S f + C g)/|s|².
            let (cos, sin) = (a, graph.neg(b));
            // The factor ½ cancels the factor 2 that differentiation of the squares produces.
            let (norm, half) = (graph.plain_dot([f, g], [f, g]), graph.number(0.5));
            let row = graph.sub(norm, square);
            let row = graph.mul(half, row);
            // Where θ contains the angle n times, its entries of Φ_q have the factor n, and |s|² is not the sum of
            // their squares.
            let once = key.angle.iter().any(|&(other, n)| other == k && n.abs() == 1);
            let value =
                PairValue::Angle { turn, cos, sin, size: square, square: once.then_some(square), vectors: None };
            return Some((value, row));
        }
        let det = graph.plain_cross([c1, s1], [c2, s2]);
        if zero_test.is_zero(graph, det) {
            return None;
        }
        // cos = −(S₂ f − S₁ g)/det, sin = −(C₁ g − C₂ f)/det.
        let (a, b) = (graph.plain_cross([s1, s2], [f, g]), graph.plain_cross([f, g], [c1, c2]));
        let norm = graph.plain_dot([a, b], [a, b]);
        let square = graph.square(det);
        let row = graph.sub(norm, square);
        let square = graph.opaque(square);
        let (cos, sin) = (graph.mul(a, det), graph.mul(b, det));
        let vectors = [[c1, s1], [c2, s2]].map(|v| graph.plain_dot(v, v));
        Some((PairValue::Angle { turn, cos, sin, size: square, square: None, vectors: Some(vectors) }, row))
    }

    /// Removes an angle that appears in more than two rows from all but two of them by subtracting multiples of these
    /// two rows; the other rows then describe loops that bypass the angle, and the two rows are combined as in
    /// [`norm`](Self::norm).
    pub(super) fn norm_of_loops(
        &mut self,
        rows: &[usize],
        unknowns: &BTreeSet<u32>,
        forms: &BTreeMap<usize, TermSum>,
    ) -> Option<Eliminated> {
        let mut candidates: Vec<(usize, u32, TermKey, Vec<usize>)> = Vec::new();
        for &k in unknowns {
            let rows_with_k: Vec<usize> =
                rows.iter().copied().filter(|row| self.unknowns(&forms[row], unknowns).contains(&k)).collect();
            let keys: BTreeSet<&TermKey> =
                rows_with_k.iter().flat_map(|row| forms[row].terms.keys()).filter(|key| key.contains(k)).collect();
            let mut keys = keys.into_iter();
            // The combined row of Φ_q is the derivative of a replaced row only up to a factor, and a row with a rest
            // cannot be split into terms.
            let plain = rows_with_k.iter().all(|row| forms[row].rest.is_none() && !self.replaced.contains(row));
            if let (Some(key), None, true) = (keys.next(), keys.next(), plain)
                && key.powers.is_empty()
            {
                candidates.push((rows_with_k.len(), k, key.clone(), rows_with_k));
            }
        }
        candidates.sort_by_key(|(count, k, ..)| (*count, std::cmp::Reverse(*k)));
        candidates.into_iter().find_map(|(_, k, key, rows_with_k)| {
            let two = self.shortest_loop(&rows_with_k, forms, &key)?;
            let (value, row) = self.without_angle(two.map(|row| &forms[&row]), k, &key, unknowns)?;
            let other_rows = rows_with_k.into_iter().filter(|row| !two.contains(row));
            let mut exchanges = Vec::new();
            let mut replaced = Vec::new();
            for other in other_rows {
                let (exchange, row) = self.exchange(other, two, forms, &key, unknowns)?;
                replaced.push((other, row));
                exchanges.push(exchange);
            }
            replaced.into_iter().for_each(|(other, row)| self.rows[other] = row);
            Some(Eliminated { rows: two, coordinate: k, value, row, exchanges })
        })
    }

    /// The two rows with the fewest terms whose coefficient vectors of `key` are linearly independent.
    fn shortest_loop(&mut self, rows: &[usize], forms: &BTreeMap<usize, TermSum>, key: &TermKey) -> Option<[usize; 2]> {
        let pairs = rows.iter().enumerate().flat_map(|(index, &f)| rows[index + 1..].iter().map(move |&g| [f, g]));
        let mut pairs: Vec<(usize, [usize; 2])> =
            pairs.map(|two| (two.iter().map(|row| forms[row].terms.len()).sum(), two)).collect();
        pairs.sort_unstable();
        pairs.into_iter().map(|(_, two)| two).find(|two| {
            let [a, b] = two.map(|row| forms[&row].terms.get(key).copied());
            let (Some(a), Some(b)) = (a, b) else { return false };
            let det = self.graph.plain_cross(a, b);
            !self.memory.zero_test.is_zero(self.graph, det)
        })
    }

    /// The row h − α f − β g, which does not contain `key`, and its factors.
    fn exchange(
        &mut self,
        other: usize,
        two: [usize; 2],
        forms: &BTreeMap<usize, TermSum>,
        key: &TermKey,
        unknowns: &BTreeSet<u32>,
    ) -> Option<(Exchange, ExprId)> {
        let zero = self.graph.zero();
        let [h, f, g] = [other, two[0], two[1]].map(|row| &forms[&row]);
        let [ch, c1, c2] = [h, f, g].map(|form| form.terms.get(key).copied().unwrap_or([zero; 2]));
        let factors = self.factors(ch, [c1, c2]);
        let mut reader = TermReader::new(self.graph, self.memory, unknowns);
        let mut row = h.clone();
        for (factor, form) in factors.into_iter().zip([f, g]) {
            let factor = reader.constant(factor);
            let product = reader.product(&factor, form)?;
            row = reader.sum(&row, &product, -1.0)?;
        }
        row.terms.remove(key);
        let row = reader.clean(row);
        let row = reader.written(&row);
        Some((Exchange { row: other, factors }, row))
    }

    /// The factors α and β with α a + β b = h.
    fn factors(&mut self, h: [ExprId; 2], [a, b]: [[ExprId; 2]; 2]) -> [ExprId; 2] {
        let (graph, zero_test) = (&mut *self.graph, &mut self.memory.zero_test);
        let (zero, one) = (graph.zero(), graph.number(1.0));
        let minus_one = graph.number(-1.0);
        // In most cases the loops share a joint of the rotating body, so that h is ±a or ±b.
        for (factor, test) in [(one, true), (minus_one, false)] {
            for (index, vector) in [a, b].into_iter().enumerate() {
                let same = (0..2).all(|k| match test {
                    true => zero_test.equal(graph, h[k], vector[k]),
                    false => zero_test.opposite(graph, h[k], vector[k]),
                });
                if same {
                    return if index == 0 { [factor, zero] } else { [zero, factor] };
                }
            }
        }
        let det = graph.plain_cross(a, b);
        let (alpha, beta) = (graph.plain_cross(h, b), graph.plain_cross(a, h));
        [graph.div(alpha, det), graph.div(beta, det)]
    }
}
