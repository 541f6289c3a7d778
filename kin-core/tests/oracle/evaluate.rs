//! The reference evaluator: computes an expression in double precision directly from the graph.

use super::program::{function, nearest};
use kin_core::expr::{ExprId, Graph, Node, Symbol};

/// The values of symbols and supplied functions.
pub trait Environment {
    /// The value of a symbol.
    fn symbol(&self, symbol: Symbol) -> f64;
    /// The value of a supplied function (`order` 0) or of its first or second derivative.
    fn supplied(&self, _function: u32, _order: u8, _argument: f64) -> f64 {
        f64::NAN
    }
}

impl<F: Fn(Symbol) -> f64> Environment for F {
    fn symbol(&self, symbol: Symbol) -> f64 {
        self(symbol)
    }
}

/// The values of the expressions `roots`.
pub fn evaluate(graph: &Graph, roots: &[ExprId], environment: &impl Environment) -> Vec<f64> {
    let mut values = vec![f64::NAN; graph.len()];
    for id in graph.reachable(roots.iter().copied()) {
        let v = |id: ExprId| values[id.index()];
        let pair = |[a, b]: [ExprId; 2]| [v(a), v(b)];
        values[id.index()] = match graph.node(id) {
            Node::Number(bits) => bits.value(),
            Node::Symbol(Symbol::Coarseness) => 1.0,
            Node::Symbol(symbol) => environment.symbol(symbol),
            Node::Neg(a) => -v(a),
            Node::Add(a, b) => v(a) + v(b),
            Node::Sub(a, b) => v(a) - v(b),
            Node::Mul(a, b) => v(a) * v(b),
            Node::Div(a, b) => v(a) / v(b),
            Node::Powi(a, n) => v(a).powi(n),
            Node::Powf(a, n) => v(a).powf(n.value()),
            Node::Opaque(a) => v(a),
            Node::RotX(r) => v(r.angle).cos() * v(r.x) - v(r.angle).sin() * v(r.y),
            Node::RotY(r) => v(r.angle).sin() * v(r.x) + v(r.angle).cos() * v(r.y),
            Node::Dot(t) => {
                let ([ux, uy], [dx, dy]) = (pair(t.u), pair(t.d));
                ux * dx + uy * dy
            }
            Node::Cross(t) => {
                let ([ux, uy], [dx, dy]) = (pair(t.u), pair(t.d));
                ux * dy - uy * dx
            }
            Node::Call(f, a) => function(f, v(a)),
            Node::Sign(a) => v(a).signum(),
            Node::Atan2(y, x) => v(y).atan2(v(x)),
            Node::Nearest(a, b) => nearest(v(a), v(b)),
            Node::Supplied(f, order, a) => environment.supplied(f, order, v(a)),
        };
    }
    roots.iter().map(|root| values[root.index()]).collect()
}
