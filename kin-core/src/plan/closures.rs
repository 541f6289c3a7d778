//! Closed-form solutions: roots with a sign for the mode, their margins, and the branch values that give the mode of a
//! known configuration.
//!
//! A margin is about 1 far from a singular configuration, 0 where both solutions coincide, and negative where there is
//! no solution. It also goes to 0 where a divisor of the solution is a small difference of large terms.

use crate::expr::{ExprId, Graph, Node, Symbol};
use crate::vocabulary::Function;

/// Weight of the squared terms of a sum relative to the square of the sum. The weighted terms are the larger only where
/// the terms nearly cancel.
pub(super) const TERM_WEIGHT: f64 = 1e-6;

/// Added to denominators, so that 0/0 becomes 0; smaller than the square of any length. In f32 this number is itself 0;
/// a margin 0/0 is then NaN, which counts as no solution.
pub(super) const LEAST: f64 = 1e-300;

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
            let (a, b) = (sum_of_squared_terms(graph, a, depth - 1), sum_of_squared_terms(graph, b, depth - 1));
            graph.mul(a, b)
        }
        _ => graph.square(id),
    }
}

/// [`sum_of_squared_terms`], in which the positions in a sum count together, so that it does not matter how far from the
/// origin a mechanism is.
fn squared_terms_anywhere(graph: &mut Graph, id: ExprId, depth: usize) -> ExprId {
    if depth == 0 {
        return graph.square(id);
    }
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) => squared_terms_anywhere(graph, a, depth - 1),
        Node::Add(..) | Node::Sub(..) => {
            let (mut position, mut others) = (None, Vec::new());
            write_terms(graph, (id, depth, false), is_position, (&mut position, &mut others));
            let position = position.unwrap_or_else(|| graph.zero());
            let mut sum = graph.square(position);
            for (term, depth) in others {
                let term = squared_terms_anywhere(graph, term, depth);
                sum = graph.add(sum, term);
            }
            sum
        }
        Node::Mul(a, b) => {
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
/// that it does not matter how far from the origin a mechanism is.
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
            let (mut position, mut others) = (None, Vec::new());
            write_terms(graph, (id, depth, false), is_at_rest_or_coordinate, (&mut position, &mut others));
            let position = position.unwrap_or_else(|| graph.zero());
            let mut size = graph.square(position);
            for (term, depth) in others {
                let term = sized(graph, (term, depth), anywhere);
                size = graph.add(size, term);
            }
            size
        }
        Node::Add(a, b) | Node::Sub(a, b) => length(graph, [a, b]),
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

/// True for a coordinate, as it is in Φ or as the result of an iteration, and for everything that does not move.
fn is_at_rest_or_coordinate(graph: &Graph, id: ExprId) -> bool {
    matches!(graph.node(id), Node::Symbol(Symbol::Coordinate(_) | Symbol::Unknown(_))) || graph.depends(id).is_static()
}

/// As [`is_at_rest_or_coordinate`], but for products: squares of lengths are no positions.
fn is_position(graph: &Graph, id: ExprId) -> bool {
    !matches!(graph.node(id), Node::Mul(..)) && is_at_rest_or_coordinate(graph, id)
}

/// Adds up the positions of a sum, which are those terms that `is_position` accepts, and writes its other terms, each with
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

/// What the square of a divisor is compared with: the sum of this square, the squares of `others` (the other
/// coefficients of its rows) and `TERM_WEIGHT` times the squared terms of `parts`, which the divisor is made of. The
/// quotient is the margin of the divisor. `None` if there is nothing to compare it with. A constant divisor cannot
/// approach 0 during a motion: it is a dimension, such as the radius of a gear, and may be far smaller than the other
/// coefficients before digits are lost; `others` are then weighted with `TERM_WEIGHT`, too.
pub(super) fn whole_of_divisor(
    graph: &mut Graph,
    square: ExprId,
    others: &[ExprId],
    parts: &[ExprId],
) -> Option<ExprId> {
    let is_term = |graph: &mut Graph, part: ExprId| sum_of_squared_terms(graph, part, 8) == graph.square(part);
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
        let share = graph.number(TERM_WEIGHT);
        rest = graph.mul(share, rest);
    }
    let whole = graph.add(square, rest);
    Some(with_squared_terms(graph, whole, if terms { &[] } else { parts }))
}

