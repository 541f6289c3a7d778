//! What closures are made of: roots with their signs, their margins, and what tells the mode of a configuration.
//!
//! A margin is 1 far from trouble, 0 where both roots meet, negative where there is none. It also falls to 0 where what
//! the roots are divided by is a small difference of large terms.

use crate::expr::{ExprId, Graph, Node, Symbol};
use crate::mechanism::Function;

/// How much the terms of a difference count beside the difference: it is far smaller where digits are lost.
pub(super) const SHARE: f64 = 1e-6;

/// Added to sizes, so that 0 of 0 is a margin of 0.
pub(super) const LEAST: f64 = 1e-300;

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

/// What the square of an expression is held against to see whether it is nearly 0: that of its terms, in which a vector
/// that turns counts with its length, wherever it points.
pub(super) fn squared_size(graph: &mut Graph, id: ExprId, depth: usize) -> ExprId {
    if depth == 0 {
        return graph.square(id);
    }
    let length = |graph: &mut Graph, [x, y]: [ExprId; 2]| {
        let (x, y) = (squared_size(graph, x, depth - 1), squared_size(graph, y, depth - 1));
        graph.add(x, y)
    };
    match graph.node(id) {
        Node::Neg(a) | Node::Whole(a) => squared_size(graph, a, depth - 1),
        Node::Add(a, b) | Node::Sub(a, b) => length(graph, [a, b]),
        Node::Mul(a, b) => {
            let (a, b) = (squared_size(graph, a, depth - 1), squared_size(graph, b, depth - 1));
            graph.mul(a, b)
        }
        Node::RotX(r) | Node::RotY(r) => length(graph, [r.x, r.y]),
        Node::Dot(t) | Node::Cross(t) => {
            let (u, d) = (length(graph, t.u), length(graph, t.d));
            graph.mul(u, d)
        }
        _ => graph.square(id),
    }
}

/// How much of all that moves an equation is a divisor: its square over itself, the squares of `others`, and a little of
/// the terms of `parts`, which it is made of. None where there is nothing else. A divisor that does not move leads to no
/// limit: it is one of the dimensions, and may be far smaller than others (a gear's radius) before digits are lost.
pub(super) fn share(graph: &mut Graph, square: ExprId, others: &[ExprId], parts: &[ExprId]) -> Option<ExprId> {
    let is_term = |graph: &mut Graph, part: ExprId| squared_terms(graph, part, 8) == graph.square(part);
    let terms = parts.iter().all(|&part| is_term(graph, part));
    if terms && others.is_empty() {
        return None;
    }
    let mut rest = graph.zero();
    for &other in others {
        let other = graph.square(other);
        rest = graph.add(rest, other);
    }
    if graph.depends(square).is_static() {
        let share = graph.number(SHARE);
        rest = graph.mul(share, rest);
    }
    let whole = graph.add(square, rest);
    let whole = with_share(graph, whole, if terms { &[] } else { parts });
    Some(graph.div(square, whole))
}

/// How far two vectors are from parallel: their squared cross product over the product of their squared lengths.
pub(super) fn spread(graph: &mut Graph, square: ExprId, [a, b]: [ExprId; 2]) -> ExprId {
    let (product, least) = (graph.mul(a, b), graph.number(LEAST));
    let whole = graph.add(product, least);
    graph.div(square, whole)
}

/// 1/a, as one thing that all products share.
pub(super) fn inverse(graph: &mut Graph, a: ExprId) -> ExprId {
    let one = graph.number(1.0);
    let inverse = graph.div(one, a);
    graph.whole(inverse)
}

/// ±√|inside|.
fn signed_root(graph: &mut Graph, mode: ExprId, inside: ExprId) -> ExprId {
    let magnitude = graph.call(Function::Abs, inside);
    let root = graph.call(Function::Sqrt, magnitude);
    let w = graph.mul(mode, root);
    graph.whole(w)
}

/// `size` and a little of the squared terms of which `parts` are sums; never 0.
fn with_share(graph: &mut Graph, size: ExprId, parts: &[ExprId]) -> ExprId {
    let (mut terms, share, least) = (graph.zero(), graph.number(SHARE), graph.number(LEAST));
    for &part in parts {
        let squares = squared_terms(graph, part, 8);
        terms = graph.add(terms, squares);
    }
    let terms = graph.mul(share, terms);
    let terms = graph.add(terms, least);
    graph.add(size, terms)
}

