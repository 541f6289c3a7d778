//! Supplied functions compared with their difference quotients.
//!
//! Closed forms and dual numbers both take f, f′ and f″ from the function, so that their comparison cannot reveal a
//! wrong derivative. Here the difference quotient of g over an interval is compared with the mean of g′ over it
//! (five-point Gauss–Lobatto quadrature), for g = f and g = f′. The intervals begin or end at the argument and get
//! shorter and shorter; the one with the best agreement counts. So a smooth function agrees to rounding; a knot of a
//! spline or a jump of an acceleration lies outside of all sufficiently short intervals on one side at least; and a
//! wrong derivative disagrees on all of them.

use core::fmt;

/// The largest disagreement of a supplied function with its difference quotients.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FunctionCheck {
    /// The name of the function, as in [`Model::functions`](crate::model::Model::functions).
    pub function: &'static str,
    /// Number of arguments at which f′ or f″ was compared.
    pub arguments: usize,
    /// Number of arguments at which no comparison was possible: the function has no value there, or varies less than
    /// its rounding error.
    pub skipped: usize,
    /// The derivative with the largest disagreement: `f′`, compared with differences of f, or `f″`, compared with those
    /// of f′.
    pub derivative: &'static str,
    /// The argument with the largest disagreement.
    pub x: f64,
    /// The mean of the derivative near that argument, as the function gives it.
    pub given: f64,
    /// The difference quotient over the same interval.
    pub differences: f64,
    /// |given − differences| minus its rounding error, relative to the largest derivative on that interval.
    pub error: f64,
}

impl FunctionCheck {
    /// Errors up to this count as agreement.
    pub const TOLERANCE: f64 = 1e-6;
}

impl fmt::Display for FunctionCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { function, derivative, x, given, differences, error, .. } = self;
        let base = if *derivative == "f″" { "f′" } else { "f" };
        write!(
            f,
            "`{function}`: {derivative} is {given} at {x}, and {differences} by differences of {base} ({error:.1e})"
        )
    }
}

/// The checks of all functions, updated argument by argument.
#[derive(Debug, Default)]
pub(super) struct FunctionChecks {
    checks: Vec<FunctionCheck>,
}

impl FunctionChecks {
    /// Compares the function of this name at `x`.
    pub(super) fn compare(&mut self, name: &'static str, function: &dyn Fn(f64) -> Option<[f64; 3]>, x: f64) {
        let function = |x: f64| function(x).unwrap_or([f64::NAN; 3]);
        let index = self.checks.iter().position(|check| check.function == name).unwrap_or_else(|| {
            self.checks.push(FunctionCheck {
                function: name,
                arguments: 0,
                skipped: 0,
                derivative: "f′",
                x,
                given: 0.0,
                differences: 0.0,
                error: 0.0,
            });
            self.checks.len() - 1
        });
        let check = &mut self.checks[index];
        let found = [(0, "f′"), (1, "f″")].map(|(order, derivative)| (derivative, agreement(&function, order, x)));
        if found.iter().all(|(_, agreement)| agreement.is_none()) {
            check.skipped += 1;
        } else {
            check.arguments += 1;
        }
        // The first comparison counts even if it agrees exactly.
        let mut is_first = check.arguments == 1;
        for (derivative, Agreement { given, differences, error }) in
            found.into_iter().filter_map(|(d, a)| Some((d, a?)))
        {
            if is_first || error > check.error {
                is_first = false;
                *check = FunctionCheck { derivative, x, given, differences, error, ..check.clone() };
            }
        }
    }

    pub(super) fn finish(self) -> Vec<FunctionCheck> {
        self.checks
    }
}

/// A derivative as given and by differences, and the relative difference between both.
#[derive(Clone, Copy, Debug)]
struct Agreement {
    given: f64,
    differences: f64,
    error: f64,
}

