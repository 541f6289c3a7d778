//! What closures are made of: roots with their signs, sizes for their margins, and what tells the mode of a configuration.

use crate::expr::{ExprId, Graph, Node, Symbol};
use crate::mechanism::Function;

/// How much the terms of a difference count beside the difference: it is far smaller where digits are lost.
pub(super) const SHARE: f64 = 1e-6;

/// The sum of the squares of all terms of which `parts` are sums.
pub(super) fn terms_of(parts: [ExprId; 2], graph: &mut Graph) -> ExprId {
    let mut sum = graph.zero();
    for part in parts {
        let size = squared_terms(graph, part, 8);
        sum = graph.add(sum, size);
    }
    sum
}

/// Σ tᵢ² of a sum, Σ tᵢ² Σ uⱼ² of a product; deeper than `depth` the square.
pub(super) fn squared_terms(graph: &mut Graph, id: ExprId, depth: usize) -> ExprId {
    if depth == 0 {
        return graph.square(id);
    }
    match graph.node(id) {
        Node::Neg(a) | Node::Whole(a) => squared_terms(graph, a, depth - 1),
        Node::Add(a, b) | Node::Sub(a, b) => {
            let (a, b) = (squared_terms(graph, a, depth - 1), squared_terms(graph, b, depth - 1));
            graph.add(a, b)
        }
        Node::Mul(a, b) => {
            let (a, b) = (squared_terms(graph, a, depth - 1), squared_terms(graph, b, depth - 1));
            graph.mul(a, b)
        }
        _ => graph.square(id),
    }
}

/// 1/a, as one thing that all products share.
pub(super) fn inverse(graph: &mut Graph, a: ExprId) -> ExprId {
    let one = graph.number(1.0);
    let inverse = graph.div(one, a);
    graph.whole(inverse)
}

/// ±√|inside|.
pub(super) fn signed_root(graph: &mut Graph, mode: ExprId, inside: ExprId) -> ExprId {
    let magnitude = graph.call(Function::Abs, inside);
    let root = graph.call(Function::Sqrt, magnitude);
    let w = graph.mul(mode, root);
    graph.whole(w)
}

/// (a sin φ − b cos φ)/√(a² + b²), which is ±w/√(a² + b²).
pub(super) fn angle_indicator(graph: &mut Graph, k: u32, [a, b]: [ExprId; 2]) -> ExprId {
    let phi = graph.symbol(Symbol::Coordinate(k));
    // The second component of A(φ)(a, −b).
    let minus_b = graph.neg(b);
    let w = graph.rotate(phi, [a, minus_b])[1];
    let d = graph.plain_dot([a, b], [a, b]);
    let size = graph.call(Function::Sqrt, d);
    graph.div(w, size)
}

/// (a x + b/2)/√(b²/4 + |a c|).
pub(super) fn quadratic_indicator(graph: &mut Graph, k: u32, [a, b, c]: [ExprId; 3]) -> ExprId {
    let (x, half) = (graph.symbol(Symbol::Coordinate(k)), graph.number(0.5));
    let (ax, half) = (graph.mul(a, x), graph.mul(half, b));
    let (square, product) = (graph.square(half), graph.mul(a, c));
    let size = size_of_quadratic(graph, square, product);
    let (w, size) = (graph.add(ax, half), graph.call(Function::Sqrt, size));
    graph.div(w, size)
}

pub(super) fn size_of_quadratic(graph: &mut Graph, square: ExprId, product: ExprId) -> ExprId {
    let magnitude = graph.call(Function::Abs, product);
    graph.add(square, magnitude)
}

/// The centre and squared radius of e(x² + y²) + l·(x, y) + k = 0.
pub(super) fn centre_and_square(graph: &mut Graph, e: ExprId, l: [ExprId; 2], k: ExprId) -> ([ExprId; 2], ExprId) {
    let (minus_half, one) = (graph.number(-0.5), graph.number(1.0));
    let inverse = graph.div(one, e);
    let factor = graph.mul(minus_half, inverse);
    let centre = l.map(|l| graph.mul(factor, l));
    let (square, k) = (graph.plain_dot(centre, centre), graph.mul(k, inverse));
    (centre, graph.sub(square, k))
}

/// perp(n)·(p − centre)/(|n| r), with its sign.
pub(super) fn circle_indicator(graph: &mut Graph, at: [u32; 2], [e, lx, ly, k, nx, ny]: [ExprId; 6]) -> ExprId {
    let ([x0, y0], radius) = centre_and_square(graph, e, [lx, ly], k);
    let [x, y] = at.map(|k| graph.symbol(Symbol::Coordinate(k)));
    let [dx, dy] = [graph.sub(x, x0), graph.sub(y, y0)];
    let (w, n2) = (graph.plain_cross([nx, ny], [dx, dy]), graph.plain_dot([nx, ny], [nx, ny]));
    let full = graph.mul(n2, radius);
    let magnitude = graph.call(Function::Abs, full);
    let size = graph.call(Function::Sqrt, magnitude);
    graph.div(w, size)
}
