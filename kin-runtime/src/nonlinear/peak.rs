//! The greatest value of a function between two places, to rounding where it is smooth.
//!
//! The function is interpolated at Chebyshev points,
//!
//! ```text
//! x_j = −cos(π j/n),   f(x) ≈ Σ c_k T_k(x),   c_k = (2/n) Σ″ (−1)^k f(x_j) cos(π j k/n)
//! ```
//!
//! where Σ″ halves its first and last term, and c_0 and c_n are halved as well (Clenshaw and Curtis 1960). Where the
//! last coefficients are as small as rounding, the interpolant equals the function to rounding, and its greatest value
//! is found where its derivative is 0. Otherwise the same is done between the neighbours of the greatest of the values.
//! A function that is smooth at no scale has a kink there.

/// The degree n of interpolants.
const DEGREE: usize = 12;
/// Last coefficients up to this, relative to the function's size, are as small as rounding: less strictly in later
/// rounds, which occur where values are known to fewer digits.
const ROUNDING: [f64; 5] = [1e-14, 1e-13, 1e-12, 1e-11, 1e-10];
/// The same, relative to the function's variation in the interval.
const RESOLVED_VARIATION: f64 = 1e-11;
/// Last coefficients above this, relative to the variation, mean that the interpolant does not represent the function.
const UNRESOLVED_VARIATION: f64 = 1e-3;
/// Variations below this, relative to the size, are too small to show a shape.
const FLAT_VARIATION: f64 = 1e-7;
/// Intervals this small, relative to the whole range, in which a function is not smooth yet have a kink.
const MIN_INTERVAL: f64 = 1e-12;
/// Largest number of intervals, each within the one before.
const ROUNDS: usize = 60;
/// Number of values of an interpolant, per interval between its points, among which the greatest is sought.
const SAMPLES_PER_INTERVAL: usize = 8;

/// The greatest value of a function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Peak {
    /// Where.
    pub(crate) at: f64,
    /// The value.
    pub(crate) value: f64,
    /// False where the function has a kink, or is not resolved.
    pub(crate) smooth: bool,
    /// False where the search ended because values were missing: the greatest of those that were found.
    pub(crate) resolved: bool,
}

/// The greatest value between `a` and `b`, which are in a range of this length. `sample` gives the values at places in
/// order from `a` to `b`; `None` or a NaN ends the search with the greatest value so far.
pub(crate) fn peak(
    mut sample: impl FnMut(&[f64]) -> Option<Vec<f64>>,
    [mut a, mut b]: [f64; 2],
    range: f64,
) -> Option<Peak> {
    let (mut best, mut rough): (Option<Peak>, bool) = (None, false);
    let unresolved = |best: Option<Peak>| best.map(|best| Peak { resolved: false, ..best });
    for round in 0..ROUNDS {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let place = |j: usize| match j {
            0 => a,
            DEGREE => b,
            _ => middle - half * (core::f64::consts::PI * j as f64 / DEGREE as f64).cos(),
        };
        let places: Vec<f64> = (0..=DEGREE).map(place).collect();
        let Some(values) = sample(&places).filter(|values| values.len() == places.len()) else {
            return unresolved(best);
        };
        if !values.iter().all(|value| value.is_finite()) {
            return unresolved(best);
        }
        let top = (0..=DEGREE).fold(0, |top, j| if values[j] > values[top] { j } else { top });
        if best.is_none_or(|best| values[top] > best.value) {
            best = Some(Peak { at: places[top], value: values[top], smooth: false, resolved: true });
        }
        let coefficients = interpolate(&values);
        let tail = coefficients[DEGREE - 2..].iter().fold(0.0_f64, |tail, c| tail.max(c.abs()));
        let [low, high] = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
        let (size, variation) = (low.abs().max(high.abs()), high - low);
        let shows = variation > FLAT_VARIATION * size;
        if tail <= ROUNDING[round.min(ROUNDING.len() - 1)] * size + RESOLVED_VARIATION * variation {
            if rough && !shows {
                // The function was not smooth in any interval until it became flat.
                return best;
            }
            let x = greatest(&coefficients);
            let at = if x == -1.0 {
                a
            } else if x == 1.0 {
                b
            } else {
                middle + half * x
            };
            return Some(Peak { at, value: evaluate(&coefficients, x), smooth: true, resolved: true });
        }
        if shows {
            rough = tail > UNRESOLVED_VARIATION * variation;
        }
        (a, b) = (places[top.saturating_sub(1)], places[(top + 1).min(DEGREE)]);
        if (b - a).abs() <= (MIN_INTERVAL * range.abs()).max(8.0 * f64::EPSILON * a.abs().max(b.abs())) {
            return best;
        }
    }
    best
}

