//! Sizes of expressions, to judge whether an expression is nearly 0: estimates of its square from its terms, in which
//! nothing cancels.

use crate::expr::{ExprId, Graph, Node, Symbol};
use crate::vocabulary::Function;

/// Added to denominators, so that 0/0 becomes 0; smaller than the square of any length. In f32 this number is itself 0;
/// a margin 0/0 is then NaN, which counts as no solution.
pub(super) const DENOMINATOR_FLOOR: f64 = 1e-300;

/// Slightly more than ½, so that a/max(a, b) does not exceed 1 after rounding.
const HALF_ROUNDED_UP: f64 = 0.5 + 4.0 * f64::EPSILON;

/// The larger of two non-negative numbers plus a tiny positive number, without a conditional.
pub(super) fn larger(graph: &mut Graph, a: ExprId, b: ExprId) -> ExprId {
    let (difference, half, least) = (graph.sub(a, b), graph.number(HALF_ROUNDED_UP), graph.number(DENOMINATOR_FLOOR));
    let (apart, sum) = (graph.call(Function::Abs, difference), graph.add(a, b));
    let twice = graph.add(sum, apart);
    let larger = graph.mul(half, twice);
    graph.add(larger, least)
}

/// The smaller of two non-negative numbers, with the relative accuracy of each: a b/max(a, b).
pub(super) fn smaller(graph: &mut Graph, a: ExprId, b: ExprId) -> ExprId {
    if a == b {
        return a;
    }
    let (product, larger) = (graph.mul(a, b), larger(graph, a, b));
    graph.div(product, larger)
}

/// Σ |e|². Over boxes, the square of an absolute value is never negative, while the product e·e of an interval around 0 is.
pub(super) fn sum_of_squares(graph: &mut Graph, entries: &[ExprId]) -> ExprId {
    let zero = graph.zero();
    entries.iter().fold(zero, |sum, &entry| {
        let size = graph.call(Function::Abs, entry);
        let square = graph.square(size);
        graph.add(sum, square)
    })
}

/// The sum of the squared terms of an expression: Σ terms² for a sum, the product of the values of both factors for a
/// product, and the plain square below `depth` levels.
pub(super) fn sum_of_squared_terms(graph: &mut Graph, id: ExprId, depth: usize) -> ExprId {
    if depth == 0 {
        return graph.square(id);
    }
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) => sum_of_squared_terms(graph, a, depth - 1),
        Node::Add(a, b) | Node::Sub(a, b) => {
            let (a, b) = (sum_of_squared_terms(graph, a, depth - 1), sum_of_squared_terms(graph, b, depth - 1));
            graph.add(a, b)
        }
        Node::Mul(a, b) => {
            if is_uniform(graph, [a, b]) {
                return graph.square(id);
            }
            let (a, b) = (sum_of_squared_terms(graph, a, depth - 1), sum_of_squared_terms(graph, b, depth - 1));
            graph.mul(a, b)
        }
        _ => graph.square(id),
    }
}

/// [`sum_of_squared_terms`], in which the positions in a sum count together, so that it does not matter how far from the
/// origin a mechanism is.
pub(super) fn squared_terms_anywhere(graph: &mut Graph, id: ExprId, depth: usize) -> ExprId {
    if depth == 0 {
        return graph.square(id);
    }
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) => squared_terms_anywhere(graph, a, depth - 1),
        Node::Add(..) | Node::Sub(..) => sum_of_sizes(graph, (id, depth), is_position, squared_terms_anywhere),
        Node::Mul(a, b) => {
            if is_uniform(graph, [a, b]) {
                return graph.square(id);
            }
            let [a, b] = [a, b].map(|factor| squared_terms_anywhere(graph, factor, depth - 1));
            graph.mul(a, b)
        }
        _ => graph.square(id),
    }
}

/// An upper estimate of the square of an expression, to judge whether the expression is nearly 0: the sum of its
/// squared terms, in which every component of a rotated vector is estimated by the length of the vector. A difference
/// that is divided by something counts with its own square: x − c in (x − c)/√((x − c)² + w²) is measured by the root,
/// and not by x and c.
pub(super) fn squared_size(graph: &mut Graph, id: ExprId, depth: usize) -> ExprId {
    sized(graph, (id, depth), false)
}

