//! Sines and cosines of intervals.
//!
//! An angle x is reduced to x = k π/2 + r. With the three parts P₁ + P₂ + P₃ of π/2, of 33 bits each, k P₁, k P₂ and k
//! P₃ are exact for |k| < 2²⁰, and so is x − k P₁, because the two are within a factor of 2 of one another. The
//! remaining errors are the rounding of r and the rest of π/2 beyond P₃, below 2⁻¹¹² k: together at most u |r| + 2⁻⁸⁰,
//! u = 2⁻⁵³.
//!
//! For |r| ≤ 0.79 the Taylor polynomials of degree 17 and 16 have remainders below 0.03 u. The terms beyond the first fall
//! quickly, so that their rounding errors add up to less than 1.8 u |r| for the sine and 1.8 u for the cosine; with the error
//! of r that is less than 4 u |r| + 2⁻⁸⁰ and 4 u + 2⁻⁸⁰. None of it depends on a library.
//!
//! A processor cannot predict in which quadrant an angle is, so that nothing here branches on it.

use super::Interval;
use super::rounding::{integer, sum_down, sum_up};

/// π/2 in three parts of 33 bits: 1.57…, 6.07…e-11 and 2.02…e-21.
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3ff9_21fb_5440_0000),
    f64::from_bits(0x3dd0_b461_1a60_0000),
    f64::from_bits(0x3ba3_198a_2e00_0000),
];
/// Larger angles are not reduced.
const MAX_REDUCED_ANGLE: f64 = 1_048_576.0;
/// 4 u, the bound of relative rounding errors.
const RELATIVE: f64 = 2.0 * f64::EPSILON;
/// 2⁻⁸⁰, the bound of the absolute error of range reduction.
const ABSOLUTE: f64 = f64::from_bits((1023 - 80) << 52);

/// On intervals up to this radius functions are bounded by their value and slope in the middle: the result is wider by
/// a fraction of about this size, and takes one evaluation instead of two.
const MAX_LINEAR_RADIUS: f64 = 1e-4;

/// 1/3!, 1/5!, … with signs.
const SINE: [f64; 8] = [
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
];
/// 1/4!, 1/6!, … with signs.
const COSINE: [f64; 8] = [
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
    0.0,
];

/// An angle with its sine and cosine.
struct Turned {
    /// The angle is k π/2 + r.
    k: i64,
    r: f64,
    sin: Interval,
    cos: Interval,
}

/// All numbers at most `error` away from `value`, within [−1, 1].
#[inline]
fn near(value: f64, error: f64) -> Interval {
    Interval { lower: sum_down(value, -error).max(-1.0), upper: sum_up(value, error).min(1.0) }
}

/// Sine and cosine of an angle of at most [`MAX_REDUCED_ANGLE`].
#[inline]
fn turned(x: f64) -> Turned {
    if x == 0.0 {
        return Turned { k: 0, r: 0.0, sin: Interval::ZERO, cos: Interval { lower: 1.0, upper: 1.0 } };
    }
    let k = integer(x * core::f64::consts::FRAC_2_PI);
    let first = x - k * HALF_PI[0];
    let second = k * HALF_PI[1];
    let difference = first - second;
    // The rounding error of `difference`.
    let part = difference - first;
    let lost = (first - (difference - part)) - (second + part);
    let r = difference + (lost - k * HALF_PI[2]);
    let z = r * r;
    let sin = (r + r * (z * polynomial(&SINE, z)), RELATIVE * r.abs() + ABSOLUTE);
    let cos = (1.0 - (0.5 * z - z * (z * polynomial(&COSINE, z))), RELATIVE + ABSOLUTE);
    let k = k as i64;
    let odd = k & 1 != 0;
    let enclosed = |(value, error): (f64, f64), negative: i64| near(signed(value, negative), error);
    Turned { k, r, sin: enclosed(choose(odd, cos, sin), k & 2), cos: enclosed(choose(odd, sin, cos), (k + 1) & 2) }
}

/// Σ cₖ zᵏ, the terms added in pairs, which can be computed in parallel.
#[inline]
fn polynomial(c: &[f64; 8], z: f64) -> f64 {
    let (z2, pair) = (z * z, |k: usize| c[k] + c[k + 1] * z);
    (pair(0) + pair(2) * z2) + (pair(4) + pair(6) * z2) * (z2 * z2)
}

/// `a` if `first`, `b` otherwise, by bits: a choice of integers needs no branch.
#[inline]
fn choose(first: bool, a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let chosen = |a: f64, b: f64| f64::from_bits(if first { a.to_bits() } else { b.to_bits() });
    (chosen(a.0, b.0), chosen(a.1, b.1))
}