/// Nodes and weights of the quadrature on [0, 1].
const NODES: [(f64, f64); 5] = [
    (0.0, 1.0 / 20.0),
    (0.172_673_164_646_011_43, 49.0 / 180.0),
    (0.5, 16.0 / 45.0),
    (0.827_326_835_353_988_6, 49.0 / 180.0),
    (1.0, 1.0 / 20.0),
];
/// Assumed relative rounding error of a function.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Number of interval lengths, each a quarter of the one before.
const STEPS: i32 = 22;
/// A disagreement counts only if an interval of this length or less could be compared, relative to the larger of 1 and
/// the size of the argument.
const MAX_COMPARED_INTERVAL: f64 = 1e-4;

/// Compares derivative `order` + 1 of a function with differences of derivative `order` at `x`; `None` where no
/// comparison is possible.
fn agreement(function: &impl Fn(f64) -> [f64; 3], order: usize, x: f64) -> Option<Agreement> {
    let values = function(x);
    if !values[0].is_finite() {
        return None;
    }
    if !values[order + 1].is_finite() {
        return Some(Agreement { given: values[order + 1], differences: f64::NAN, error: f64::INFINITY });
    }
    let scale = x.abs().max(1.0);
    let (mut best, mut shortest): (Option<Agreement>, f64) = (None, f64::INFINITY);
    for step in 1..=STEPS {
        let length = scale * 0.25_f64.powi(step);
        for end in [x + length, x - length] {
            let Some(found) = over(function, order, x, end) else { continue };
            shortest = shortest.min(length / scale);
            if best.is_none_or(|best| found.error < best.error) {
                best = Some(found);
            }
        }
        if best.is_some_and(|best| best.error < 1e-3 * FunctionCheck::TOLERANCE) {
            return best;
        }
    }
    best.filter(|best| best.error <= FunctionCheck::TOLERANCE || shortest <= MAX_COMPARED_INTERVAL)
}

