//! Is an expression identically zero? Its residue at a random point modulo a large prime says so.
//!
//! Sums, products and quotients are exact, sines and cosines come from drawn rotations that add up as angles do; roots
//! and other functions are drawn, the same expression always the same. An expression that is not zero passes for zero
//! with a probability of its degree over 2⁶¹.

use crate::expr::{ExprId, Graph, IdMap, Node};
use crate::mechanism::Function;
use crate::structure::field::{Draw, Residue};
use crate::structure::turn::Turns;

const SORT_SYMBOL: u64 = 20;
const SORT_FUNCTION: u64 = 21;

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
        if self.known.contains(id) {
            return self.known.or(id, Residue::default());
        }
        let mut open = vec![id];
        while let Some(&next) = open.last() {
            if self.known.contains(next) {
                open.pop();
                continue;
            }
            let before = open.len();
            graph.node(next).for_each_operand(|operand| {
                if !self.known.contains(operand) {
                    open.push(operand);
                }
            });
            if open.len() == before {
                let value = self.node(graph, next);
                self.known.insert(next, value);
                open.pop();
            }
        }
        self.known.or(id, Residue::default())
    }

    fn node(&self, graph: &Graph, id: ExprId) -> Residue {
        let v = |id: ExprId| self.known.or(id, Residue::default());
        let drawn = || self.draw.residue(SORT_FUNCTION, id.index() as u64);
        match graph.node(id) {
            Node::Number(bits) => Residue::number(bits.value()),
            Node::Symbol(_) => self.draw.residue(SORT_SYMBOL, id.index() as u64),
            Node::Neg(a) => -v(a),
            Node::Whole(a) => v(a),
            Node::Add(a, b) => v(a) + v(b),
            Node::Sub(a, b) => v(a) - v(b),
            Node::Mul(a, b) => v(a) * v(b),
            Node::Div(_, b) if v(b).is_zero() => drawn(),
            Node::Div(a, b) => v(a) * v(b).inverse(),
            Node::Powi(a, n) if n >= 0 => v(a).power(u64::from(n.unsigned_abs())),
            Node::Powi(a, _) if v(a).is_zero() => drawn(),
            Node::Powi(a, n) => v(a).inverse().power(u64::from(n.unsigned_abs())),
            Node::Call(Function::Sin, a) => self.turns.of(graph, a).sin,
            Node::Call(Function::Cos, a) => self.turns.of(graph, a).cos,
            Node::RotX(r) => self.turns.of(graph, r.angle).apply([v(r.x), v(r.y)])[0],
            Node::RotY(r) => self.turns.of(graph, r.angle).apply([v(r.x), v(r.y)])[1],
            Node::Dot(t) => v(t.u[0]) * v(t.d[0]) + v(t.u[1]) * v(t.d[1]),
            Node::Cross(t) => v(t.u[0]) * v(t.d[1]) - v(t.u[1]) * v(t.d[0]),
            Node::Powf(..)
            | Node::Call(..)
            | Node::Sign(_)
            | Node::Atan2(..)
            | Node::Nearest(..)
            | Node::Supplied(..) => drawn(),
        }
    }
}