/// [`squared_size`], in which the positions in a sum count together: x − c + l cos φ is measured by x − c and l cos φ, so
/// that it does not matter how far from the origin a mechanism is. Sines and cosines have the size 1. In a quotient, the
/// terms of a sum of products have sizes of their own: the derivative of a distance, (s_x d_y − s_y d_x)/|d|, is 0 where
/// s and d are parallel, and its size is about |s|.
pub(super) fn squared_size_anywhere(graph: &mut Graph, id: ExprId, depth: usize) -> ExprId {
    sized(graph, (id, depth), true)
}

/// [`squared_size`], or [`squared_size_anywhere`] if `anywhere` is set.
fn sized(graph: &mut Graph, (id, depth): (ExprId, usize), anywhere: bool) -> ExprId {
    if depth == 0 {
        return graph.square(id);
    }
    let length = |graph: &mut Graph, [x, y]: [ExprId; 2]| {
        let (x, y) = (sized(graph, (x, depth - 1), anywhere), sized(graph, (y, depth - 1), anywhere));
        graph.add(x, y)
    };
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) => sized(graph, (a, depth - 1), anywhere),
        Node::Add(..) | Node::Sub(..) if anywhere => {
            sum_of_sizes(graph, (id, depth), is_at_rest_or_coordinate, squared_size_anywhere)
        }
        Node::Add(a, b) | Node::Sub(a, b) => length(graph, [a, b]),
        Node::Mul(a, b) if is_uniform(graph, [a, b]) => graph.square(id),
        Node::Mul(..) => {
            let mut factors = Vec::new();
            write_factors(graph, (id, depth), &mut factors);
            let is_quotient = factors.iter().any(|&(factor, _)| matches!(graph.node(factor), Node::Div(..)));
            let mut product = graph.number(1.0);
            for (factor, depth) in factors {
                let is_sum = matches!(graph.node(factor), Node::Add(..) | Node::Sub(..));
                let size = match is_quotient && is_sum {
                    true if anywhere => sized_quotient(graph, (factor, depth)),
                    true => graph.square(factor),
                    false => sized(graph, (factor, depth), anywhere),
                };
                product = graph.mul(product, size);
            }
            product
        }
        Node::Div(a, b) if anywhere => {
            let (size, square) = (sized_quotient(graph, (a, depth - 1)), graph.square(b));
            graph.div(size, square)
        }
        Node::Call(Function::Sin | Function::Cos, _) if anywhere => graph.number(1.0),
        Node::RotX(r) | Node::RotY(r) => length(graph, [r.x, r.y]),
        Node::Dot(t) | Node::Cross(t) => {
            let (u, d) = (length(graph, t.u), length(graph, t.d));
            graph.mul(u, d)
        }
        _ => graph.square(id),
    }
}

/// The squared size of what is divided by something: the terms of a sum of products count by themselves, and any other
/// sum with its own square.
fn sized_quotient(graph: &mut Graph, (id, depth): (ExprId, usize)) -> ExprId {
    if depth == 0 {
        return graph.square(id);
    }
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) => sized_quotient(graph, (a, depth - 1)),
        Node::Add(a, b) | Node::Sub(a, b) if is_sum_of_products(graph, id) => {
            let [a, b] = [a, b].map(|term| sized_quotient(graph, (term, depth - 1)));
            graph.add(a, b)
        }
        Node::Add(..) | Node::Sub(..) => graph.square(id),
        Node::Mul(..) => {
            let mut factors = Vec::new();
            write_factors(graph, (id, depth), &mut factors);
            let mut product = graph.number(1.0);
            for (factor, depth) in factors {
                let size = sized_quotient(graph, (factor, depth));
                product = graph.mul(product, size);
            }
            product
        }
        _ => sized(graph, (id, depth), true),
    }
}

/// True for a sum all terms of which are products.
fn is_sum_of_products(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Add(a, b) | Node::Sub(a, b) => is_sum_of_products(graph, a) && is_sum_of_products(graph, b),
        Node::Neg(a) | Node::Opaque(a) => is_sum_of_products(graph, a),
        Node::Mul(..) => true,
        _ => false,
    }
}

