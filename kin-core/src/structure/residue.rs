//! Expressions at a draw.
//!
//! Sums, products, quotients and integer powers are exact; sines and cosines come from the drawn rotations; roots and
//! other functions, which have no residue, are drawn, the same expression always the same. Parameters, t and inputs
//! are drawn; coordinates stand at the drawn pose.

use super::field::{Draw, Residue};
use super::place::Places;
use super::turn::Turns;
use crate::constraint::{ConstraintSet, CoordinateKind};
use crate::expr::{ExprId, Node, Rotation, Symbol};
use crate::mechanism::{Component, Function};
use std::collections::HashMap;

const SORT_SYMBOL: u64 = 10;
const SORT_FUNCTION: u64 = 11;

/// Expressions and their residues, as far as they were asked for.
pub(super) struct Residues<'a> {
    pub(super) set: &'a ConstraintSet,
    pub(super) turns: &'a Turns,
    pub(super) places: &'a Places,
    draw: Draw,
    known: HashMap<ExprId, Residue>,
}

impl<'a> Residues<'a> {
    pub(super) fn new(set: &'a ConstraintSet, turns: &'a Turns, places: &'a Places, draw: Draw) -> Self {
        Self { set, turns, places, draw, known: HashMap::new() }
    }

    /// The residue of an expression.
    pub(super) fn of(&mut self, id: ExprId) -> Residue {
        let mut open = vec![id];
        while let Some(&next) = open.last() {
            if self.known.contains_key(&next) {
                open.pop();
                continue;
            }
            let before = open.len();
            self.set.graph.node(next).for_each_operand(|operand| {
                if !self.known.contains_key(&operand) {
                    open.push(operand);
                }
            });
            if open.len() == before {
                let value = self.node(next);
                self.known.insert(next, value);
                open.pop();
            }
        }
        self.known.get(&id).copied().unwrap_or_default()
    }

    fn node(&self, id: ExprId) -> Residue {
        let graph = &self.set.graph;
        let v = |id: ExprId| self.known.get(&id).copied().unwrap_or_default();
        match graph.node(id) {
            Node::Number(bits) => Residue::number(bits.value()),
            Node::Symbol(symbol) => self.symbol(symbol, id),
            Node::Neg(a) => -v(a),
            Node::Whole(a) => v(a),
            Node::Add(a, b) => v(a) + v(b),
            Node::Sub(a, b) => v(a) - v(b),
            Node::Mul(a, b) => v(a) * v(b),
            // 0 in F_p where the pose is special: nothing is known about the quotient then.
            Node::Div(_, b) if v(b).is_zero() => self.drawn(id),
            Node::Div(a, b) => v(a) * v(b).inverse(),
            Node::Powi(a, n) if n >= 0 => v(a).power(u64::from(n.unsigned_abs())),
            Node::Powi(a, _) if v(a).is_zero() => self.drawn(id),
            Node::Powi(a, n) => v(a).inverse().power(u64::from(n.unsigned_abs())),
            Node::Call(Function::Sin, a) => self.turns.of(graph, a).sin,
            Node::Call(Function::Cos, a) => self.turns.of(graph, a).cos,
            Node::Call(Function::Tan, a) => {
                let turn = self.turns.of(graph, a);
                if turn.cos.is_zero() { self.drawn(id) } else { turn.sin * turn.cos.inverse() }
            }
            Node::RotX(r) => self.rotated(r)[0],
            Node::RotY(r) => self.rotated(r)[1],
            Node::Dot(t) => v(t.u[0]) * v(t.d[0]) + v(t.u[1]) * v(t.d[1]),
            Node::Cross(t) => v(t.u[0]) * v(t.d[1]) - v(t.u[1]) * v(t.d[0]),
            Node::Powf(..)
            | Node::Call(..)
            | Node::Sign(_)
            | Node::Atan2(..)
            | Node::Nearest(..)
            | Node::Supplied(..) => self.drawn(id),
        }
    }

    fn drawn(&self, id: ExprId) -> Residue {
        self.draw.residue(SORT_FUNCTION, id.index() as u64)
    }

    fn symbol(&self, symbol: Symbol, id: ExprId) -> Residue {
        if let Symbol::Coordinate(k) = symbol
            && let Some(coordinate) = self.set.coordinates.get(k as usize)
            && let CoordinateKind::Pose(body, component @ (Component::X | Component::Y)) = coordinate.kind
        {
            return self.places.origin(body)[component as usize];
        }
        self.draw.residue(SORT_SYMBOL, id.index() as u64)
    }

    /// ρ: where the draw has put the point, or else the turned vector.
    fn rotated(&self, r: Rotation) -> [Residue; 2] {
        if let Some(rho) = self.places.vector(self.set, r) {
            return rho;
        }
        let v = |id: ExprId| self.known.get(&id).copied().unwrap_or_default();
        self.turns.of(&self.set.graph, r.angle).apply([v(r.x), v(r.y)])
    }

    /// The direction of an axis in its frame, of any length: the literal ratio, or what was divided by the norm.
    pub(super) fn direction(&mut self, local: [ExprId; 2]) -> [Residue; 2] {
        match super::place::literal_direction(&self.set.graph, local) {
            Some(direction) => direction,
            None => local.map(|component| self.numerator(component)),
        }
    }

    /// ±a of ±a/n.
    fn numerator(&mut self, component: ExprId) -> Residue {
        match self.set.graph.node(component) {
            Node::Neg(inner) => -self.numerator(inner),
            Node::Div(a, _) => self.of(a),
            _ => self.of(component),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::Mechanism;
    use crate::{assemble, differentiate};

    /// Negative powers, tangents and signs are what they are called.
    #[test]
    fn residues_obey_the_rules_of_numbers() {
        let mut system = differentiate(assemble(&Mechanism::default()).unwrap()).unwrap();
        let draw = Draw(7);
        let (turns, places) = (Turns::new(&system, draw), Places::new(&system, &Turns::new(&system, draw), draw));
        let graph = &mut system.set.graph;
        let [a, b] = [0, 1].map(|k| graph.symbol(Symbol::Parameter(k)));
        let (cube, inverse) = (graph.powi(a, 3), graph.powi(a, -3));
        let (tan, sin, cos) = (graph.call(Function::Tan, a), graph.sin(a), graph.cos(a));
        let quotient = graph.div(a, b);
        let back = graph.neg(quotient);
        assert!(matches!(graph.node(inverse), Node::Powi(_, -3)) && matches!(graph.node(back), Node::Neg(_)));
        let mut residues = Residues::new(&system.set, &turns, &places, draw);
        let mut of = |id| residues.of(id);
        assert_eq!(of(cube) * of(inverse), Residue::ONE);
        assert_eq!(of(tan) * of(cos), of(sin));
        assert_eq!(of(quotient) * of(b), of(a));
        let (a, back_along) = (of(a), residues.direction([back, quotient]));
        assert_eq!(back_along, [-a, a]);
    }
}
