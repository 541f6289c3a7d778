//! Rows as sums of terms in their unknowns. Closed-form solutions are recognised in this form.
//!
//! ```text
//! f = Σ_m Σ_θ m (C cos θ + S sin θ) + rest
//! ```
//!
//! The m are products of powers of unknowns, the θ are sums of integer multiples of unknown angles, and C and S are
//! expressions without unknowns. Everything else (a supplied function of an unknown, for example) is the rest.
//! Coefficients that are identically zero are found by [`ZeroTest`] and removed, so that, for example, |A(φ)s|²
//! contains no φ.

use super::zero::ZeroTest;
use crate::expr::{ExprId, Graph, IdMap, Node, ROUNDING, Symbol};
use crate::structure::turn::terms;
use crate::vocabulary::Function;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Maximum number of terms of an expression; a longer one becomes part of the rest.
const MAX_TERMS: usize = 64;

/// The key of a term: a product of unknowns (index of q, power) and a sum of multiples of unknown angles (index of q,
/// multiple), the first multiple being positive.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct TermKey {
    pub(super) powers: Vec<(u32, u8)>,
    pub(super) angle: Vec<(u32, i32)>,
}

impl TermKey {
    /// All unknowns of the key.
    fn unknowns(&self) -> impl Iterator<Item = u32> + '_ {
        self.powers.iter().map(|(k, _)| *k).chain(self.angle.iter().map(|(k, _)| *k))
    }
}

/// An angle θ with its coefficients [C, S].
type OfAngle<'t> = (&'t [(u32, i32)], [ExprId; 2]);

/// A row as a sum of terms.
#[derive(Clone, Debug, Default)]
pub(super) struct TermSum {
    /// The coefficients [C, S] of every key.
    pub(super) terms: BTreeMap<TermKey, [ExprId; 2]>,
    /// The part of the row that is not a sum of such terms.
    pub(super) rest: Option<ExprId>,
}

/// Cached results of readers with the same set of unknowns, and the zero test for coefficients.
pub(super) struct ReaderCache {
    pub(super) zero_test: ZeroTest,
    unknowns: BTreeSet<u32>,
    holds: IdMap<bool>,
    read: IdMap<Rc<TermSum>>,
}

impl ReaderCache {
    /// An empty cache for expressions over the given number of coordinates.
    pub(super) fn new(coordinates: usize) -> Self {
        let (unknowns, holds, read) = (BTreeSet::new(), IdMap::default(), IdMap::default());
        Self { zero_test: ZeroTest::new(coordinates), unknowns, holds, read }
    }
}

/// Converts expressions to forms.
pub(super) struct TermReader<'a> {
    pub(super) graph: &'a mut Graph,
    pub(super) memory: &'a mut ReaderCache,
    unknowns: &'a BTreeSet<u32>,
}

impl<'a> TermReader<'a> {
    pub(super) fn new(graph: &'a mut Graph, memory: &'a mut ReaderCache, unknowns: &'a BTreeSet<u32>) -> Self {
        if memory.unknowns != *unknowns {
            memory.unknowns.clone_from(unknowns);
            memory.holds.clear();
            memory.read.clear();
        }
        Self { graph, memory, unknowns }
    }

