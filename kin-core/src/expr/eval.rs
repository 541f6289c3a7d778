//! The reference evaluator: computes an expression in double precision directly from the graph.

use super::fold::Algebra;
use super::graph::Graph;
use super::map::IdMap;
use super::node::{ExprId, Node, Rotation, Symbol};
use crate::mechanism::Function;

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

/// Evaluates a built-in function.
fn function(f: Function, x: f64) -> f64 {
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
fn nearest(a: f64, b: f64) -> f64 {
    a + core::f64::consts::TAU * ((b - a) / core::f64::consts::TAU).round()
}

/// The values of the expressions `roots`.
pub fn evaluate(graph: &Graph, roots: &[ExprId], environment: &impl Environment) -> Vec<f64> {
    let mut numbers = Numbers { graph, environment, known: IdMap::default() };
    roots.iter().map(|root| numbers.fold(*root)).collect()
}

/// The fold that computes values in double precision.
struct Numbers<'a, E> {
    graph: &'a Graph,
    environment: &'a E,
    known: IdMap<f64>,
}

impl<E: Environment> Algebra for Numbers<'_, E> {
    type Value = f64;

    fn graph(&self) -> &Graph {
        self.graph
    }
    fn known(&mut self) -> &mut IdMap<f64> {
        &mut self.known
    }
    fn number(&mut self, _: ExprId, value: f64) -> f64 {
        value
    }
    fn symbol(&mut self, _: ExprId, symbol: Symbol) -> f64 {
        if symbol == Symbol::Coarseness { 1.0 } else { self.environment.symbol(symbol) }
    }
    fn neg(&mut self, a: f64) -> f64 {
        -a
    }
    fn add(&mut self, a: f64, b: f64) -> f64 {
        a + b
    }
    fn sub(&mut self, a: f64, b: f64) -> f64 {
        a - b
    }
    fn mul(&mut self, a: f64, b: f64) -> f64 {
        a * b
    }
    fn div(&mut self, _: ExprId, a: f64, b: f64) -> f64 {
        a / b
    }
    fn powi(&mut self, _: ExprId, a: f64, n: i32) -> f64 {
        a.powi(n)
    }
    fn rotate(&mut self, r: Rotation) -> [f64; 2] {
        let ((sin, cos), x, y) = (self.value(r.angle).sin_cos(), self.value(r.x), self.value(r.y));
        [cos * x - sin * y, sin * x + cos * y]
    }
    fn function(&mut self, _: ExprId, node: Node) -> f64 {
        match node {
            Node::Powf(a, n) => self.value(a).powf(n.value()),
            Node::Call(f, a) => function(f, self.value(a)),
            Node::Sign(a) => self.value(a).signum(),
            Node::Atan2(y, x) => self.value(y).atan2(self.value(x)),
            Node::Nearest(a, b) => nearest(self.value(a), self.value(b)),
            Node::Supplied(f, order, a) => self.environment.supplied(f, order, self.value(a)),
            _ => f64::NAN,
        }
    }
}
