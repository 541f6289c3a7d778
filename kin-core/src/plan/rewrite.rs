//! Expressions with other things in the place of their symbols.

use crate::expr::{ExprId, Graph, IdMap, Node, Symbol};
use crate::mechanism::Function;

/// What stands for symbols and for sines and cosines; `None` leaves them as they are.
pub(crate) trait Substitution {
    /// What stands for a symbol.
    fn symbol(&mut self, graph: &mut Graph, symbol: Symbol) -> Option<ExprId>;
    /// What stands for a whole expression.
    fn whole(&mut self, _graph: &mut Graph, _id: ExprId) -> Option<ExprId> {
        None
    }
    /// The cosine and sine of an angle, given as it was before, and what its parts have become.
    fn turn(&mut self, _graph: &mut Graph, _known: &IdMap<ExprId>, _angle: ExprId) -> Option<Turned> {
        None
    }
}

/// What a rotation is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turned {
    /// The sine and cosine of an angle.
    Angle(ExprId),
    /// A cosine and a sine that were found without their angle.
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

/// `root` after a substitution; `known` remembers what was rewritten.
pub(crate) fn rewrite(
    graph: &mut Graph,
    root: ExprId,
    known: &mut IdMap<ExprId>,
    substitution: &mut impl Substitution,
) -> ExprId {
    if known.contains(root) {
        return known.or(root, root);
    }
    let mut open = vec![(root, false)];
    while let Some((id, ready)) = open.pop() {
        if known.contains(id) {
            continue;
        }
        if let Some(other) = substitution.whole(graph, id) {
            known.insert(id, other);
            continue;
        }
        if ready {
            let other = node(graph, id, known, substitution);
            known.insert(id, other);
            continue;
        }
        open.push((id, true));
        graph.node(id).for_each_operand(|operand| {
            if !known.contains(operand) {
                open.push((operand, false));
            }
        });
    }
    known.or(root, root)
}

fn node(graph: &mut Graph, id: ExprId, known: &IdMap<ExprId>, substitution: &mut impl Substitution) -> ExprId {
    let v = |id: ExprId| known.or(id, id);
    match graph.node(id) {
        Node::Number(_) => id,
        Node::Symbol(symbol) => substitution.symbol(graph, symbol).unwrap_or(id),
        Node::Neg(a) => graph.neg(v(a)),
        Node::Add(a, b) if a == b => graph.double(v(a)),
        Node::Add(a, b) => graph.add(v(a), v(b)),
        Node::Sub(a, b) => graph.sub(v(a), v(b)),
        Node::Mul(a, b) => graph.mul(v(a), v(b)),
        Node::Div(a, b) => graph.div(v(a), v(b)),
        Node::Powi(a, n) => graph.powi(v(a), n),
        Node::Powf(a, n) => graph.powf(v(a), n.value()),
        Node::Call(Function::Sin, a) => match substitution.turn(graph, known, a) {
            Some(turned) => turned.sin(graph),
            None => graph.sin(v(a)),
        },
        Node::Call(Function::Cos, a) => match substitution.turn(graph, known, a) {
            Some(turned) => turned.cos(graph),
            None => graph.cos(v(a)),
        },
        Node::Call(f, a) => graph.call(f, v(a)),
        Node::Sign(a) => graph.sign(v(a)),
        Node::Whole(a) => graph.whole(v(a)),
        Node::Atan2(y, x) => graph.atan2(v(y), v(x)),
        Node::Nearest(a, b) => graph.nearest(v(a), v(b)),
        Node::RotX(r) | Node::RotY(r) => {
            let side = usize::from(matches!(graph.node(id), Node::RotY(_)));
            let vector = [v(r.x), v(r.y)];
            match substitution.turn(graph, known, r.angle) {
                Some(turned) => turned.rotate(graph, vector)[side],
                None => graph.rotate(v(r.angle), vector)[side],
            }
        }
        Node::Dot(t) => {
            let ([ux, uy], [dx, dy]) = (t.u.map(v), t.d.map(v));
            graph.dot(v(t.angle), [ux, uy], [dx, dy])
        }
        Node::Cross(t) => {
            let ([ux, uy], [dx, dy]) = (t.u.map(v), t.d.map(v));
            graph.cross(v(t.angle), [ux, uy], [dx, dy])
        }
        Node::Supplied(f, order, a) => graph.supplied(f, order, v(a)),
    }
}
