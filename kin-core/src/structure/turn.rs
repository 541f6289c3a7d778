//! Random rotations that satisfy the angle rows.
//!
//! Every angle is a point (cos, sin) of the unit circle over F_p. Rows that prescribe the difference or the sum of two
//! angles relate their rotations; angles without such a row are random. Constant angles are represented by rotations,
//! too: those of literal multiples of π/2 are exact, all others are random and equal for equal expressions, and sums,
//! differences and integer multiples of angles compose correctly. The last angle row of a closed loop of angle rows is
//! assumed to be consistent with the others, because its consistency depends on numerical values.

use super::field::{Draw, Residue};
use crate::constraint::{ConstraintSet, CoordinateKind};
use crate::expr::{Depends, ExprId, Graph, Node, Symbol, quarter_turns};
use crate::mechanism::Component;
use crate::system::KinematicSystem;
use std::collections::BTreeMap;

/// A point of the unit circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Turn {
    pub(crate) cos: Residue,
    pub(crate) sin: Residue,
    /// True if no random value contributed.
    pub(crate) exact: bool,
}

impl Turn {
    const IDENTITY: Self = Self { cos: Residue::ONE, sin: Residue::ZERO, exact: true };

    /// The rational parametrisation ((1 − t²)/(1 + t²), 2t/(1 + t²)).
    fn from_parameter(t: Residue) -> Self {
        let square = t * t;
        let norm = (Residue::ONE + square).inverse();
        Self { cos: (Residue::ONE - square) * norm, sin: (t + t) * norm, exact: false }
    }

    /// This rotation and another one.
    fn compose(self, other: Self) -> Self {
        Self {
            cos: self.cos * other.cos - self.sin * other.sin,
            sin: self.sin * other.cos + self.cos * other.sin,
            exact: self.exact && other.exact,
        }
    }

    /// The opposite rotation.
    fn inverse(self) -> Self {
        Self { sin: -self.sin, ..self }
    }

    /// The rotation by `times` the angle, by repeated doubling.
    fn times(self, times: i64) -> Self {
        let (mut power, mut all, mut remaining) =
            (if times < 0 { self.inverse() } else { self }, Self::IDENTITY, times.unsigned_abs());
        while remaining > 0 {
            if remaining % 2 == 1 {
                all = all.compose(power);
            }
            power = power.compose(power);
            remaining /= 2;
        }
        all
    }

    /// The rotated vector A·v.
    pub(crate) fn apply(self, [x, y]: [Residue; 2]) -> [Residue; 2] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }
}

/// The largest multiple of an angle that is composed exactly; for larger multiples the rotation is random.
const MAX_EXACT_MULTIPLE: i64 = 12;

/// The integer n and the factor a of a product n·a.
fn multiple(graph: &Graph, a: ExprId, b: ExprId) -> Option<(i64, ExprId)> {
    let whole = |id| graph.literal(id).filter(|v| v.fract() == 0.0 && v.abs() <= MAX_EXACT_MULTIPLE as f64);
    whole(a).map(|n| (n as i64, b)).or_else(|| whole(b).map(|n| (n as i64, a)))
}

/// Writes an angle as a sum of integer multiples of distinct expressions.
///
/// Operands have smaller ids than their users, so processing in descending order visits each node once, when its
/// coefficient is complete. Overflow of a coefficient is harmless: the rotation by 2⁶¹ times any angle is the identity
/// modulo p.
pub(crate) fn terms(graph: &Graph, angle: ExprId) -> Vec<(i64, ExprId)> {
    let (mut open, mut sum) = (BTreeMap::from([(angle, 1_i64)]), Vec::new());
    while let Some((id, times)) = open.pop_last() {
        let mut add = |id: ExprId, times: i64| {
            let coefficient = open.entry(id).or_insert(0);
            *coefficient = coefficient.wrapping_add(times);
        };
        match graph.node(id) {
            Node::Add(a, b) => {
                add(a, times);
                add(b, times);
            }
            Node::Sub(a, b) => {
                add(a, times);
                add(b, times.wrapping_neg());
            }
            Node::Neg(a) => add(a, times.wrapping_neg()),
            Node::Mul(a, b) => match multiple(graph, a, b) {
                Some((n, a)) => add(a, n.wrapping_mul(times)),
                None => sum.push((times, id)),
            },
            _ => sum.push((times, id)),
        }
    }
    sum
}

/// A row ±φ_a ± φ_b + rest = 0; in a row with one angle, b is the ground.
struct TurnRow {
    ends: [(usize, i64); 2],
    rest: Turn,
}

/// The rotations of a random pose.
pub(crate) struct PoseTurns {
    draw: Draw,
    /// The rotation of each coordinate.
    rotations: Vec<Turn>,
}

const KIND_COORDINATE: u64 = 1;
const KIND_LITERAL: u64 = 2;
const KIND_EXPRESSION: u64 = 3;

impl PoseTurns {
    /// Random, independent rotations for `coordinates` angles.
    pub(crate) fn free(coordinates: usize, draw: Draw) -> Self {
        let rotations =
            (0..coordinates).map(|k| Turn::from_parameter(draw.residue(KIND_COORDINATE, k as u64))).collect();
        Self { draw, rotations }
    }

