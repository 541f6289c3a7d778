//! Sums, products and quotients rounded down and up.
//!
//! Operations round to nearest (IEEE 754), so that the exact result lies between the two neighbours of the computed
//! one. Results that are known to be exact are kept: a product with 0, and a sum whose error is 0 by T. J. Dekker and
//! D. E. Knuth's two-sum.

/// a + b − fl(a + b); NaN where the sum or an intermediate result is not finite.
#[inline]
fn error_of_sum(a: f64, b: f64, sum: f64) -> f64 {
    let b_part = sum - a;
    (a - (sum - b_part)) + (b - b_part)
}

/// The next number below `x` if `step` is 1, and `x` itself if it is 0; for an `x` that is neither ±0, infinite nor
/// NaN.
///
/// Without a branch, because whether a sum is rounded up or down cannot be predicted.
#[inline]
fn below_by(x: f64, step: u64) -> f64 {
    // Numbers with larger bits are further from 0.
    let (bits, sign) = (x.to_bits(), x.to_bits() >> 63);
    f64::from_bits(bits.wrapping_add(2 * step * sign).wrapping_sub(step))
}

/// The next number below an `x` that is neither ±0, infinite nor NaN.
#[inline]
pub(super) fn below(x: f64) -> f64 {
    below_by(x, 1)
}

/// The next number above an `x` that is neither ±0, infinite nor NaN.
#[inline]
pub(super) fn above(x: f64) -> f64 {
    -below_by(-x, 1)
}

/// a + b, rounded down.
#[inline]
pub(super) fn sum_down(a: f64, b: f64) -> f64 {
    let sum = a + b;
    let error = error_of_sum(a, b, sum);
    // A sum that is 0 is exact, so that its error is 0.
    if error.is_finite() { below_by(sum, u64::from(error < 0.0)) } else { sum.next_down() }
}

/// a + b, rounded up.
#[inline]
pub(super) fn sum_up(a: f64, b: f64) -> f64 {
    -sum_down(-a, -b)
}

/// The next number below the computed value of a product or quotient. If the exact one is positive but so small that it is
/// computed as +0, the result is 0 and not negative, so that its root is defined.
#[inline]
fn rounded_down(x: f64) -> f64 {
    const POSITIVE_ZERO: u64 = 0;
    if x.to_bits() == POSITIVE_ZERO { 0.0 } else { x.next_down() }
}

/// a b, rounded down; 0 times anything is 0.
#[inline]
pub(super) fn product_down(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { rounded_down(a * b) }
}

/// a b, rounded up; 0 times anything is 0.
#[inline]
pub(super) fn product_up(a: f64, b: f64) -> f64 {
    -product_down(-a, b)
}

/// a / b, rounded down.
#[inline]
pub(super) fn quotient_down(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { rounded_down(a / b) }
}

/// a / b, rounded up.
#[inline]
pub(super) fn quotient_up(a: f64, b: f64) -> f64 {
    -quotient_down(-a, b)
}

/// The nearest integer to a number of absolute value at most 2⁵¹.
#[inline]
pub(super) fn integer(x: f64) -> f64 {
    const ROUND: f64 = 1.5 / f64::EPSILON;
    (x + ROUND) - ROUND
}
