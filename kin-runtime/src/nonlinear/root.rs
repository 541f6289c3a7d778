//! A zero between two instants at which a function has different signs: Newton steps inside a bracket.
//!
//! From the better end of the bracket, t − f/ḟ is taken a little too far, so that the next value lies on the other side
//! and both ends close in; where that leaves the bracket, or does not shrink it by half in two steps, the bracket is
//! halved. Every trial is an evaluation; the bracket never loses its change of sign. After Press et al., Numerical
//! Recipes, section 9.4.

/// A function at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Value {
    pub(crate) t: f64,
    /// f, positive at the first end.
    pub(crate) f: f64,
    /// ḟ; need not be a number.
    pub(crate) rate: f64,
}

/// Most trials.
const TRIALS: usize = 200;

/// The narrowest width that is asked for between instants of size `t`.
pub(crate) fn tolerance(t: f64) -> f64 {
    let resolved = 8.0 * f64::EPSILON * t;
    (1e-12 * t).min(5e-11).max(resolved)
}

/// The interval in which `f` changes its sign, as narrow as `tolerance` where `evaluate` has an answer.
///
/// `first` counts as positive and `last` as negative or zero, whatever their last digits say.
pub(crate) fn bracket(
    first: Value,
    last: Value,
    tolerance: f64,
    mut evaluate: impl FnMut(f64) -> Option<Value>,
) -> [Value; 2] {
    let [mut lo, mut hi] = [first, last];
    let mut widths = [f64::INFINITY; 2];
    let mut refused = 0;
    for _ in 0..TRIALS {
        let width = (hi.t - lo.t).abs();
        if width <= tolerance || refused > 4 {
            break;
        }
        let middle = lo.t + 0.5 * (hi.t - lo.t);
        let slow = width > 0.5 * widths[0];
        widths = [widths[1], width];
        let t = match refused {
            0 if slow => middle,
            0 => newton(lo, hi, tolerance).unwrap_or(middle),
            // Somewhere nearer to the first end, which is the better known one.
            _ => lo.t + 0.5_f64.powi(refused) * (hi.t - lo.t),
        };
        if t == lo.t || t == hi.t {
            break;
        }
        match evaluate(t) {
            Some(value) if value.f > 0.0 => lo = value,
            Some(value) if value.f < 0.0 => hi = value,
            Some(value) if value.f == 0.0 => return [value; 2],
            _ => {
                refused += 1;
                continue;
            }
        }
        refused = 0;
    }
    [lo, hi]
}

/// The Newton step from the better end, a little too far; none where it leaves the bracket.
fn newton(lo: Value, hi: Value, tolerance: f64) -> Option<f64> {
    let (from, towards) = if lo.f.abs() <= hi.f.abs() { (lo, hi) } else { (hi, lo) };
    let ahead = 0.4 * tolerance.copysign(towards.t - from.t);
    let t = from.t - from.f / from.rate + ahead;
    let inside = (t - from.t) * (towards.t - t) > 0.0;
    inside.then_some(t)
}