    /// Random rotations that satisfy the angle rows.
    pub(crate) fn new(system: &KinematicSystem, draw: Draw) -> Self {
        let set = &system.set;
        let ground = set.coordinates.len();
        let mut turns = Self { draw, rotations: Vec::new() };
        let mut relations: Vec<Vec<(usize, TurnRow)>> = (0..=ground).map(|_| Vec::new()).collect();
        for row in 0..set.rows.len() {
            if let Some([(a, sign_a), (b, sign_b)]) = turns.ends(system, row) {
                let rest = turns.rest(set, set.rows[row].phi);
                relations[a].push((b, TurnRow { ends: [(a, sign_a), (b, sign_b)], rest }));
                relations[b].push((a, TurnRow { ends: [(b, sign_b), (a, sign_a)], rest }));
            }
        }
        let mut rotations: Vec<Option<Turn>> = vec![None; ground + 1];
        for root in core::iter::once(ground).chain(0..ground) {
            if rotations[root].is_some() {
                continue;
            }
            rotations[root] = Some(match root == ground {
                true => Turn::IDENTITY,
                false => Turn::from_parameter(draw.residue(KIND_COORDINATE, root as u64)),
            });
            let mut open = vec![root];
            while let Some(index) = open.pop() {
                let Some(rotation) = rotations[index] else { continue };
                for (next, TurnRow { ends: [(_, sign), (_, next_sign)], rest }) in &relations[index] {
                    if rotations[*next].is_none() {
                        // Solves for φ_next = −next_sign (sign φ + rest).
                        rotations[*next] = Some(rotation.times(*sign).compose(*rest).times(-next_sign));
                        open.push(*next);
                    }
                }
            }
        }
        turns.rotations = rotations.into_iter().take(ground).map(|turn| turn.unwrap_or(Turn::IDENTITY)).collect();
        turns
    }

    /// The angles that a row relates, with their signs. Driving rows are ignored, because a driven angle is generic.
    fn ends(&self, system: &KinematicSystem, row: usize) -> Option<[(usize, i64); 2]> {
        let class = system.classes[row];
        if class.driving || !class.holonomic {
            return None;
        }
        let set = &system.set;
        let end = |&(k, e): &(u32, ExprId)| {
            let is_length =
                matches!(set.coordinates.get(k as usize)?.kind, CoordinateKind::Pose(_, Component::X | Component::Y));
            let sign = set.graph.literal(e).filter(|v| v.abs() == 1.0 && !is_length)?;
            Some((k as usize, sign as i64))
        };
        let ends = match &system.equations[row].phi_q[..] {
            [a] => [end(a)?, (set.coordinates.len(), 1)],
            [a, b] => [end(a)?, end(b)?],
            _ => return None,
        };
        // The remaining terms of the sum must not depend on coordinates.
        let still = |&(_, id): &(i64, ExprId)| match set.graph.node(id) {
            Node::Symbol(Symbol::Coordinate(_)) => true,
            _ => !set.graph.depends(id).on(Depends::COORDINATE),
        };
        terms(&set.graph, set.rows[row].phi).iter().all(still).then_some(ends)
    }

    /// The rotation by the constant part of an angle row.
    fn rest(&self, set: &ConstraintSet, phi: ExprId) -> Turn {
        let terms = terms(&set.graph, phi);
        let constants = terms.into_iter().filter(|(_, id)| !set.graph.depends(*id).on(Depends::COORDINATE));
        constants.fold(Turn::IDENTITY, |all, (times, id)| all.compose(self.term(&set.graph, id).times(times)))
    }

    /// The rotation by an angle.
    pub(crate) fn rotation(&self, graph: &Graph, angle: ExprId) -> Turn {
        let terms = terms(graph, angle);
        terms.into_iter().fold(Turn::IDENTITY, |all, (times, id)| all.compose(self.term(graph, id).times(times)))
    }

    fn term(&self, graph: &Graph, id: ExprId) -> Turn {
        match graph.node(id) {
            Node::Number(bits) => self.literal(bits.value()),
            Node::Symbol(Symbol::Coordinate(k)) => self.rotations.get(k as usize).copied().unwrap_or(Turn::IDENTITY),
            _ => Turn::from_parameter(self.draw.residue(KIND_EXPRESSION, id.index() as u64)),
        }
    }

    fn literal(&self, value: f64) -> Turn {
        if let Some(quarters) = quarter_turns(value) {
            let quarter = Turn { cos: Residue::ZERO, sin: Residue::ONE, exact: true };
            return quarter.times(quarters as i64);
        }
        let turn = Turn::from_parameter(self.draw.residue(KIND_LITERAL, value.abs().to_bits()));
        if value < 0.0 { turn.inverse() } else { turn }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn constant_angles_add_up() {
        let turns = PoseTurns { draw: Draw(5), rotations: Vec::new() };
        let mut graph = Graph::new();
        let [a, b] = [0, 1].map(|k| graph.symbol(Symbol::Parameter(k)));
        let sum = graph.add(a, b);
        let quarter = graph.number(FRAC_PI_2);
        let turned = graph.sub(sum, quarter);
        let of = |id| turns.rotation(&graph, id);
        assert_eq!(of(sum), of(a).compose(of(b)));
        assert_eq!(of(turned).cos, of(sum).sin);
        assert_eq!(of(a).cos * of(a).cos + of(a).sin * of(a).sin, Residue::ONE);
        assert!(of(quarter).exact && !of(a).exact && of(a) != of(b));
        let double = graph.add(a, a);
        assert_eq!(turns.rotation(&graph, double), turns.rotation(&graph, a).times(2));
        assert_eq!(turns.literal(-0.7), turns.literal(0.7).inverse());
        assert_eq!(turns.literal(4.0 * FRAC_PI_2), Turn::IDENTITY);
        assert_eq!(turns.literal(5.0 * PI / 6.0 - PI / 3.0), turns.literal(FRAC_PI_2));
        assert!(!turns.literal(FRAC_PI_2 + 1e-12).exact && !turns.literal(1e-12).exact);
    }
}