/// The agreement on the interval from `x` to `end`; `None` where rounding errors dominate or the function has no value.
fn over(function: &impl Fn(f64) -> [f64; 3], order: usize, x: f64, end: f64) -> Option<Agreement> {
    let samples = NODES.map(|(index, _)| function(x + index * (end - x)));
    let [first, last] = [samples[0][order], samples[4][order]];
    let given: f64 = samples.iter().zip(NODES).map(|(sample, (_, weight))| weight * sample[order + 1]).sum();
    let differences = (last - first) / (end - x);
    let largest = |order: usize| samples.iter().map(|sample| sample[order].abs()).fold(0.0, f64::max);
    let size = largest(order + 1).max(differences.abs());
    let miss = (given - differences).abs();
    if !miss.is_finite() || !size.is_finite() {
        return None;
    }
    if miss == 0.0 {
        return Some(Agreement { given, differences, error: 0.0 });
    }
    // Rounding errors of the values and of their arguments.
    let noise = ROUNDING * (largest(order) + x.abs().max(end.abs()) * largest(order + 1)) / (end - x).abs();
    if noise > 0.25 * FunctionCheck::TOLERANCE * size {
        return None;
    }
    Some(Agreement { given, differences, error: (miss - noise).max(0.0) / size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::{CubicSpline, MotionLaw, Polynomial, ScalarFunction, Sequence};

    /// The largest error of both derivatives over many arguments.
    fn worst(function: impl Fn(f64) -> [f64; 3], from: f64, to: f64) -> [f64; 2] {
        let mut worst = [0.0_f64; 2];
        for k in 0..=997 {
            let x = from + (to - from) * f64::from(k) / 997.0;
            for (order, worst) in worst.iter_mut().enumerate() {
                *worst = worst.max(agreement(&function, order, x).map_or(0.0, |a| a.error));
            }
        }
        worst
    }

    fn agrees(function: impl ScalarFunction, from: f64, to: f64) {
        let [f1, f2] = worst(|x| function.evaluate(x), from, to);
        assert!(f1 < 1e-7 && f2 < 1e-7, "{f1:.1e} {f2:.1e}");
    }

    #[test]
    fn good_functions_give_no_alarm() {
        agrees(Polynomial([1.0, -2.0, 0.5, 0.1]), -3.0, 40.0);
        agrees(Polynomial([1e6, 1e-3, 2e-4]), -1.0, 1.0);
        agrees(crate::function::FromFn(|x: f64| [x.sin(), x.cos(), -x.sin()]), -100.0, 100.0);
        agrees(crate::function::FromFn(|x: f64| [x.sqrt(), 0.5 / x.sqrt(), -0.25 / x.powf(1.5)]), 1e-4, 2.0);
        let x: Vec<f64> = (0..=1000).map(|k| f64::from(k) * 1e-3).collect();
        let y: Vec<f64> = x.iter().map(|x| 0.05 * (40.0 * x).sin()).collect();
        agrees(CubicSpline::natural(&x, &y).unwrap(), -0.2, 1.2);
        let short: Vec<f64> = x.iter().map(|x| 1e-6 * x).collect();
        agrees(CubicSpline::natural(&short, &y).unwrap(), 0.0, 1e-6);
        for law in MotionLaw::ALL {
            let cam =
                Sequence::starting_at(0.3, 5.0).dwell(0.5).rise(law, 0.01, 0.25).dwell(1.0).return_to_start(law, 0.5);
            agrees(cam.periodic().unwrap(), -3.0, 5.0);
        }
    }

    #[test]
    fn wrong_derivatives_are_seen() {
        for (slip, first_is_wrong) in [([1.001, 1.0], true), ([1.0, 1.001], false), ([1.0, -1.0], false)] {
            let cam = Sequence::starting_at(0.0, 0.0).dwell(0.5).rise(MotionLaw::Cycloidal, 0.03, 1.0).build().unwrap();
            let wrong = |x: f64| {
                let [f, f1, f2] = cam.evaluate(x);
                [f, f1 * slip[0], f2 * slip[1]]
            };
            let found = worst(wrong, -0.5, 2.0).map(|error| error > 5e-4);
            // f″ is compared with differences of the given f′, so that with a wrong f′ a correct f″ disagrees as well.
            assert!(found[1] && found[0] == first_is_wrong, "{slip:?} {found:?}");
        }
        let nan = worst(|x| [x, 1.0, f64::NAN], 0.0, 1.0);
        assert!(nan[0] == 0.0 && nan[1] == f64::INFINITY);
        // A derivative that is wrongly given as 0.
        let zero = worst(|x| [x * x, 2.0 * x, 0.0], 0.0, 1.0);
        assert!(zero[0] < 1e-9 && zero[1] > 0.9);
    }

    #[test]
    fn an_exact_agreement_shows_the_derivative() {
        let mut all = FunctionChecks::default();
        for x in [f64::NAN, 0.5, 2.0] {
            all.compare("f", &|x| Some([3.0 * x, 3.0, 0.0]), x);
        }
        let [found] = &all.finish()[..] else { panic!("one function") };
        assert_eq!((found.arguments, found.skipped, found.x, found.error), (2, 1, 0.5, 0.0));
        assert!([found.given, found.differences].iter().all(|slope| (slope - 3.0).abs() < 1e-12), "{found}");
    }

    /// No disagreement is reported where rounding dominates on all intervals on which a function is smooth.
    #[test]
    fn what_rounding_drowns_is_no_alarm() {
        // Beside a large constant, differences of f are accurate only on long intervals, over which f oscillates; f′
        // has no such constant.
        let waves = worst(|x| [3e8 + (100.0 * x).sin(), 100.0 * (100.0 * x).cos(), -1e4 * (100.0 * x).sin()], 0.0, 1.0);
        assert!(waves.iter().all(|error| *error <= FunctionCheck::TOLERANCE), "{waves:?}");
        // Around a large argument, in a narrow range, the arguments themselves are rounded.
        let from = 1.7e9;
        let clock = |x: f64| {
            let d = x - from;
            if (0.0..=0.01).contains(&d) { [d * d, 2.0 * d, 2.0] } else { [f64::NAN; 3] }
        };
        let found = worst(clock, from, from + 0.01);
        assert!(found.iter().all(|error| *error <= FunctionCheck::TOLERANCE), "{found:?}");
    }
}
