//! Residues of expressions at a random pose.
//!
//! Sums, products, quotients and integer powers are exact; sines and cosines come from the random rotations; roots and
//! other functions, which have no residue, get random values, the same for equal expressions. Parameters, t and inputs
//! are random; coordinates have the values of the random pose.

use super::field::{Draw, Residue};
use super::place::RandomPositions;
use super::turn::PoseTurns;
use crate::constraint::{ConstraintSet, CoordinateKind};
use crate::expr::{Algebra, ExprId, Graph, IdMap, Node, Rotation, Symbol};
use crate::mechanism::{Component, Function};

const KIND_SYMBOL: u64 = 10;
const KIND_FUNCTION: u64 = 11;

/// The values that a random pose gives to coordinates and vectors; `None` for those that it does not determine.
pub(crate) trait PoseResidues {
    /// The value of a coordinate.
    fn coordinate(&self, _k: u32) -> Option<Residue> {
        None
    }
    /// The value of a rotated vector.
    fn vector(&self, _rotation: Rotation) -> Option<[Residue; 2]> {
        None
    }
}

/// A pose that determines nothing.
impl PoseResidues for () {}

/// The fold that computes residues of a graph's expressions.
pub(crate) struct ResidueFold<'a, P> {
    pub(crate) graph: &'a Graph,
    pub(crate) turns: &'a PoseTurns,
    pub(crate) pose: P,
    pub(crate) draw: Draw,
    /// Residues that have been computed.
    pub(crate) known: &'a mut IdMap<Residue>,
}

impl<P> ResidueFold<'_, P> {
    fn drawn(&self, id: ExprId) -> Residue {
        self.draw.residue(KIND_FUNCTION, id.index() as u64)
    }
}

impl<P: PoseResidues> Algebra for ResidueFold<'_, P> {
    type Value = Residue;

    fn graph(&self) -> &Graph {
        self.graph
    }
    fn known(&mut self) -> &mut IdMap<Residue> {
        self.known
    }
    fn number(&mut self, _: ExprId, value: f64) -> Residue {
        Residue::number(value)
    }
    fn symbol(&mut self, id: ExprId, symbol: Symbol) -> Residue {
        let placed = if let Symbol::Coordinate(k) = symbol { self.pose.coordinate(k) } else { None };
        placed.unwrap_or_else(|| self.draw.residue(KIND_SYMBOL, id.index() as u64))
    }
    fn neg(&mut self, a: Residue) -> Residue {
        -a
    }
    fn add(&mut self, a: Residue, b: Residue) -> Residue {
        a + b
    }
    fn sub(&mut self, a: Residue, b: Residue) -> Residue {
        a - b
    }
    fn mul(&mut self, a: Residue, b: Residue) -> Residue {
        a * b
    }
    /// The quotient, or a random value if the divisor is 0 in F_p, because the quotient is then undefined.
    fn div(&mut self, id: ExprId, a: Residue, b: Residue) -> Residue {
        if b.is_zero() { self.drawn(id) } else { a * b.inverse() }
    }
    fn powi(&mut self, id: ExprId, a: Residue, n: i32) -> Residue {
        match n {
            0.. => a.power(u64::from(n.unsigned_abs())),
            _ if a.is_zero() => self.drawn(id),
            _ => a.inverse().power(u64::from(n.unsigned_abs())),
        }
    }
    /// The random vector to a point if the pose contains it; otherwise the rotated vector.
    fn rotate(&mut self, r: Rotation) -> [Residue; 2] {
        match self.pose.vector(r) {
            Some(rho) => rho,
            None => self.turns.rotation(self.graph, r.angle).apply([self.value(r.x), self.value(r.y)]),
        }
    }
    fn function(&mut self, id: ExprId, node: Node) -> Residue {
        match node {
            Node::Call(Function::Sin, a) => self.turns.rotation(self.graph, a).sin,
            Node::Call(Function::Cos, a) => self.turns.rotation(self.graph, a).cos,
            Node::Call(Function::Tan, a) => {
                let turn = self.turns.rotation(self.graph, a);
                self.div(id, turn.sin, turn.cos)
            }
            _ => self.drawn(id),
        }
    }
}

/// The random pose of a mechanism.
struct Placed<'a> {
    set: &'a ConstraintSet,
    places: &'a RandomPositions,
}

impl PoseResidues for Placed<'_> {
    fn coordinate(&self, k: u32) -> Option<Residue> {
        match self.set.coordinates.get(k as usize)?.kind {
            CoordinateKind::Pose(body, component @ (Component::X | Component::Y)) => {
                Some(self.places.origin(body)[component as usize])
            }
            _ => None,
        }
    }
    fn vector(&self, rotation: Rotation) -> Option<[Residue; 2]> {
        self.places.vector(self.set, rotation)
    }
}

/// The expressions of a mechanism with a cache of their residues.
pub(super) struct Residues<'a> {
    pub(super) set: &'a ConstraintSet,
    pub(super) turns: &'a PoseTurns,
    pub(super) places: &'a RandomPositions,
    draw: Draw,
    known: IdMap<Residue>,
}

impl<'a> Residues<'a> {
    pub(super) fn new(set: &'a ConstraintSet, turns: &'a PoseTurns, places: &'a RandomPositions, draw: Draw) -> Self {
        Self { set, turns, places, draw, known: IdMap::default() }
    }

    /// The residue of an expression.
    pub(super) fn of(&mut self, id: ExprId) -> Residue {
        let Self { set, turns, places, draw, ref mut known } = *self;
        ResidueFold { graph: &set.graph, turns, pose: Placed { set, places }, draw, known }.fold(id)
    }

    /// The direction of an axis in its frame: a literal ratio, or the vector before normalisation. Its length is
    /// arbitrary.
    pub(super) fn direction(&mut self, local: [ExprId; 2]) -> [Residue; 2] {
        match super::place::literal_direction(&self.set.graph, local) {
            Some(direction) => direction,
            None => local.map(|component| self.numerator(component)),
        }
    }

    /// The residue of ±a for an expression ±a/n.
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

    /// Negative powers, tangents and signs obey their rules.
    #[test]
    fn residues_obey_the_rules_of_numbers() {
        let mut system = differentiate(assemble(&Mechanism::default()).unwrap()).unwrap();
        let draw = Draw(7);
        let (turns, places) =
            (PoseTurns::new(&system, draw), RandomPositions::new(&system, &PoseTurns::new(&system, draw), draw));
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