/// True for the factors of a uniform or uniformly accelerated motion, v (t − t₀) or a (t − t₀)², which counts with its own
/// square: neither v t nor v t₀ is a length of the mechanism, however large both are.
fn is_uniform(graph: &Graph, factors: [ExprId; 2]) -> bool {
    let is_constant = |id: ExprId| graph.depends(id).is_static();
    factors.iter().all(|&factor| is_constant(factor) || is_power_of_clock(graph, factor))
        && !factors.iter().all(|&factor| is_constant(factor))
}

/// True for a sum of t and constants, and for products of such sums and constants.
fn is_power_of_clock(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) => is_power_of_clock(graph, a),
        Node::Mul(a, b) => is_uniform(graph, [a, b]),
        _ => is_clock(graph, id),
    }
}

/// True for a sum of t and constants.
fn is_clock(graph: &Graph, id: ExprId) -> bool {
    let is_part = |id: ExprId| graph.depends(id).is_static() || is_clock(graph, id);
    match graph.node(id) {
        Node::Symbol(Symbol::Time) => true,
        Node::Neg(a) | Node::Opaque(a) => is_clock(graph, a),
        Node::Add(a, b) | Node::Sub(a, b) => is_part(a) && is_part(b) && !graph.depends(id).is_static(),
        _ => false,
    }
}

/// True for a coordinate, as it is in Φ or as the result of an iteration, and for everything that does not move.
pub(super) fn is_at_rest_or_coordinate(graph: &Graph, id: ExprId) -> bool {
    matches!(graph.node(id), Node::Symbol(Symbol::Coordinate(_) | Symbol::Unknown(_))) || graph.depends(id).is_static()
}

/// As [`is_at_rest_or_coordinate`], but for products: squares of lengths are no positions.
fn is_position(graph: &Graph, id: ExprId) -> bool {
    !matches!(graph.node(id), Node::Mul(..)) && is_at_rest_or_coordinate(graph, id)
}

/// The square of the sum of all positions in a sum, plus the sizes of its other terms.
fn sum_of_sizes(
    graph: &mut Graph,
    (id, depth): (ExprId, usize),
    is_position: fn(&Graph, ExprId) -> bool,
    size: fn(&mut Graph, ExprId, usize) -> ExprId,
) -> ExprId {
    let (mut position, mut other_terms) = (None, Vec::new());
    write_terms(graph, (id, depth, false), is_position, (&mut position, &mut other_terms));
    let position = position.unwrap_or_else(|| graph.zero());
    let square = graph.square(position);
    other_terms.into_iter().fold(square, |sum, (term, depth)| {
        let term = size(graph, term, depth);
        graph.add(sum, term)
    })
}

/// Adds up the positions of a sum, which are the terms that `is_position` accepts, and writes its other terms, each with
/// the depth that is left for it. `negative` says that the sum is subtracted.
fn write_terms(
    graph: &mut Graph,
    (id, depth, negative): (ExprId, usize, bool),
    is_position: fn(&Graph, ExprId) -> bool,
    (position, others): (&mut Option<ExprId>, &mut Vec<(ExprId, usize)>),
) {
    match graph.node(id) {
        Node::Opaque(a) if depth > 0 => {
            write_terms(graph, (a, depth - 1, negative), is_position, (position, others));
        }
        Node::Neg(a) if depth > 0 => write_terms(graph, (a, depth - 1, !negative), is_position, (position, others)),
        Node::Add(a, b) if depth > 0 => {
            write_terms(graph, (a, depth - 1, negative), is_position, (position, others));
            write_terms(graph, (b, depth - 1, negative), is_position, (position, others));
        }
        Node::Sub(a, b) if depth > 0 => {
            write_terms(graph, (a, depth - 1, negative), is_position, (position, others));
            write_terms(graph, (b, depth - 1, !negative), is_position, (position, others));
        }
        _ if is_position(graph, id) => {
            let term = if negative { graph.neg(id) } else { id };
            *position = Some(position.map_or(term, |sum| graph.add(sum, term)));
        }
        _ => others.push((id, depth)),
    }
}

/// Writes the factors of a product, each with the depth that is left for it.
fn write_factors(graph: &Graph, (id, depth): (ExprId, usize), factors: &mut Vec<(ExprId, usize)>) {
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) if depth > 0 => write_factors(graph, (a, depth - 1), factors),
        Node::Mul(a, b) if depth > 0 => {
            [a, b].into_iter().for_each(|factor| write_factors(graph, (factor, depth - 1), factors));
        }
        _ => factors.push((id, depth)),
    }
}
