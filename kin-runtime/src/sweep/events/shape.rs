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
//!
//! All of them may vanish by chance, too: g that makes many waves between two instants can have the values and derivatives
//! of a parabola there. So nothing is believed of two samples alone. The quintic with value, rate and acceleration of two
//! instants is held against a third sample between them (`doubt`), and what it misses counts as a further error of g.

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

/// Places between two instants at which a third sample says nothing of the rest.
const TOO_NEAR_AN_END: f64 = 0.15;

/// By how much g may differ from what the samples `a` and `b` say of it, as a sample `m` between them shows; infinite
/// where `m` is not well between them.
///
/// With s as in the module, the error of the quintic with value, rate and acceleration of both ends begins with
/// C s³(1 − s)³. In the middle that is 1/64 of C in value and 3/8 of it in the second derivative, and an error that is odd
/// about the middle shows in the first derivative there, eight times as large as it gets in value. So all three are held
/// against the sample, with these weights.
pub(super) fn doubt(a: &Sample, m: &Sample, b: &Sample) -> f64 {
    let h = b.t - a.t;
    let s = (m.t - a.t) / h;
    if !(TOO_NEAR_AN_END..=1.0 - TOO_NEAR_AN_END).contains(&s) {
        return f64::INFINITY;
    }
    let [first_a, first_b, first_m] = [a, b, m].map(|s| h * s.rate);
    let [second_a, second_b, second_m] = [a, b, m].map(|s| h * h * s.acceleration);
    let gap = b.value - a.value - first_a - 0.5 * second_a;
    let rise = first_b - first_a - second_a;
    let bend = second_b - second_a;
    let c3 = 10.0 * gap - 4.0 * rise + 0.5 * bend;
    let c4 = -15.0 * gap + 7.0 * rise - bend;
    let c5 = 6.0 * gap - 3.0 * rise + 0.5 * bend;
    let value = a.value + s * (first_a + s * (0.5 * second_a + s * (c3 + s * (c4 + s * c5))));
    let first = first_a + s * (second_a + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)));
    let second = second_a + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5));
    // The sum, and not the largest, so that what is not a number stays that.
    let missed = (value - m.value).abs() + (first - first_m).abs() / 8.0 + (second - second_m).abs() / 24.0;
    let off_centre = 4.0 * s * (1.0 - s);
    // Rounding is no sign of a wave.
    let noise = a.noise.max(m.noise).max(b.noise);
    let missed = if missed <= 2.0 * noise { 0.0 } else { missed };
    CAUTION * missed / off_centre.powi(3)
}

/// What two samples say is believed within so many times what they miss at a third.
const CAUTION: f64 = 8.0;

/// True where g differs from what two samples say by little of what it changes between them.
pub(super) fn is_known(a: &Sample, b: &Sample, doubt: f64) -> bool {
    let h = b.t - a.t;
    let swing: f64 = [a, b].iter().map(|s| (h * s.rate).abs() + (h * h * s.acceleration).abs()).sum();
    doubt <= KNOWN * swing
}

/// Share of the change of g that [`is_known`] allows.
const KNOWN: f64 = 0.1;

/// The course between two samples, of which g differs by up to `doubt`.
pub(super) fn shape(a: &Sample, b: &Sample, doubt: f64) -> Shape {
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
