//! The course of a condition between two instants, estimated from its values and derivatives at both ends.
//!
//! Let s run from 0 to 1 between the instants and f′ = h ḟ. The cubic with the values and slopes of f at both ends has
//! the Bernstein coefficients f_a, f_a + f′_a/3, f_b − f′_b/3, f_b and lies between the smallest and the largest of
//! them. The deviation of g and ġ from polynomials of low degree is estimated by
//!
//! ```text
//! g_b − g_a − g′_a − ½ g″_a        g_a − g_b + g′_b − ½ g″_b        g′_b − g′_a − ½ (g″_a + g″_b)        g″_b − g″_a
//! ```
//!
//! which vanish for parabolas and are of third order in h otherwise, so that they overestimate the error of the cubic.
//! Several of them are used, since one alone may vanish by chance where g oscillates within a step.
//!
//! All of them may vanish by chance, too: a g that oscillates between two instants can have the values and derivatives
//! of a parabola there. So two samples alone are never trusted. The quintic with the value, rate and acceleration of
//! two instants is compared with a third sample between them (`doubt`), and the difference counts as a further error of
//! g.

use super::sample::Sample;
use crate::quintic::quintic;

/// The possible courses of g between two instants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CurveShape {
    /// g keeps its sign.
    Clear,
    /// g and its derivatives are zero within rounding.
    Still,
    /// g is monotone.
    Monotone,
    /// g has one extremum.
    Turning,
    /// None of the others can be concluded.
    Unclear,
}

/// Distance from either end (of an interval of length 1) within which a third sample says too little about the rest.
const TOO_NEAR_AN_END: f64 = 0.15;

/// A bound of the difference between g and the interpolation of the samples `a` and `b`, estimated from a sample `m`
/// between them; infinite where `m` is too near to an end.
///
/// With s as in the module, the error of the quintic with value, rate and acceleration of both ends begins with C s³(1
/// − s)³. In the middle its value is C/64 and its second derivative 3/8 C in size. An error that is odd about the
/// middle appears in the first derivative there, eight times as large as its largest value. So all three are compared
/// with the sample, with these weights.
pub(super) fn doubt(a: &Sample, m: &Sample, b: &Sample) -> f64 {
    let h = b.t - a.t;
    let s = (m.t - a.t) / h;
    if !(TOO_NEAR_AN_END..=1.0 - TOO_NEAR_AN_END).contains(&s) {
        return f64::INFINITY;
    }
    let [a_numbers, m_numbers, b_numbers] = [a, m, b].map(|s| [s.value, h * s.rate, h * h * s.acceleration]);
    let [value, first, second] = quintic([a_numbers, b_numbers], s);
    let [value_m, first_m, second_m] = m_numbers;
    // The sum is used instead of the maximum, because it propagates NaN.
    let missed = (value - value_m).abs() + (first - first_m).abs() / 8.0 + (second - second_m).abs() / 24.0;
    let off_centre = 4.0 * s * (1.0 - s);
    // A difference within rounding does not count.
    let noise = a.noise.max(m.noise).max(b.noise);
    let missed = if missed <= 2.0 * noise { 0.0 } else { missed };
    SAFETY_FACTOR * missed / off_centre.powi(3)
}

/// Safety factor between the difference at the third sample and the bound of the error elsewhere.
const SAFETY_FACTOR: f64 = 8.0;

/// True if the bound `doubt` is small compared with the change of g between the samples.
pub(super) fn is_known(a: &Sample, b: &Sample, doubt: f64) -> bool {
    let h = b.t - a.t;
    let swing: f64 = [a, b].iter().map(|s| (h * s.rate).abs() + (h * h * s.acceleration).abs()).sum();
    doubt <= MAX_DOUBT * swing
}

/// The largest ratio of `doubt` to the change of g that [`is_known`] accepts.
const MAX_DOUBT: f64 = 0.1;

/// The course of g between two samples, whose interpolation is accurate to `doubt`.
pub(super) fn shape(a: &Sample, b: &Sample, doubt: f64) -> CurveShape {
    let h = b.t - a.t;
    let [first_a, first_b] = [a, b].map(|s| h * s.rate);
    let [second_a, second_b] = [a, b].map(|s| h * h * s.acceleration);
    let noise = a.noise.max(b.noise);
    let of_rate = (first_b - first_a - 0.5 * (second_a + second_b)).abs() + 0.1 * (second_b - second_a).abs();
    let ahead = (b.value - a.value - first_a - 0.5 * second_a).abs();
    let behind = (a.value - b.value + first_b - 0.5 * second_b).abs();
    let of_value = ahead.max(behind) + of_rate + doubt;
    let value = bernstein([a.value, b.value], [first_a, first_b]);
    if clearance(value) > of_value + noise {
        return CurveShape::Clear;
    }
    let rests = |s: &Sample| s.value.abs() <= noise && s.rests();
    if rests(a) && rests(b) {
        return CurveShape::Still;
    }
    // Rates that contradict the values are not trusted, even where they are equal: there may be a whole wave in
    // between.
    if clearance(bernstein([first_a, first_b], [second_a, second_b])) > of_value {
        return CurveShape::Monotone;
    }
    let turns = first_a * first_b < 0.0 || (first_a == 0.0) != (first_b == 0.0);
    if turns && clearance([second_a, second_b]) > 2.0 * of_value {
        return CurveShape::Turning;
    }
    CurveShape::Unclear
}

/// The Bernstein coefficients of the cubic with these values and slopes at its ends.
fn bernstein([a, b]: [f64; 2], [slope_a, slope_b]: [f64; 2]) -> [f64; 4] {
    [a, a + slope_a / 3.0, b - slope_b / 3.0, b]
}

/// The smallest distance from zero of numbers that all have the same sign; 0 for mixed signs and for NaN.
fn clearance<const N: usize>(numbers: [f64; N]) -> f64 {
    let least = |sign: f64| numbers.iter().fold(f64::INFINITY, |m, v| if sign * v >= m { m } else { sign * v });
    if numbers.iter().any(|v| v.is_nan()) { 0.0 } else { least(1.0).max(least(-1.0)).max(0.0) }
}
