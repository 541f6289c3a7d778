//! Is an expression identically zero? Its residue at a random point modulo a large prime says so.
//!
//! Sums, products and quotients are exact, sines and cosines come from drawn rotations that add up as angles do; roots
//! and other functions are drawn, the same expression always the same. An expression that is not zero passes for zero
//! with a probability of its degree over 2⁶¹.

use crate::expr::{Algebra, ExprId, Graph, IdMap};
use crate::structure::field::{Draw, Residue};
use crate::structure::residue::Drawn;
use crate::structure::turn::Turns;

/// Residues, as far as they were asked for.
pub(crate) struct Probe {
    turns: Turns,
    draw: Draw,
    known: IdMap<Residue>,
}

impl Probe {
    /// A probe for expressions over so many coordinates.
    pub(crate) fn new(coordinates: usize) -> Self {
        let draw = Draw(0x6b69_6e00_706c_616e);
        Self { turns: Turns::free(coordinates, draw), draw, known: IdMap::default() }
    }

    /// True when `id` is zero for all values of its symbols.
    pub(crate) fn is_zero(&mut self, graph: &Graph, id: ExprId) -> bool {
        graph.is_zero(id) || self.of(graph, id).is_zero()
    }

    /// True when `a` and `b` are equal for all values of their symbols.
    pub(super) fn equal(&mut self, graph: &Graph, a: ExprId, b: ExprId) -> bool {
        a == b || self.of(graph, a) == self.of(graph, b)
    }

    /// True when `a` is −`b` for all values of their symbols.
    pub(super) fn opposite(&mut self, graph: &Graph, a: ExprId, b: ExprId) -> bool {
        self.of(graph, a) == -self.of(graph, b)
    }

    fn of(&mut self, graph: &Graph, id: ExprId) -> Residue {
        let Self { ref turns, draw, ref mut known } = *self;
        Drawn { graph, turns, pose: (), draw, known }.fold(id)
    }
}