/// a cos φ + b sin φ = c: cos φ and sin φ times a² + b², the inverse of that, and the margin.
pub(super) fn angle(graph: &mut Graph, mode: ExprId, [a, b, c]: [ExprId; 3]) -> ([ExprId; 2], ExprId, ExprId) {
    // w = ±√(a² + b² − c²): cos φ = (a c − b w)/(a² + b²), sin φ = (b c + a w)/(a² + b²).
    let (d, square) = (graph.plain_dot([a, b], [a, b]), graph.square(c));
    let inside = graph.sub(d, square);
    let inverse = inverse(graph, d);
    let w = signed_root(graph, mode, inside);
    let turned = [graph.plain_cross([a, b], [w, c]), graph.plain_dot([b, a], [c, w])];
    // Pins that meet leave no direction. Where they do not move, what is small beside c is so by its dimensions.
    let still = [a, b].iter().all(|&e| graph.depends(e).is_static());
    let parts = [a, b, c];
    let whole = with_share(graph, d, if still { &parts } else { &parts[..2] });
    (turned, inverse, graph.div(inside, whole))
}

/// a x² + b x + c = 0: x = (±√(h² − a c) − h)/a with h = b/2, and the margin.
///
/// With T = h + sgn(h) √(h² − a c), in which nothing cancels, the roots are −c/T and −T/a. As a goes to 0, the first
/// goes to −c/b, and the second away.
pub(super) fn quadratic(graph: &mut Graph, mode: ExprId, [a, b, c]: [ExprId; 3]) -> (ExprId, ExprId) {
    let half = graph.number(0.5);
    let h = graph.mul(half, b);
    let (square, product) = (graph.square(h), graph.mul(a, c));
    let inside = graph.sub(square, product);
    let size = size_of_quadratic(graph, square, product);
    let least = graph.number(LEAST);
    let size = graph.add(size, least);
    let margin = graph.div(inside, size);
    if graph.is_zero(h) {
        let w = signed_root(graph, mode, inside);
        return (graph.div(w, a), margin);
    }
    let sign = graph.sign(h);
    let w = signed_root(graph, sign, inside);
    let t = graph.add(h, w);
    let t = graph.whole(t);
    // 1 for the first root, 0 for the second: a choice without a branch.
    let same = graph.mul(mode, sign);
    let same = graph.mul(half, same);
    let (first, second) = (graph.add(half, same), graph.sub(half, same));
    let [first, second] = [first, second].map(|e| graph.whole(e));
    let (top, bottom) = (graph.plain_dot([first, second], [c, t]), graph.plain_dot([first, second], [t, a]));
    let x = graph.div(top, bottom);
    let x = graph.neg(x);
    if graph.literal(a).is_some() {
        return (x, margin);
    }
    let a2 = graph.square(a);
    let whole = with_share(graph, a2, &[a]);
    let share = graph.div(a2, whole);
    let share = graph.mul(second, share);
    let stays = graph.add(first, share);
    (x, graph.mul(margin, stays))
}

/// A circle e(x² + y²) + l·(x, y) + k = 0 and a line n·(x, y) + m = 0: x and y, and the margin.
pub(super) fn circle(graph: &mut Graph, mode: ExprId, [e, lx, ly, k, nx, ny, m]: [ExprId; 7]) -> ([ExprId; 2], ExprId) {
    let ([x0, y0], radius) = centre_and_square(graph, e, [lx, ly], k);
    // The distance of the line from the centre, times |n|; half the chord, times |n|.
    let (off, n2) = (graph.plain_dot([nx, ny], [x0, y0]), graph.plain_dot([nx, ny], [nx, ny]));
    let off = graph.add(off, m);
    let (full, square) = (graph.mul(radius, n2), graph.square(off));
    let inside = graph.sub(full, square);
    let w = signed_root(graph, mode, inside);
    let (dx, dy) = (graph.plain_dot([off, w], [nx, ny]), graph.plain_cross([w, off], [ny, nx]));
    let [dx, dy] = [dx, dy].map(|d| graph.div(d, n2));
    let at = [graph.sub(x0, dx), graph.add(y0, dy)];
    // Circles around one centre leave no line.
    let size = graph.call(Function::Abs, full);
    let size = with_share(graph, size, &[off]);
    (at, graph.div(inside, size))
}

/// (a sin nφ − b cos nφ)/√(a² + b²), which is ±w/√(a² + b²).
pub(super) fn angle_indicator(graph: &mut Graph, (k, times): (u32, i32), [a, b]: [ExprId; 2]) -> ExprId {
    let (phi, n) = (graph.symbol(Symbol::Coordinate(k)), graph.number(f64::from(times)));
    let phi = graph.mul(n, phi);
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

fn size_of_quadratic(graph: &mut Graph, square: ExprId, product: ExprId) -> ExprId {
    let magnitude = graph.call(Function::Abs, product);
    graph.add(square, magnitude)
}

/// The centre and squared radius of e(x² + y²) + l·(x, y) + k = 0.
fn centre_and_square(graph: &mut Graph, e: ExprId, l: [ExprId; 2], k: ExprId) -> ([ExprId; 2], ExprId) {
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