    /// The coordinates that are solved for; all other coordinates count as known.
    pub(super) fn unknowns(&self) -> &'a BTreeSet<u32> {
        self.unknowns
    }

    /// True if the expression `id` contains an unknown.
    pub(super) fn contains_unknown(&mut self, id: ExprId) -> bool {
        if !self.memory.holds.contains(id) {
            let order = self.graph.reachable([id]);
            self.find(&order);
        }
        self.known_to_hold(id)
    }

    fn known_to_hold(&self, id: ExprId) -> bool {
        self.memory.holds.or(id, false)
    }

    /// Records for each expression in `order` (operands first) whether it contains an unknown.
    fn find(&mut self, order: &[ExprId]) {
        let holds = &mut self.memory.holds;
        for &id in order {
            if !holds.contains(id) {
                let node = self.graph.node(id);
                let mut found = matches!(node, Node::Symbol(Symbol::Coordinate(k)) if self.unknowns.contains(&k));
                node.for_each_operand(|operand| found |= holds.or(operand, false));
                holds.insert(id, found);
            }
        }
    }

    /// The form of a row, and the unknowns that occur in its expression.
    pub(super) fn read(&mut self, id: ExprId) -> (TermSum, BTreeSet<u32>) {
        let order = self.graph.reachable([id]);
        self.find(&order);
        let mut written = BTreeSet::new();
        for id in order {
            if !self.known_to_hold(id) {
                continue;
            }
            if let Node::Symbol(Symbol::Coordinate(k)) = self.graph.node(id) {
                written.insert(k);
            }
            if !self.memory.read.contains(id) {
                let form = self.node(id).unwrap_or_else(|| TermSum { rest: Some(id), ..TermSum::default() });
                self.memory.read.insert(id, Rc::new(form));
            }
        }
        let form = self.known_form(id);
        let form = Rc::try_unwrap(form).unwrap_or_else(|shared| (*shared).clone());
        (self.clean(form), written)
    }

    /// Removes coefficients that are identically zero.
    pub(super) fn clean(&mut self, mut form: TermSum) -> TermSum {
        let zero = self.graph.zero();
        form.terms.retain(|_, pair| {
            for coefficient in pair.iter_mut() {
                if self.memory.zero_test.is_zero(self.graph, *coefficient) {
                    *coefficient = zero;
                }
            }
            pair.iter().any(|coefficient| *coefficient != zero)
        });
        form
    }

    fn known_form(&mut self, id: ExprId) -> Rc<TermSum> {
        match self.memory.read.get(id) {
            Some(form) => Rc::clone(form),
            None => Rc::new(self.constant(id)),
        }
    }

    pub(super) fn constant(&mut self, id: ExprId) -> TermSum {
        let zero = self.graph.zero();
        if id == zero {
            return TermSum::default();
        }
        TermSum { terms: BTreeMap::from([(TermKey::default(), [id, zero])]), rest: None }
    }

    fn node(&mut self, id: ExprId) -> Option<TermSum> {
        let form = match self.graph.node(id) {
            Node::Symbol(Symbol::Coordinate(k)) => {
                let (one, zero) = (self.graph.number(1.0), self.graph.zero());
                let key = TermKey { powers: vec![(k, 1)], angle: Vec::new() };
                TermSum { terms: BTreeMap::from([(key, [one, zero])]), rest: None }
            }
            Node::Neg(a) => {
                let a = self.known_form(a);
                self.scaled(&a, -1.0)?
            }
            Node::Add(a, b) => {
                let (a, b) = (self.known_form(a), self.known_form(b));
                self.sum(&a, &b, 1.0)?
            }
            Node::Sub(a, b) => {
                let (a, b) = (self.known_form(a), self.known_form(b));
                self.sum(&a, &b, -1.0)?
            }
            Node::Mul(a, b) => {
                let (a, b) = (self.known_form(a), self.known_form(b));
                self.product(&a, &b)?
            }
            Node::Div(a, b) if !self.known_to_hold(b) => {
                let one = self.graph.number(1.0);
                let (inverse, a) = (self.graph.div(one, b), self.known_form(a));
                let inverse = self.constant(inverse);
                self.product(&a, &inverse)?
            }
            Node::Powi(a, n @ 2..=4) => {
                let a = self.known_form(a);
                let mut power = (*a).clone();
                for _ in 1..n {
                    power = self.product(&power, &a)?;
                }
                power
            }
            Node::Call(Function::Sin, a) => self.cos_and_sin(a)?[1].clone(),
            Node::Call(Function::Cos, a) => self.cos_and_sin(a)?[0].clone(),
            Node::RotX(r) | Node::RotY(r) => {
                let [cos, sin] = self.cos_and_sin(r.angle)?;
                let (x, y) = (self.known_form(r.x), self.known_form(r.y));
                if matches!(self.graph.node(id), Node::RotX(_)) {
                    let (a, b) = (self.product(&cos, &x)?, self.product(&sin, &y)?);
                    self.sum(&a, &b, -1.0)?
                } else {
                    let (a, b) = (self.product(&sin, &x)?, self.product(&cos, &y)?);
                    self.sum(&a, &b, 1.0)?
                }
            }
            Node::Dot(t) => {
                let [ux, uy, dx, dy] = [t.u[0], t.u[1], t.d[0], t.d[1]].map(|id| self.known_form(id));
                let (a, b) = (self.product(&ux, &dx)?, self.product(&uy, &dy)?);
                self.sum(&a, &b, 1.0)?
            }
            Node::Cross(t) => {
                let [ux, uy, dx, dy] = [t.u[0], t.u[1], t.d[0], t.d[1]].map(|id| self.known_form(id));
                let (a, b) = (self.product(&ux, &dy)?, self.product(&uy, &dx)?);
                self.sum(&a, &b, -1.0)?
            }
            _ => return None,
        };
        let form = self.clean(form);
        (form.terms.len() <= MAX_TERMS).then_some(form)
    }

    /// The forms of cos and sin of an angle that is a sum of integer multiples of unknowns and a known expression;
    /// `None` for any other angle.
    fn cos_and_sin(&mut self, angle: ExprId) -> Option<[TermSum; 2]> {
        let zero = self.graph.zero();
        let (mut multiples, mut known) = (BTreeMap::<u32, i64>::new(), zero);
        for (times, id) in terms(self.graph, angle) {
            match self.graph.node(id) {
                Node::Symbol(Symbol::Coordinate(k)) if self.unknowns.contains(&k) => {
                    *multiples.entry(k).or_default() += times
                }
                _ if self.contains_unknown(id) => return None,
                _ => {
                    let factor = self.graph.number(times as f64);
                    let term = self.graph.mul(factor, id);
                    known = self.graph.add(known, term);
                }
            }
        }
        multiples.retain(|_, times| *times != 0);
        let multiples: Vec<(u32, i32)> = multiples
            .into_iter()
            .map(|(k, times)| Some((k, i16::try_from(times).ok()?.into())))
            .collect::<Option<_>>()?;
        // cos(θ + δ) = cos δ cos θ − sin δ sin θ.
        let (cos, sin) = (self.graph.cos(known), self.graph.sin(known));
        let minus_sin = self.graph.neg(sin);
        Some([self.term(&multiples, [cos, minus_sin]), self.term(&multiples, [sin, cos])])
    }

    /// The term C cos θ + S sin θ, with the sign of θ normalised.
    fn term(&mut self, multiples: &[(u32, i32)], [c, s]: [ExprId; 2]) -> TermSum {
        let zero = self.graph.zero();
        if multiples.is_empty() {
            return self.constant(c);
        }
        let negative = multiples[0].1 < 0;
        let multiples = multiples.iter().map(|&(k, n)| (k, if negative { -n } else { n })).collect();
        let s = if negative { self.graph.neg(s) } else { s };
        let key = TermKey { powers: Vec::new(), angle: multiples };
        let mut form = TermSum::default();
        if c != zero || s != zero {
            form.terms.insert(key, [c, s]);
        }
        form
    }

    fn scaled(&mut self, a: &TermSum, factor: f64) -> Option<TermSum> {
        let nothing = TermSum::default();
        self.sum(&nothing, a, factor)
    }

    /// a + factor · b, where the factor is ±1.
    pub(super) fn sum(&mut self, a: &TermSum, b: &TermSum, factor: f64) -> Option<TermSum> {
        let mut out = a.clone();
        let zero = self.graph.zero();
        for (key, pair) in &b.terms {
            let entry = out.terms.entry(key.clone()).or_insert([zero; 2]);
            for (sum, term) in entry.iter_mut().zip(pair) {
                *sum = plus(self.graph, *sum, *term, factor);
            }
        }
        if let Some(rest) = b.rest {
            let rest_of_a = out.rest.unwrap_or(zero);
            out.rest = Some(plus(self.graph, rest_of_a, rest, factor));
        }
        Some(out)
    }

    /// a · b; `None` if one of the forms has a rest or the product has too many terms or too high powers.
    pub(super) fn product(&mut self, a: &TermSum, b: &TermSum) -> Option<TermSum> {
        if a.rest.is_some() || b.rest.is_some() || a.terms.len() * b.terms.len() > 4 * MAX_TERMS {
            return None;
        }
        let mut out = TermSum::default();
        for (key_a, pair_a) in &a.terms {
            for (key_b, pair_b) in &b.terms {
                let powers = multiplied(&key_a.powers, &key_b.powers)?;
                for part in self.product_of_angles((&key_a.angle, *pair_a), (&key_b.angle, *pair_b)) {
                    let terms = part.terms.into_iter();
                    let terms = terms.map(|(key, pair)| (TermKey { powers: powers.clone(), ..key }, pair)).collect();
                    out = self.sum(&out, &TermSum { terms, rest: None }, 1.0)?;
                }
            }
        }
        Some(out)
    }

    /// The product (C cos α + S sin α)(C′ cos β + S′ sin β) as terms in α + β and α − β.
    fn product_of_angles(&mut self, (alpha, [c, s]): OfAngle<'_>, (beta, [d, r]): OfAngle<'_>) -> Vec<TermSum> {
        let graph = &mut *self.graph;
        if alpha.is_empty() {
            let pair = [graph.mul(c, d), graph.mul(c, r)];
            return vec![self.term(beta, pair)];
        }
        if beta.is_empty() {
            let pair = [graph.mul(c, d), graph.mul(s, d)];
            return vec![self.term(alpha, pair)];
        }
        let half = graph.number(0.5);
        let [cd, cr, sd, sr] = [graph.mul(c, d), graph.mul(c, r), graph.mul(s, d), graph.mul(s, r)];
        let of_sum = [plus(graph, cd, sr, -1.0), plus(graph, cr, sd, 1.0)].map(|e| graph.mul(half, e));
        let of_difference = [plus(graph, cd, sr, 1.0), plus(graph, sd, cr, -1.0)].map(|e| graph.mul(half, e));
        let combined = |sign: i32| {
            let mut multiples: BTreeMap<u32, i32> = alpha.iter().copied().collect();
            beta.iter().for_each(|&(k, n)| *multiples.entry(k).or_default() += sign * n);
            multiples.into_iter().filter(|(_, n)| *n != 0).collect::<Vec<_>>()
        };
        vec![self.term(&combined(1), of_sum), self.term(&combined(-1), of_difference)]
    }

    /// The expression of a form.
    pub(super) fn written(&mut self, form: &TermSum) -> ExprId {
        let mut sum = form.rest.unwrap_or_else(|| self.graph.zero());
        for (key, pair) in &form.terms {
            let value = self.value(key, *pair);
            sum = self.graph.add(sum, value);
        }
        sum
    }

    /// The expression of one term, m (C cos θ + S sin θ).
    pub(super) fn value(&mut self, key: &TermKey, [c, s]: [ExprId; 2]) -> ExprId {
        let graph = &mut *self.graph;
        let mut value = c;
        if !key.angle.is_empty() {
            let mut angle = graph.zero();
            for &(k, n) in &key.angle {
                let (factor, symbol) = (graph.number(f64::from(n)), graph.symbol(Symbol::Coordinate(k)));
                let term = graph.mul(factor, symbol);
                angle = graph.add(angle, term);
            }
            // cos θ C − sin θ (−S) is the first component of A(θ)(C, −S).
            let minus_s = graph.neg(s);
            value = graph.rotate(angle, [c, minus_s])[0];
        }
        for &(k, n) in &key.powers {
            let symbol = graph.symbol(Symbol::Coordinate(k));
            let power = graph.powi(symbol, i32::from(n));
            value = graph.mul(value, power);
        }
        value
    }
}

