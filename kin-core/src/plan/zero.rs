//! Tests whether an expression is identically zero, by its residue at a random point modulo a large prime.
//!
//! Residues of sums, products and quotients are exact. Sines and cosines are those of random rotations, which compose
//! when angles are added. Roots and other functions get random values, the same for equal expressions. A non-zero
//! expression of degree d is taken for zero with a probability of about d/2⁶¹.

use crate::expr::{Algebra, ExprId, Graph, IdMap};
use crate::structure::field::{Draw, Residue};
use crate::structure::residue::ResidueFold;
use crate::structure::turn::PoseTurns;

/// Residues at one random point, computed when they are needed.
pub(crate) struct ZeroTest {
    turns: PoseTurns,
    draw: Draw,
    known: IdMap<Residue>,
}

impl ZeroTest {
    /// A test for expressions over the given number of coordinates.
    pub(crate) fn new(coordinates: usize) -> Self {
        let draw = Draw(0x6b69_6e00_706c_616e);
        Self { turns: PoseTurns::free(coordinates, draw), draw, known: IdMap::default() }
    }

    /// True if `id` is zero for all values of its symbols.
    pub(crate) fn is_zero(&mut self, graph: &Graph, id: ExprId) -> bool {
        graph.is_zero(id) || self.of(graph, id).is_zero()
    }

    /// True if `a` and `b` are equal for all values of their symbols.
    pub(super) fn equal(&mut self, graph: &Graph, a: ExprId, b: ExprId) -> bool {
        a == b || self.of(graph, a) == self.of(graph, b)
    }

    /// True if `a` equals −`b` for all values of their symbols.
    pub(super) fn opposite(&mut self, graph: &Graph, a: ExprId, b: ExprId) -> bool {
        self.of(graph, a) == -self.of(graph, b)
    }

    fn of(&mut self, graph: &Graph, id: ExprId) -> Residue {
        let Self { ref turns, draw, ref mut known } = *self;
        ResidueFold { graph, turns, pose: (), draw, known }.fold(id)
    }
}
