//! Roots, exponentials, logarithms and powers of intervals.

use super::Interval;
use super::rounding::{integer, product_down, product_up};
use crate::scalar::Scalar;

/// ln 2 in two parts, the first of 32 bits: 0.693… and 1.90…e-10.
const LN_2: [f64; 2] = [f64::from_bits(0x3fe6_2e42_fee0_0000), f64::from_bits(0x3dea_39ef_3579_3c76)];
/// 8 u with u = 2⁻⁵³, more than the relative error of the exponential.
const RELATIVE: f64 = 4.0 * f64::EPSILON;

/// The square root; undefined where there are negative numbers. By IEEE 754 it is rounded to nearest.
pub(super) fn sqrt(x: Interval) -> Interval {
    if x.lower < 0.0 || !x.is_defined() {
        return Interval::UNDEFINED;
    }
    let lower = Scalar::sqrt(x.lower).next_down().max(0.0);
    let upper = if x.upper == 0.0 { 0.0 } else { Scalar::sqrt(x.upper).next_up() };
    Interval { lower, upper }
}

/// The exponential, which increases with its argument.
pub(super) fn exp(x: Interval) -> Interval {
    if !x.is_defined() {
        return Interval::UNDEFINED;
    }
    Interval { lower: exp_of(x.lower).0, upper: exp_of(x.upper).1 }
}

/// Bounds of the exponential of a number.
///
/// x = k ln 2 + r with |r| < 0.36: r is off by less than 0.5 u, and the Taylor polynomial of degree 14 has a remainder below
/// 0.01 u; the rounding errors of Horner's form are less than 3 u, relative to a result above 0.69.
fn exp_of(x: f64) -> (f64, f64) {
    if x > 709.0 {
        return (exp_of(709.0).0, f64::INFINITY);
    }
    if x < -700.0 {
        return (0.0, exp_of(-700.0).1);
    }
    let k = integer(x * core::f64::consts::LOG2_E);
    let r = (x - k * LN_2[0]) - k * LN_2[1];
    let mut sum = 0.0;
    for n in (1..=14).rev() {
        sum = r / f64::from(n) * (1.0 + sum);
    }
    let power = f64::from_bits(((1023 + k as i64) as u64) << 52);
    let value = (1.0 + sum) * power;
    let error = (RELATIVE * value).next_up();
    if x == 0.0 { (1.0, 1.0) } else { ((value - error).next_down(), (value + error).next_up()) }
}

/// The natural logarithm, which increases with its argument; undefined where there are numbers that are not positive.
pub(super) fn ln(x: Interval) -> Interval {
    if x.lower <= 0.0 || !x.is_bounded() {
        return Interval::UNDEFINED;
    }
    let lower = ln_of(x.lower);
    if x.is_point() { lower } else { lower.hull(ln_of(x.upper)) }
}

/// The logarithm of a number: the library's value y is an approximation, and an enclosure of x exp(−y) bounds its
/// error.
fn ln_of(x: f64) -> Interval {
    let exponent = (((x.to_bits() >> 52) & 0x7ff) as i64 - 1023).clamp(-1022, 1023);
    // Between 1 and 2, unless x is subnormal.
    let power = f64::from_bits(((1023 + exponent) as u64) << 52);
    let mantissa = Interval::from(x) / Interval::from(power);
    let guess = Scalar::ln(mantissa.midpoint());
    let off = mantissa * exp(Interval::from(-guess)) - Interval::from(1.0);
    if off.magnitude() > 0.5 || !off.is_defined() {
        return Interval::UNDEFINED;
    }
    // ln(1 + e) is between e − e² and e.
    let rest = (off - off * off).hull(off);
    let turns = Interval::from(exponent as f64);
    let ln_2 = Interval { lower: core::f64::consts::LN_2, upper: core::f64::consts::LN_2.next_up() };
    (Interval::from(guess) + rest) + turns * ln_2
}

/// An integer power.
pub(super) fn powi(x: Interval, n: i32) -> Interval {
    if n < 0 {
        let positive = powi_of(x, n.unsigned_abs());
        return Interval::from(1.0) / positive;
    }
    powi_of(x, n.unsigned_abs())
}

/// A power with an exponent that is not negative.
fn powi_of(x: Interval, n: u32) -> Interval {
    if !x.is_defined() {
        return Interval::UNDEFINED;
    }
    // For x ≥ 0, xⁿ increases with x.
    let (down, up) = (|x: f64| power(x, n, product_down).max(0.0), |x: f64| power(x, n, product_up));
    match (x.lower >= 0.0, x.upper <= 0.0, n.is_multiple_of(2)) {
        (true, ..) => Interval { lower: down(x.lower), upper: up(x.upper) },
        (_, true, true) => Interval { lower: down(-x.upper), upper: up(-x.lower) },
        (_, true, false) => Interval { lower: -up(-x.lower), upper: -down(-x.upper) },
        (_, _, true) if n == 0 => Interval::from(1.0),
        (_, _, true) => Interval { lower: 0.0, upper: up(x.magnitude()) },
        (_, _, false) => Interval { lower: -up(-x.lower), upper: up(x.upper) },
    }
}

/// A power of a number that is not negative, by repeated squaring, every product rounded by `times`.
fn power(x: f64, n: u32, times: impl Fn(f64, f64) -> f64) -> f64 {
    let (mut power, mut square, mut rest) = (None, x, n);
    while rest > 0 {
        if rest & 1 == 1 {
            power = Some(power.map_or(square, |power| times(power, square)));
        }
        square = if rest > 1 { times(square, square) } else { square };
        rest >>= 1;
    }
    power.unwrap_or(1.0)
}
