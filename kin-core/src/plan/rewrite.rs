//! Substitution in expressions.

use crate::expr::{Algebra, ExprId, Graph, IdMap, Node, Rotation, Symbol, Turning};
use crate::vocabulary::Function;

/// A substitution for symbols, expressions, sines and cosines; `None` leaves them unchanged.
pub(crate) trait Substitution {
    /// The replacement of a symbol.
    fn symbol(&mut self, graph: &mut Graph, symbol: Symbol) -> Option<ExprId>;
    /// The replacement of an expression, taken before its operands are rewritten.
    fn expression(&mut self, _graph: &mut Graph, _id: ExprId) -> Option<ExprId> {
        None
    }
    /// The rotation that replaces the cosine and sine of `angle`; `known` contains the rewritten operands of the angle.
    fn turn(&mut self, _graph: &mut Graph, _known: &IdMap<ExprId>, _angle: ExprId) -> Option<Turned> {
        None
    }
}

/// A rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turned {
    /// A rotation by an angle.
    Angle(ExprId),
    /// A rotation whose cosine and sine were found without the angle.
    Pair([ExprId; 2]),
}

impl Turned {
    pub(crate) fn cos(self, graph: &mut Graph) -> ExprId {
        match self {
            Self::Angle(angle) => graph.cos(angle),
            Self::Pair([cos, _]) => cos,
        }
    }

    pub(crate) fn sin(self, graph: &mut Graph) -> ExprId {
        match self {
            Self::Angle(angle) => graph.sin(angle),
            Self::Pair([_, sin]) => sin,
        }
    }

    fn rotate(self, graph: &mut Graph, [x, y]: [ExprId; 2]) -> [ExprId; 2] {
        match self {
            Self::Angle(angle) => graph.rotate(angle, [x, y]),
            Self::Pair([cos, sin]) => {
                let [cx, sy, sx, cy] = [graph.mul(cos, x), graph.mul(sin, y), graph.mul(sin, x), graph.mul(cos, y)];
                [graph.sub(cx, sy), graph.add(sx, cy)]
            }
        }
    }
}

/// The expression `root` after a substitution; `known` is the cache of rewritten expressions.
pub(crate) fn rewrite(
    graph: &mut Graph,
    root: ExprId,
    known: &mut IdMap<ExprId>,
    substitution: &mut impl Substitution,
) -> ExprId {
    Rewriting { graph, known, substitution }.fold(root)
}

struct Rewriting<'a, S> {
    graph: &'a mut Graph,
    known: &'a mut IdMap<ExprId>,
    substitution: &'a mut S,
}

impl<S: Substitution> Rewriting<'_, S> {
    fn turn(&mut self, angle: ExprId) -> Turned {
        let turned = self.substitution.turn(self.graph, self.known, angle);
        turned.unwrap_or_else(|| Turned::Angle(self.known.or(angle, angle)))
    }

    fn turning(&mut self, Turning { angle, u, d }: Turning) -> (ExprId, [ExprId; 2], [ExprId; 2]) {
        (self.value(angle), u.map(|id| self.value(id)), d.map(|id| self.value(id)))
    }
}

impl<S: Substitution> Algebra for Rewriting<'_, S> {
    type Value = ExprId;

    fn graph(&self) -> &Graph {
        self.graph
    }
    fn known(&mut self) -> &mut IdMap<ExprId> {
        self.known
    }
    fn at_once(&mut self, id: ExprId) -> Option<ExprId> {
        self.substitution.expression(self.graph, id)
    }
    fn number(&mut self, id: ExprId, _: f64) -> ExprId {
        id
    }
    fn symbol(&mut self, id: ExprId, symbol: Symbol) -> ExprId {
        self.substitution.symbol(self.graph, symbol).unwrap_or(id)
    }
    fn neg(&mut self, a: ExprId) -> ExprId {
        self.graph.neg(a)
    }
    fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.graph.add(a, b)
    }
    fn double(&mut self, a: ExprId) -> ExprId {
        self.graph.double(a)
    }
    fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.graph.sub(a, b)
    }
    fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.graph.mul(a, b)
    }
    fn div(&mut self, _: ExprId, a: ExprId, b: ExprId) -> ExprId {
        self.graph.div(a, b)
    }
    fn powi(&mut self, _: ExprId, a: ExprId, n: i32) -> ExprId {
        self.graph.powi(a, n)
    }
    fn opaque(&mut self, a: ExprId) -> ExprId {
        self.graph.opaque(a)
    }
    fn rotate(&mut self, r: Rotation) -> [ExprId; 2] {
        let vector = [self.value(r.x), self.value(r.y)];
        self.turn(r.angle).rotate(self.graph, vector)
    }
    fn dot(&mut self, turning: Turning) -> ExprId {
        let (angle, u, d) = self.turning(turning);
        self.graph.dot(angle, u, d)
    }
    fn cross(&mut self, turning: Turning) -> ExprId {
        let (angle, u, d) = self.turning(turning);
        self.graph.cross(angle, u, d)
    }
    fn function(&mut self, id: ExprId, node: Node) -> ExprId {
        let v = |id: ExprId| self.known.or(id, id);
        match node {
            Node::Powf(a, n) => self.graph.powf(v(a), n.value()),
            Node::Call(Function::Sin, a) => self.turn(a).sin(self.graph),
            Node::Call(Function::Cos, a) => self.turn(a).cos(self.graph),
            Node::Call(f, a) => self.graph.call(f, v(a)),
            Node::Sign(a) => self.graph.sign(v(a)),
            Node::Atan2(y, x) => self.graph.atan2(v(y), v(x)),
            Node::Nearest(a, b) => self.graph.nearest(v(a), v(b)),
            Node::Supplied(f, order, a) => self.graph.supplied(f, order, v(a)),
            _ => id,
        }
    }
}
