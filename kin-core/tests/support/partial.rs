//! Partial derivatives by the textbook, and γ by its definition.

use kin_core::expr::{ExprId, Graph, Node, Symbol};
use kin_core::mechanism::Function;
use std::collections::HashMap;

/// ∂e/∂symbol, node by node, every rotated vector and every product of vectors written out.
pub fn partial(graph: &mut Graph, e: ExprId, symbol: Symbol) -> ExprId {
    let mut known: HashMap<ExprId, ExprId> = HashMap::new();
    for id in graph.reachable([e]) {
        let d = |id: ExprId| known[&id];
        let out = match graph.node(id) {
            Node::Number(_) | Node::Sign(_) => graph.number(0.0),
            Node::Symbol(s) => graph.number(if s == symbol { 1.0 } else { 0.0 }),
            Node::Neg(a) => graph.neg(d(a)),
            Node::Add(a, b) => graph.add(d(a), d(b)),
            Node::Sub(a, b) => graph.sub(d(a), d(b)),
            Node::Mul(a, b) => {
                let (x, y) = (graph.mul(d(a), b), graph.mul(a, d(b)));
                graph.add(x, y)
            }
            Node::Div(a, b) => {
                let (x, y) = (graph.mul(d(a), b), graph.mul(a, d(b)));
                let (top, bottom) = (graph.sub(x, y), graph.mul(b, b));
                graph.div(top, bottom)
            }
            Node::Powi(a, n) => {
                let (factor, power) = (graph.number(f64::from(n)), graph.powi(a, n - 1));
                graph.mul_all([factor, power, d(a)])
            }
            Node::Powf(a, n) => {
                let (factor, power) = (graph.number(n.value()), graph.powf(a, n.value() - 1.0));
                graph.mul_all([factor, power, d(a)])
            }
            Node::Call(f, a) => {
                let slope = slope(graph, f, a);
                graph.mul(slope, d(a))
            }
            Node::Atan2(y, x) => {
                let (a, b) = (graph.mul(x, d(y)), graph.mul(y, d(x)));
                let (top, bottom) = (graph.sub(a, b), graph.plain_dot([x, y], [x, y]));
                graph.div(top, bottom)
            }
            Node::Nearest(a, _) | Node::Opaque(a) => d(a),
            Node::RotX(r) | Node::RotY(r) => {
                let (sin, cos) = (graph.sin(r.angle), graph.cos(r.angle));
                let minus_sin = graph.neg(sin);
                let (row, slope) = match graph.node(id) {
                    Node::RotX(_) => ([cos, minus_sin], [minus_sin, graph.neg(cos)]),
                    _ => ([sin, cos], [cos, minus_sin]),
                };
                let turning = graph.plain_dot(slope, [r.x, r.y]);
                let a = graph.mul(turning, d(r.angle));
                let b = graph.plain_dot(row, [d(r.x), d(r.y)]);
                graph.add(a, b)
            }
            Node::Dot(t) => {
                let a = graph.plain_dot(t.u.map(d), t.d);
                let b = graph.plain_dot(t.u, t.d.map(d));
                graph.add(a, b)
            }
            Node::Cross(t) => {
                let a = graph.plain_cross(t.u.map(d), t.d);
                let b = graph.plain_cross(t.u, t.d.map(d));
                graph.add(a, b)
            }
            Node::Supplied(f, order, a) => {
                let slope = graph.supplied(f, order + 1, a);
                graph.mul(slope, d(a))
            }
        };
        known.insert(id, out);
    }
    known[&e]
}

fn slope(graph: &mut Graph, f: Function, a: ExprId) -> ExprId {
    let one = graph.number(1.0);
    let square = graph.mul(a, a);
    match f {
        Function::Sin => graph.cos(a),
        Function::Cos => {
            let sin = graph.sin(a);
            graph.neg(sin)
        }
        Function::Tan => {
            let cos = graph.cos(a);
            let square = graph.mul(cos, cos);
            graph.div(one, square)
        }
        Function::Asin | Function::Acos => {
            let inside = graph.sub(one, square);
            let power = graph.powf(inside, -0.5);
            if f == Function::Asin { power } else { graph.neg(power) }
        }
        Function::Atan => {
            let inside = graph.add(one, square);
            graph.powi(inside, -1)
        }
        Function::Sqrt => {
            let (half, power) = (graph.number(0.5), graph.powf(a, -0.5));
            graph.mul(half, power)
        }
        Function::Exp => graph.call(Function::Exp, a),
        Function::Ln => graph.powi(a, -1),
        Function::Abs => graph.sign(a),
    }
}

/// ∂e/∂t: explicit time, and time through the inputs.
pub fn partial_t(graph: &mut Graph, e: ExprId, inputs: u32) -> ExprId {
    let mut sum = partial(graph, e, Symbol::Time);
    for k in 0..inputs {
        for order in 0..2 {
            let slope = partial(graph, e, Symbol::Input(k, order));
            let rate = graph.symbol(Symbol::Input(k, order + 1));
            let term = graph.mul(slope, rate);
            sum = graph.add(sum, term);
        }
    }
    sum
}

/// Σ_k ∂e/∂q_k q̇_k.
fn along_rates(graph: &mut Graph, e: ExprId, coordinates: u32) -> ExprId {
    let mut sum = graph.zero();
    for k in 0..coordinates {
        let slope = partial(graph, e, Symbol::Coordinate(k));
        let rate = graph.symbol(Symbol::Rate(k));
        let term = graph.mul(slope, rate);
        sum = graph.add(sum, term);
    }
    sum
}

/// γ = −(Φ_q q̇)_q q̇ − 2 Φ_qt q̇ − Φ_tt, as it is written.
pub fn gamma(graph: &mut Graph, phi: ExprId, coordinates: u32, inputs: u32) -> ExprId {
    let phi_q_rates = along_rates(graph, phi, coordinates);
    let first = along_rates(graph, phi_q_rates, coordinates);
    let phi_t = partial_t(graph, phi, inputs);
    let mixed = along_rates(graph, phi_t, coordinates);
    let phi_tt = partial_t(graph, phi_t, inputs);
    let two = graph.number(2.0);
    let second = graph.mul(two, mixed);
    let sum = graph.add(first, second);
    let sum = graph.add(sum, phi_tt);
    graph.neg(sum)
}
