//! Closed-form solutions: roots with a sign for the mode, their margins, and the branch values that give the mode of a
//! known configuration.
//!
//! A margin is about 1 far from a singular configuration, 0 where both solutions coincide, and negative where there is
//! no solution. It also goes to 0 where a divisor of the solution is a small difference of large terms.

use super::sizes::{DENOMINATOR_FLOOR, squared_size, squared_terms_anywhere, sum_of_squared_terms};
use crate::expr::{ExprId, Graph, Symbol};
use crate::vocabulary::Function;

/// Weight of the squared terms of a sum relative to the square of the sum. The weighted terms are the larger only where
/// the terms nearly cancel.
pub(super) const TERM_WEIGHT: f64 = 1e-6;

/// [`TERM_WEIGHT`] where a and b of an angle closure are dimensions. These cannot approach 0 during a motion, and the
/// digits that small ones cost are the same everywhere: a lever that is a million times shorter than the rod at its end
/// still leaves ten of them.
const DIMENSION_WEIGHT: f64 = 1e-12;

/// What the square of a divisor is compared with: the sum of this square, the squares of `other_entries` (the other
/// coefficients of its rows) and `TERM_WEIGHT` times the squared terms of `parts`, which the divisor is made of. The
/// quotient is the margin of the divisor. `None` if there is nothing to compare it with. A constant divisor cannot
/// approach 0 during a motion: it is a dimension, such as the radius of a gear, and may be far smaller than the other
/// coefficients before digits are lost; `other_entries` are then weighted with `TERM_WEIGHT`, too.
pub(super) fn whole_of_divisor(
    graph: &mut Graph,
    square: ExprId,
    other_entries: &[ExprId],
    parts: &[ExprId],
) -> Option<ExprId> {
    let is_term = |graph: &mut Graph, part: ExprId| sum_of_squared_terms(graph, part, 8) == graph.square(part);
    let terms = parts.iter().all(|&part| is_term(graph, part));
    if terms && other_entries.is_empty() {
        return None;
    }
    let mut rest = graph.zero();
    for &other in other_entries {
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
    let (sum, half, least) = (graph.add(square, size), graph.number(0.5), graph.number(DENOMINATOR_FLOOR));
    let mean = graph.mul(half, sum);
    graph.add(mean, least)
}

/// The squared sine of the angle between two vectors: their squared cross product over the product of their squared
/// lengths.
pub(super) fn squared_sine(graph: &mut Graph, square: ExprId, [a, b]: [ExprId; 2]) -> ExprId {
    let (product, least) = (graph.mul(a, b), graph.number(DENOMINATOR_FLOOR));
    let whole = graph.add(product, least);
    graph.div(square, whole)
}

/// 1/a, kept as one value that all products share.
pub(super) fn inverse(graph: &mut Graph, a: ExprId) -> ExprId {
    let one = graph.number(1.0);
    let inverse = graph.div(one, a);
    graph.opaque(inverse)
}

/// mode · √|inside|, kept as one value.
fn signed_root(graph: &mut Graph, mode: ExprId, inside: ExprId) -> ExprId {
    let magnitude = graph.call(Function::Abs, inside);
    let root = graph.call(Function::Sqrt, magnitude);
    let w = graph.mul(mode, root);
    graph.opaque(w)
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
    let (share, quarter, least) = (graph.number(TERM_WEIGHT), graph.number(0.25), graph.number(DENOMINATOR_FLOOR));
    let first = graph.mul(e, radius);
    let between = graph.div(n2, e);
    let between = graph.mul(quarter, between);
    // r₂² differs from r₁² by the other terms.
    let squares = [first, between, off].map(|term| graph.square(term));
    let squares = squares.into_iter().reduce(|a, b| graph.add(a, b)).unwrap_or(least);
    let written = sum_of_squared_terms(graph, off, 8);
    let written = graph.mul(share, written);
    let terms = graph.add(squares, written);
    let terms = graph.mul(share, terms);
    let terms = graph.add(terms, least);
    graph.add(size, terms)
}

/// `size` plus `TERM_WEIGHT` times the squared terms of `parts`; never 0.
fn with_squared_terms(graph: &mut Graph, size: ExprId, parts: &[ExprId]) -> ExprId {
    with_weighted_terms(graph, size, parts, TERM_WEIGHT)
}

/// `size` plus `weight` times the squared terms of `parts`; never 0.
fn with_weighted_terms(graph: &mut Graph, size: ExprId, parts: &[ExprId], weight: f64) -> ExprId {
    let (mut terms, share, least) = (graph.zero(), graph.number(weight), graph.number(DENOMINATOR_FLOOR));
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
    let whole = match still {
        true => with_weighted_terms(graph, d, &[a, b, c], DIMENSION_WEIGHT),
        false => with_squared_terms(graph, d, &[a, b]),
    };
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
    let least = graph.number(DENOMINATOR_FLOOR);
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
    let t = graph.opaque(t);
    // 1 for the first root and 0 for the second: this selects a root without a conditional.
    let same = graph.mul(mode, sign);
    let same = graph.mul(half, same);
    let (first, second) = (graph.add(half, same), graph.sub(half, same));
    let [first, second] = [first, second].map(|e| graph.opaque(e));
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
