//! A root between two instants at which a function has different signs: Newton steps safeguarded by a bracket.
//!
//! The step from the better end of the bracket to t − f/ḟ is slightly extended, so that the next value lies on the
//! other side of the root and both ends converge. Where the step leaves the bracket, or two steps do not halve the
//! bracket, the bracket is bisected. Every trial is one evaluation, and the bracket always contains the change of sign.
//! After Press et al., Numerical Recipes, section 9.4.

/// The value of a function at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Value {
    pub(crate) t: f64,
    /// f, positive at the first end of the bracket.
    pub(crate) f: f64,
    /// ḟ, which may be NaN.
    pub(crate) rate: f64,
}

/// Largest number of trials.
const MAX_TRIALS: usize = 200;

/// The width at which a bracket around instants of size `t` counts as closed.
pub(crate) fn tolerance(t: f64) -> f64 {
    let resolved = 8.0 * f64::EPSILON * t;
    (1e-12 * t).min(5e-11).max(resolved)
}

/// The interval in which `f` changes its sign. Its width is at most `tolerance`, unless `evaluate` fails.
///
/// `first.f` counts as positive and `last.f` as negative or zero, regardless of rounding.
pub(crate) fn bracket(
    first: Value,
    last: Value,
    tolerance: f64,
    mut evaluate: impl FnMut(f64) -> Option<Value>,
) -> [Value; 2] {
    let [mut lo, mut hi] = [first, last];
    let mut widths = [f64::INFINITY; 2];
    let mut refused = 0;
    for _ in 0..MAX_TRIALS {
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
            // After a failure the next trial is nearer to the first end, where the motion is known.
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

/// The slightly extended Newton step from the better end; `None` where it leaves the bracket.
fn newton(lo: Value, hi: Value, tolerance: f64) -> Option<f64> {
    let (from, towards) = if lo.f.abs() <= hi.f.abs() { (lo, hi) } else { (hi, lo) };
    let ahead = 0.4 * tolerance.copysign(towards.t - from.t);
    let t = from.t - from.f / from.rate + ahead;
    let inside = (t - from.t) * (towards.t - t) > 0.0;
    inside.then_some(t)
}
