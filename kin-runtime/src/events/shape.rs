//! The course of a condition between two instants, as its values and derivatives at both ends show it.
//!
//! With s from 0 to 1 between them and f′ = h ḟ, the cubic with the values and slopes of f at both ends has the Bernstein
//! coefficients f_a, f_a + f′_a/3, f_b − f′_b/3, f_b and lies between the smallest and the largest of them. How far g and
//! ġ are from polynomials of low degree is seen from
//!
//! ```text
//! g_b − g_a − g′_a − ½ g″_a        g_a − g_b + g′_b − ½ g″_b        g′_b − g′_a − ½ (g″_a + g″_b)        g″_b − g″_a
//! ```
//!
//! which vanish for parabolas and are of third order in h otherwise, so that they overestimate the error of the cubic.
//! Several of them, since one alone may vanish by chance where g changes faster than the steps are short.

use super::sample::Sample;

/// What can happen between two instants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// g keeps its sign.
    Clear,
    /// g is zero within rounding, and so are its derivatives.
    Still,
    /// g rises or falls all the time.
    Monotone,
    /// g has one extremum.
    Turning,
    /// Anything.
    Unclear,
}

/// The course between two samples.
pub(super) fn shape(a: &Sample, b: &Sample) -> Shape {
    let h = b.t - a.t;
    let [first_a, first_b] = [a, b].map(|s| h * s.rate);
    let [second_a, second_b] = [a, b].map(|s| h * h * s.acceleration);
    let noise = a.noise.max(b.noise);
    let of_rate = (first_b - first_a - 0.5 * (second_a + second_b)).abs() + 0.1 * (second_b - second_a).abs();
    let ahead = (b.value - a.value - first_a - 0.5 * second_a).abs();
    let behind = (a.value - b.value + first_b - 0.5 * second_b).abs();
    let of_value = ahead.max(behind) + of_rate;
    let value = bernstein([a.value, b.value], [first_a, first_b]);
    if clearance(value) > of_value + noise {
        return Shape::Clear;
    }
    let rests = |s: &Sample| s.value.abs() <= noise && s.rate == 0.0 && s.acceleration == 0.0;
    if rests(a) && rests(b) {
        return Shape::Still;
    }
    // Rates that the values contradict mean nothing, however alike they are: there may be a whole wave in between.
    if clearance(bernstein([first_a, first_b], [second_a, second_b])) > of_value {
        return Shape::Monotone;
    }
    let turns = first_a * first_b < 0.0 || (first_a == 0.0) != (first_b == 0.0);
    if turns && clearance([second_a, second_b]) > 2.0 * of_value {
        return Shape::Turning;
    }
    Shape::Unclear
}

/// The Bernstein coefficients of the cubic with these ends and slopes.
fn bernstein([a, b]: [f64; 2], [slope_a, slope_b]: [f64; 2]) -> [f64; 4] {
    [a, a + slope_a / 3.0, b - slope_b / 3.0, b]
}

/// The distance from zero of numbers that have one sign; 0 of others, and of what is not a number.
fn clearance<const N: usize>(numbers: [f64; N]) -> f64 {
    let least = |sign: f64| numbers.iter().fold(f64::INFINITY, |m, v| if sign * v >= m { m } else { sign * v });
    if numbers.iter().any(|v| v.is_nan()) { 0.0 } else { least(1.0).max(least(-1.0)).max(0.0) }
}
