//! The reference evaluator: an expression's value in double precision, straight from the graph.

use super::graph::Graph;
use super::node::{ExprId, Node, Symbol};
use crate::mechanism::Function;

/// What an evaluation supplies.
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

/// A function of the user's language.
pub(crate) fn function(f: Function, x: f64) -> f64 {
    match f {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.atan(),
        Function::Sqrt => x.sqrt(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Abs => x.abs(),
    }
}

/// The angle `a` + 2πn that is nearest to `b`.
pub(crate) fn nearest(a: f64, b: f64) -> f64 {
    a + core::f64::consts::TAU * ((b - a) / core::f64::consts::TAU).round()
}

/// The values of `roots`.
pub fn evaluate(graph: &Graph, roots: &[ExprId], environment: &impl Environment) -> Vec<f64> {
    let mut values = vec![0.0; graph.len()];
    for id in graph.reachable(roots.iter().copied()) {
        let v = |id: ExprId| values[id.index()];
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
            Node::Call(f, a) => function(f, v(a)),
            Node::Sign(a) => v(a).signum(),
            Node::Atan2(y, x) => v(y).atan2(v(x)),
            Node::Whole(a) => v(a),
            Node::Nearest(a, b) => nearest(v(a), v(b)),
            Node::RotX(r) => v(r.angle).cos() * v(r.x) - v(r.angle).sin() * v(r.y),
            Node::RotY(r) => v(r.angle).sin() * v(r.x) + v(r.angle).cos() * v(r.y),
            Node::Dot(t) => v(t.u[0]) * v(t.d[0]) + v(t.u[1]) * v(t.d[1]),
            Node::Cross(t) => v(t.u[0]) * v(t.d[1]) - v(t.u[1]) * v(t.d[0]),
            Node::Supplied(f, order, a) => environment.supplied(f, order, v(a)),
        };
    }
    roots.iter().map(|root| values[root.index()]).collect()
}