/// The coefficients of the interpolant.
fn interpolate(values: &[f64]) -> [f64; DEGREE + 1] {
    let n = DEGREE as f64;
    let mut coefficients = [0.0; DEGREE + 1];
    for (k, coefficient) in coefficients.iter_mut().enumerate() {
        let term = |(j, value): (usize, &f64)| {
            let weight = if j == 0 || j == DEGREE { 0.5 } else { 1.0 };
            // The places run from −1 to 1, in the opposite order of the cosines.
            let angle = core::f64::consts::PI * ((DEGREE - j) * k) as f64 / n;
            weight * value * angle.cos()
        };
        let sum: f64 = values.iter().enumerate().map(term).sum();
        *coefficient = sum * if k == 0 || k == DEGREE { 1.0 / n } else { 2.0 / n };
    }
    coefficients
}

/// Σ c_k T_k(x), by Clenshaw's recurrence.
fn evaluate(coefficients: &[f64], x: f64) -> f64 {
    let (mut b, mut before) = (0.0, 0.0);
    for c in coefficients.iter().skip(1).rev() {
        (b, before) = (2.0 * x * b - before + c, b);
    }
    x * b - before + coefficients[0]
}

/// The coefficients of the derivative.
fn derivative(coefficients: &[f64; DEGREE + 1]) -> [f64; DEGREE + 1] {
    let mut out = [0.0; DEGREE + 1];
    for k in (0..DEGREE).rev() {
        let above = if k + 2 <= DEGREE { out[k + 2] } else { 0.0 };
        out[k] = above + 2.0 * (k + 1) as f64 * coefficients[k + 1];
    }
    out[0] *= 0.5;
    out
}

/// Where in [−1, 1] an interpolant is greatest.
fn greatest(coefficients: &[f64; DEGREE + 1]) -> f64 {
    let slope = derivative(coefficients);
    let count = SAMPLES_PER_INTERVAL * DEGREE;
    let place = |j: usize| -(core::f64::consts::PI * j as f64 / count as f64).cos();
    let value = |j: usize| evaluate(coefficients, place(j));
    let top = (0..=count).fold(0, |top, j| if value(j) > value(top) { j } else { top });
    let (mut low, mut high) = (place(top.saturating_sub(1)), place((top + 1).min(count)));
    // At an end it may rise up to the end itself.
    if top == 0 && evaluate(&slope, -1.0) <= 0.0 {
        return -1.0;
    }
    if top == count && evaluate(&slope, 1.0) >= 0.0 {
        return 1.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if evaluate(&slope, middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::peak;

    fn of(f: impl Fn(f64) -> f64, ends: [f64; 2]) -> super::Peak {
        peak(|places| Some(places.iter().map(|x| f(*x)).collect()), ends, 10.0).expect("a peak")
    }

    #[test]
    fn smooth_functions_are_met_to_rounding() {
        let found = of(|x| x.sin() + 3.0, [1.0, 2.2]);
        assert!(found.smooth && (found.value - 4.0).abs() < 1e-14, "{found:?}");
        assert!((found.at - core::f64::consts::FRAC_PI_2).abs() < 1e-10, "{found:?}");
        // So sharp that the first intervals do not show it.
        let found = of(|x| 1.0 / (1e-4 + (x - 0.3) * (x - 0.3)), [-1.0, 1.5]);
        assert!(found.smooth && (found.at - 0.3).abs() < 1e-12 && (found.value / 1e4 - 1.0).abs() < 1e-12, "{found:?}");
        // From right to left.
        let found = of(f64::cos, [0.5, -0.7]);
        assert!(found.smooth && found.at.abs() < 1e-10 && (found.value - 1.0).abs() < 1e-14, "{found:?}");
    }

    #[test]
    fn ends_and_kinks_are_told() {
        let found = of(|x| x * x, [0.0, 2.0]);
        assert!(found.smooth && found.at == 2.0 && (found.value - 4.0).abs() < 1e-14, "{found:?}");
        let found = of(|x| 1.0 - (x - 0.7).abs(), [0.0, 2.0]);
        assert!(!found.smooth && (found.at - 0.7).abs() < 1e-9 && (found.value - 1.0).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn what_has_no_value_ends_the_search() {
        assert_eq!(peak(|_| None, [0.0, 1.0], 1.0), None);
        assert_eq!(peak(|places| Some(vec![f64::NAN; places.len()]), [0.0, 1.0], 1.0), None);
        let of = |narrowest: f64| {
            let sample = |places: &[f64]| {
                let is_known = places[places.len() - 1] - places[0] > narrowest;
                is_known.then(|| places.iter().map(|x| 1.0 / (1e-6 + (x - 0.3) * (x - 0.3))).collect())
            };
            peak(sample, [0.0, 1.0], 1.0).expect("a peak")
        };
        let [known, unknown] = [of(0.0), of(0.01)];
        assert!(known.smooth && known.resolved && (known.value - 1e6).abs() < 1e-5, "{known:?}");
        assert!(!unknown.smooth && !unknown.resolved && unknown.value < 1e6, "{unknown:?}");
    }
}