/// What the square of a divisor is compared with where there is nothing but the divisor itself: the mean of the square
/// and of the squared size of the divisor.
pub(super) fn whole_of_varying(graph: &mut Graph, square: ExprId, divisor: ExprId) -> ExprId {
    let size = squared_size(graph, divisor, 8);
    let (sum, half, least) = (graph.add(square, size), graph.number(0.5), graph.number(LEAST));
    let mean = graph.mul(half, sum);
    graph.add(mean, least)
}

/// The squared sine of the angle between two vectors: their squared cross product over the product of their squared
/// lengths.
pub(super) fn squared_sine(graph: &mut Graph, square: ExprId, [a, b]: [ExprId; 2]) -> ExprId {
    let (product, least) = (graph.mul(a, b), graph.number(LEAST));
    let whole = graph.add(product, least);
    graph.div(square, whole)
}

/// 1/a, kept as one value that all products share.
pub(super) fn inverse(graph: &mut Graph, a: ExprId) -> ExprId {
    let one = graph.number(1.0);
    let inverse = graph.div(one, a);
    graph.whole(inverse)
}

/// mode · √|inside|, kept as one value.
fn signed_root(graph: &mut Graph, mode: ExprId, inside: ExprId) -> ExprId {
    let magnitude = graph.call(Function::Abs, inside);
    let root = graph.call(Function::Sqrt, magnitude);
    let w = graph.mul(mode, root);
    graph.whole(w)
}

/// `size` plus `TERM_WEIGHT` times the squared terms of `off`, the distance of the common chord of two circles from the
/// centre of the first. With the centres d apart, and with e, the product of the numbers in the places of e of both circles,
/// |n| = 2 e d and
///
/// ```text
/// off = e (r₂² − r₁² − d²) = e (r₂² − r₁²) − n²/(4 e),
/// ```
///
/// whose terms do not depend on where the circles are. The terms of `off` as it is computed grow with the square of the
/// distance from the origin; they count with the square of the weight, so that they are the larger only where this distance
/// costs more digits than that of two nearly concentric circles may.
fn with_squared_terms_of_circles(graph: &mut Graph, size: ExprId, [e, radius, n2, off]: [ExprId; 4]) -> ExprId {
    let (share, quarter, least) = (graph.number(TERM_WEIGHT), graph.number(0.25), graph.number(LEAST));
    let first = graph.mul(e, radius);
    let between = graph.div(n2, e);
    let between = graph.mul(quarter, between);
    // r₂² differs from r₁² by the other terms.
    let own = [first, between, off].map(|term| graph.square(term));
    let own = own.into_iter().reduce(|a, b| graph.add(a, b)).unwrap_or(least);
    let written = sum_of_squared_terms(graph, off, 8);
    let written = graph.mul(share, written);
    let terms = graph.add(own, written);
    let terms = graph.mul(share, terms);
    let terms = graph.add(terms, least);
    graph.add(size, terms)
}

/// `size` plus `TERM_WEIGHT` times the squared terms of `parts`; never 0.
fn with_squared_terms(graph: &mut Graph, size: ExprId, parts: &[ExprId]) -> ExprId {
    let (mut terms, share, least) = (graph.zero(), graph.number(TERM_WEIGHT), graph.number(LEAST));
    for &part in parts {
        let squares = squared_terms_anywhere(graph, part, 8);
        terms = graph.add(terms, squares);
    }
    let terms = graph.mul(share, terms);
    let terms = graph.add(terms, least);
    graph.add(size, terms)
}