/// −`value` if `two` is 2, `value` if it is 0.
#[inline]
fn signed(value: f64, two: i64) -> f64 {
    f64::from_bits(value.to_bits() ^ ((two as u64) << 62))
}

/// The values that a function has within `radius` of a place, where it has `value` and a derivative of the size of `slope`, if
/// its second derivative is at most 1.
///
/// |f(x + d) − f(x)| ≤ |d| (|f′| + |d|/2). All factors are positive, so that four roundings are less than 4 ε of the product.
#[inline]
fn widened(value: Interval, slope: Interval, radius: f64) -> Interval {
    if radius == 0.0 {
        return value;
    }
    let by = radius * (slope.magnitude() + radius) * (1.0 + 4.0 * f64::EPSILON) + f64::MIN_POSITIVE;
    Interval { lower: sum_down(value.lower, -by).max(-1.0), upper: sum_up(value.upper, by).min(1.0) }
}

/// Sine and cosine of all angles of an interval.
#[inline]
pub(super) fn sin_cos(x: Interval) -> (Interval, Interval) {
    if !x.is_defined() {
        return (Interval::UNDEFINED, Interval::UNDEFINED);
    }
    if x.magnitude() > MAX_REDUCED_ANGLE {
        let all = Interval { lower: -1.0, upper: 1.0 };
        return (all, all);
    }
    let radius = x.radius();
    if radius <= MAX_LINEAR_RADIUS {
        let middle = turned(x.midpoint());
        return (widened(middle.sin, middle.cos, radius), widened(middle.cos, middle.sin, radius));
    }
    let from = turned(x.lower);
    let to = turned(x.upper);
    let (mut sin, mut cos) = (from.sin.hull(to.sin), from.cos.hull(to.cos));
    // The multiples of π/2 in between; one that may be in between counts.
    let first = if from.r > ABSOLUTE { from.k + 1 } else { from.k };
    let last = if to.r < -ABSOLUTE { to.k - 1 } else { to.k };
    // Whether one of them is at this many quarters of a turn, up to whole turns.
    let has = |quarter: i64| (quarter - first) & 3 <= last - first;
    cos.upper = if has(0) { 1.0 } else { cos.upper };
    sin.upper = if has(1) { 1.0 } else { sin.upper };
    cos.lower = if has(2) { -1.0 } else { cos.lower };
    sin.lower = if has(3) { -1.0 } else { sin.lower };
    (sin, cos)
}

/// The angle of the vector (x, y) for all numbers of both; undefined where the box holds the origin, and where it holds
/// vectors on both sides of the negative x axis, where the angle jumps.
///
/// The angle θ that the library gives is an approximation. The enclosures of its sine and cosine enclose the component
/// of the vector across the direction of θ, and thereby the error of θ.
pub(super) fn atan2(y: Interval, x: Interval) -> Interval {
    let jumps = y.lower < 0.0 && y.upper >= 0.0 && x.lower < 0.0;
    let origin = x.contains(0.0) && y.contains(0.0);
    if !(x.is_bounded() && y.is_bounded()) || jumps || origin {
        return Interval::UNDEFINED;
    }
    // In a box without the origin the angle has its extremes at corners.
    let corner = |y: f64, x: f64| angle(y + 0.0, x);
    let mut all = corner(y.lower, x.lower);
    if !y.is_point() {
        all = all.hull(corner(y.upper, x.lower));
    }
    if !x.is_point() {
        all = all.hull(corner(y.lower, x.upper));
        if !y.is_point() {
            all = all.hull(corner(y.upper, x.upper));
        }
    }
    all
}

/// The angle of one vector.
fn angle(y: f64, x: f64) -> Interval {
    // Of the vector before scaling: a y that scaling makes 0 still determines on which side of the x axis the vector
    // is.
    let guess = crate::scalar::standard::atan2(y, x);
    // Scaled components whose squares neither overflow nor vanish.
    let largest = y.abs().max(x.abs());
    let scale = Interval::from(f64::from_bits(largest.to_bits() & (0x7ff << 52)));
    let (y, x) = (Interval::from(y) / scale, Interval::from(x) / scale);
    let (sin, cos) = sin_cos(Interval::from(guess));
    let along = x * cos + y * sin;
    let across = (y * cos - x * sin) / along;
    if along.lower > 0.0 {
        // The angle between the two is arctan t, t = `across`, which lies between t − t³ and t.
        Interval::from(guess) + (across - across * across * across).hull(across)
    } else {
        Interval::UNDEFINED
    }
}
