//! Closures by elimination: at a given angle of one link, intersections of circles give all others, and the equation of
//! one length remains. The product of its residuals over all intersections, real and complex, is a rational function of
//! the cosine and the sine of the angle, without square roots, and its zeros are the closures.

use kin_runtime::nalgebra::Complex;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Numbers with square roots.
pub(crate) trait Field:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;

    /// A square root, the first or the second one that is taken on the way.
    fn root(self, which: Which) -> Self;
}

/// Of two intersections of circles, one after the other.
#[derive(Clone, Copy)]
pub(crate) enum Which {
    First,
    Second,
}

impl Field for Complex<f64> {
    const ZERO: Self = Self::new(0.0, 0.0);
    const ONE: Self = Self::new(1.0, 0.0);

    fn root(self, _: Which) -> Self {
        let (half, turn) = (self.re.hypot(self.im).sqrt(), 0.5 * self.im.atan2(self.re));
        Self::new(half * turn.cos(), half * turn.sin())
    }
}

pub(crate) type Place<F> = [F; 2];

/// The product of the misses of a structure with these pins, in a closure in which all angles are 0, at the cosine and the sine
/// of an angle of one link.
pub(crate) type Elimination<F> = fn(&[Place<F>; 9], [F; 2]) -> F;

fn difference<F: Field>(p: Place<F>, q: Place<F>) -> [F; 2] {
    [q[0] - p[0], q[1] - p[1]]
}

fn square<F: Field>(p: Place<F>, q: Place<F>) -> F {
    let [x, y] = difference(p, q);
    x * x + y * y
}

/// Where a link with pins p, q and r in its closure has r when p and q are elsewhere.
fn carried<F: Field>([p0, q0, r0]: [Place<F>; 3], p: Place<F>, q: Place<F>) -> Place<F> {
    let size = square(p0, q0);
    let ([u0, v0], [u, v]) = (difference(p0, q0), difference(p, q));
    turned(p, difference(p0, r0), [(u * u0 + v * v0) / size, (v * u0 - u * v0) / size])
}

/// A vector of a link, turned by an angle, from a place.
fn turned<F: Field>(from: Place<F>, [x, y]: [F; 2], [cos, sin]: [F; 2]) -> Place<F> {
    [from[0] + cos * x - sin * y, from[1] + sin * x + cos * y]
}

/// Both places at these squared distances from two others.
fn meet<F: Field>(which: Which, [p, q]: [Place<F>; 2], [from_p, from_q]: [F; 2]) -> [Place<F>; 2] {
    let size = square(p, q);
    let along = (size + from_p - from_q) / (size + size);
    let across = (from_p / size - along * along).root(which);
    let [u, v] = difference(p, q);
    [across, -across].map(|h| [p[0] + along * u - h * v, p[1] + along * v + h * u])
}

/// One link at a given angle, and how far from a place its end is: a dyad.
pub(crate) fn dyad<F: Field>(pins: &[Place<F>; 9], angle: [F; 2]) -> F {
    let [a, b, c, ..] = *pins;
    square(turned(a, difference(a, b), angle), c) - square(b, c)
}

/// A platform with three corners on rods from given places: a triad. The differences of two distances' equations are linear in
/// the place of the platform; their solution is inserted in one of them.
pub(crate) fn triad<F: Field>(pins: &[Place<F>; 9], angle: [F; 2]) -> F {
    let [centre, corners @ .., _, _] = *pins;
    let [a, b, c, elbows @ ..] = corners;
    let away = [a, b, c].into_iter().zip(elbows).map(|(corner, elbow)| {
        let length = square(corner, elbow);
        (difference(elbow, turned([F::ZERO; 2], difference(centre, corner), angle)), length)
    });
    let away: Vec<([F; 2], F)> = away.collect();
    let ([x, y], own) = away[0];
    // |p + w|² = l², minus the equation of the first corner.
    let row = |k: usize| {
        let ([u, v], length) = away[k];
        let rest = length - u * u - v * v - own + x * x + y * y;
        ([u - x + u - x, v - y + v - y], rest)
    };
    let (([a, b], e), ([c, d], f)) = (row(1), row(2));
    let determinant = a * d - b * c;
    let p = [(e * d - b * f) / determinant, (a * f - e * c) / determinant];
    square([-x, -y], p) - own
}

/// Four ternary links, one of which holds the other three, at an angle of the first of these.
pub(crate) fn star<F: Field>(pins: &[Place<F>; 9], angle: [F; 2]) -> F {
    let [g1, g2, g3, a12, b21, b23, c32, c31, a13] = *pins;
    let [a, c] = [a12, a13].map(|pin| turned(g1, difference(g1, pin), angle));
    let mut product = F::ONE;
    for two in meet(Which::First, [g2, a], [square(g2, b21), square(a12, b21)]) {
        let end = carried([g2, b21, b23], g2, two);
        for three in meet(Which::Second, [g3, c], [square(g3, c31), square(a13, c31)]) {
            product = product * (square(end, carried([g3, c31, c32], g3, three)) - square(b23, c32));
        }
    }
    product
}

/// Four ternary links in a row, at an angle of the last but one.
pub(crate) fn chain<F: Field>(pins: &[Place<F>; 9], angle: [F; 2]) -> F {
    let [j13, j14, j24, e1, e2, f2, f3, h3, h4] = *pins;
    let [j, h] = [j24, h4].map(|pin| turned(j14, difference(j14, pin), angle));
    let mut product = F::ONE;
    for two in meet(Which::First, [j, e1], [square(j24, e2), square(e1, e2)]) {
        let end = carried([j24, e2, f2], j, two);
        for three in meet(Which::Second, [j13, h], [square(j13, h3), square(h3, h4)]) {
            product = product * (square(end, carried([j13, h3, f3], j13, three)) - square(f2, f3));
        }
    }
    product
}

/// Two ternary links with a common pin on a quaternary one, at an angle of a binary link.
pub(crate) fn couplers<F: Field>(pins: &[Place<F>; 9], angle: [F; 2]) -> F {
    let [a0, b0, c0, d0, a, b, c, d, p] = *pins;
    let first = turned(a0, difference(a0, a), angle);
    let mut product = F::ONE;
    for second in meet(Which::First, [first, b0], [square(a, b), square(b0, b)]) {
        let pin = carried([a, b, p], first, second);
        for third in meet(Which::Second, [pin, c0], [square(p, c), square(c0, c)]) {
            product = product * (square(carried([p, c, d], pin, third), d0) - square(d, d0));
        }
    }
    product
}