/// Solves a cos φ + b sin φ = c: cos φ and sin φ multiplied by a² + b², the inverse of a² + b², and the margin.
pub(super) fn angle(graph: &mut Graph, mode: ExprId, [a, b, c]: [ExprId; 3]) -> ([ExprId; 2], ExprId, ExprId) {
    // The solution is w = ±√(a² + b² − c²), cos φ = (a c − b w)/(a² + b²), sin φ = (b c + a w)/(a² + b²).
    let (d, square) = (graph.plain_dot([a, b], [a, b]), graph.square(c));
    let inside = graph.sub(d, square);
    let inverse = inverse(graph, d);
    let w = signed_root(graph, mode, inside);
    let turned = [graph.plain_cross([a, b], [w, c]), graph.plain_dot([b, a], [c, w])];
    // If two pins coincide, a and b vanish and the direction is undefined. Constant a and b are small compared with c
    // only because of the dimensions; c is then included in the comparison.
    let still = [a, b].iter().all(|&e| graph.depends(e).is_static());
    let parts = [a, b, c];
    let whole = with_squared_terms(graph, d, if still { &parts } else { &parts[..2] });
    (turned, inverse, graph.div(inside, whole))
}

/// Solves a x² + b x + c = 0: x = (±√(h² − a c) − h)/a with h = b/2, and the margin.
///
/// With T = h + sgn(h) √(h² − a c), in which no digits cancel, the roots are −c/T and −T/a. As a goes to 0, the first
/// root goes to −c/b and the second to infinity.
pub(super) fn quadratic(graph: &mut Graph, mode: ExprId, [a, b, c]: [ExprId; 3]) -> (ExprId, ExprId) {
    let half = graph.number(0.5);
    let h = graph.mul(half, b);
    let (square, product) = (graph.square(h), graph.mul(a, c));
    let inside = graph.sub(square, product);
    let size = size_of_quadratic(graph, square, [a, c, product]);
    let least = graph.number(LEAST);
    let size = graph.add(size, least);
    let margin = graph.div(inside, size);
    if graph.is_zero(h) {
        // Both roots go to infinity with 1/√a.
        let w = signed_root(graph, mode, inside);
        let share = share_of_leading(graph, a);
        return (graph.div(w, a), share.map_or(margin, |share| graph.mul(margin, share)));
    }
    let sign = graph.sign(h);
    let w = signed_root(graph, sign, inside);
    let t = graph.add(h, w);
    let t = graph.whole(t);
    // 1 for the first root and 0 for the second: this selects a root without a conditional.
    let same = graph.mul(mode, sign);
    let same = graph.mul(half, same);
    let (first, second) = (graph.add(half, same), graph.sub(half, same));
    let [first, second] = [first, second].map(|e| graph.whole(e));
    let (top, bottom) = (graph.plain_dot([first, second], [c, t]), graph.plain_dot([first, second], [t, a]));
    let x = graph.div(top, bottom);
    let x = graph.neg(x);
    let Some(share) = share_of_leading(graph, a) else { return (x, margin) };
    let share = graph.mul(second, share);
    let stays = graph.add(first, share);
    (x, graph.mul(margin, stays))
}

/// The square of the leading coefficient of a quadratic equation relative to the square and the squared terms of it, which
/// goes to 0 with the coefficient; `None` for a literal.
fn share_of_leading(graph: &mut Graph, a: ExprId) -> Option<ExprId> {
    if graph.literal(a).is_some() {
        return None;
    }
    let a2 = graph.square(a);
    let whole = with_squared_terms(graph, a2, &[a]);
    Some(graph.div(a2, whole))
}