/// a + factor · b, where the factor is ±1. Where two numbers cancel up to rounding, as in 2 − √2·√2, the sum is 0, because
/// what is left is no coefficient to divide by.
fn plus(graph: &mut Graph, a: ExprId, b: ExprId, factor: f64) -> ExprId {
    let sum = if factor < 0.0 { graph.sub(a, b) } else { graph.add(a, b) };
    match (graph.literal(a), graph.literal(sum)) {
        (Some(a), Some(rest)) if rest.abs() <= ROUNDING * a.abs() => graph.zero(),
        _ => sum,
    }
}

fn multiplied(a: &[(u32, u8)], b: &[(u32, u8)]) -> Option<Vec<(u32, u8)>> {
    let mut powers: BTreeMap<u32, u8> = a.iter().copied().collect();
    for &(k, n) in b {
        let power = powers.entry(k).or_default();
        *power = power.checked_add(n)?;
    }
    Some(powers.into_iter().collect())
}

impl TermSum {
    /// The unknowns of a form; `of_rest` gives those of its rest.
    pub(super) fn unknowns(&self, of_rest: impl FnOnce(ExprId) -> BTreeSet<u32>) -> BTreeSet<u32> {
        let mut found = self.rest.map_or_else(BTreeSet::new, of_rest);
        found.extend(self.terms.keys().flat_map(TermKey::unknowns));
        found
    }
}