/// Intersects a circle e(x² + y²) + l·(x, y) + k = 0 with a line n·(x, y) + m = 0: x and y, and the margin. If the
/// line is the common chord of two circles, `second` is the number in the place of e of the second one.
pub(super) fn circle(
    graph: &mut Graph,
    mode: ExprId,
    [e, lx, ly, k, nx, ny, m]: [ExprId; 7],
    second: Option<ExprId>,
) -> ([ExprId; 2], ExprId) {
    let ([x0, y0], radius) = centre_and_square(graph, e, [lx, ly], k);
    // The signed distance of the line from the centre and half the chord, both multiplied by |n|.
    let (off, n2) = (graph.plain_dot([nx, ny], [x0, y0]), graph.plain_dot([nx, ny], [nx, ny]));
    let off = graph.add(off, m);
    let (full, square) = (graph.mul(radius, n2), graph.square(off));
    let inside = graph.sub(full, square);
    let w = signed_root(graph, mode, inside);
    let (dx, dy) = (graph.plain_dot([off, w], [nx, ny]), graph.plain_cross([w, off], [ny, nx]));
    let [dx, dy] = [dx, dy].map(|d| graph.div(d, n2));
    let at = [graph.sub(x0, dx), graph.add(y0, dy)];
    // For concentric circles n is 0, and there is no line.
    let size = graph.call(Function::Abs, full);
    let size = match second {
        Some(f) => {
            let e = graph.mul(e, f);
            with_squared_terms_of_circles(graph, size, [e, radius, n2, off])
        }
        None => with_squared_terms(graph, size, &[off]),
    };
    (at, graph.div(inside, size))
}

/// The branch value of an angle closure, (a sin nφ − b cos nφ)/√(a² + b²) = ±w/√(a² + b²).
pub(super) fn angle_branch_value(graph: &mut Graph, (k, times): (u32, i32), [a, b]: [ExprId; 2]) -> ExprId {
    let (phi, n) = (graph.symbol(Symbol::Coordinate(k)), graph.number(f64::from(times)));
    let phi = graph.mul(n, phi);
    // The second component of A(φ)(a, −b).
    let minus_b = graph.neg(b);
    let w = graph.rotate(phi, [a, minus_b])[1];
    let d = graph.plain_dot([a, b], [a, b]);
    let size = graph.call(Function::Sqrt, d);
    graph.div(w, size)
}

/// The branch value of a quadratic closure, (a x + b/2)/√(b²/4 + |a c|), or a x/√(|a| |terms of c|) where b is 0.
pub(super) fn quadratic_branch_value(graph: &mut Graph, k: u32, [a, b, c]: [ExprId; 3]) -> ExprId {
    let (x, half) = (graph.symbol(Symbol::Coordinate(k)), graph.number(0.5));
    let (ax, half) = (graph.mul(a, x), graph.mul(half, b));
    let (square, product) = (graph.square(half), graph.mul(a, c));
    let size = size_of_quadratic(graph, square, [a, c, product]);
    let (w, size) = (graph.add(ax, half), graph.call(Function::Sqrt, size));
    graph.div(w, size)
}

/// b²/4 + |a c|, with which b²/4 − a c is compared. Without the linear term there is nothing but a c, which is then
/// measured by the terms of c.
fn size_of_quadratic(graph: &mut Graph, square: ExprId, [a, c, product]: [ExprId; 3]) -> ExprId {
    let magnitude = graph.call(Function::Abs, product);
    if !graph.is_zero(square) {
        return graph.add(square, magnitude);
    }
    let terms = sum_of_squared_terms(graph, c, 8);
    let (size, a) = (graph.call(Function::Sqrt, terms), graph.call(Function::Abs, a));
    graph.mul(a, size)
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

/// The branch value of a circle and a line, perp(n)·(p − centre)/(|n| r).
pub(super) fn circle_branch_value(graph: &mut Graph, at: [u32; 2], [e, lx, ly, k, nx, ny]: [ExprId; 6]) -> ExprId {
    let ([x0, y0], radius) = centre_and_square(graph, e, [lx, ly], k);
    let [x, y] = at.map(|k| graph.symbol(Symbol::Coordinate(k)));
    let [dx, dy] = [graph.sub(x, x0), graph.sub(y, y0)];
    let (w, n2) = (graph.plain_cross([nx, ny], [dx, dy]), graph.plain_dot([nx, ny], [nx, ny]));
    let full = graph.mul(n2, radius);
    let magnitude = graph.call(Function::Abs, full);
    let size = graph.call(Function::Sqrt, magnitude);
    graph.div(w, size)
}
