//! Tests of splines: exactly reproduced functions, smoothness, and order of convergence.

use super::{CubicSpline, FunctionError};
use crate::function::ScalarFunction;
use core::f64::consts::TAU;

const X: [f64; 6] = [-1.0, -0.4, 0.1, 0.7, 1.9, 2.3];

fn cubic(x: f64) -> [f64; 3] {
    [1.0 - x + 0.5 * x * x - 2.0 * x.powi(3), -1.0 + x - 6.0 * x * x, 1.0 - 12.0 * x]
}

fn close(a: [f64; 3], b: [f64; 3], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

/// Clamped splines reproduce every cubic, inside and outside of the table.
#[test]
fn clamped_splines_are_exact_for_cubics() {
    let y = X.map(|x| cubic(x)[0]);
    let spline = CubicSpline::clamped(&X, &y, cubic(X[0])[1], cubic(X[5])[1]).unwrap();
    for k in -20..=40 {
        let x = 0.1 * f64::from(k);
        assert!(close(spline.evaluate(x), cubic(x), 5e-12), "{x}");
    }
    let two = CubicSpline::clamped(&[0.0, 2.0], &[cubic(0.0)[0], cubic(2.0)[0]], cubic(0.0)[1], cubic(2.0)[1]).unwrap();
    assert!(close(two.evaluate(0.7), cubic(0.7), 1e-13));
}

/// The example of de Boor and of most textbooks: natural ends through 0, 1, 0 have m = −3 in the middle, f = x(3 −
/// x²)/2.
#[test]
fn natural_splines_by_hand() {
    let spline = CubicSpline::natural(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0]).unwrap();
    assert!(close(spline.evaluate(0.5), [0.6875, 1.125, -1.5], 1e-15));
    assert!(close(spline.evaluate(1.0), [1.0, 0.0, -3.0], 1e-15));
    assert!(close(spline.evaluate(1.5), [0.6875, -1.125, -1.5], 1e-15));
    // Outside of the table the spline continues straight.
    assert!(close(spline.evaluate(-1.0), [-1.5, 1.5, 0.0], 1e-15));
    assert!(close(spline.evaluate(4.0), [-3.0, -1.5, 0.0], 1e-15));
    let line = CubicSpline::natural(&[0.0, 2.0], &[1.0, 5.0]).unwrap();
    assert_eq!(line.evaluate(3.0), [7.0, 2.0, 0.0]);
}

fn all() -> [CubicSpline; 3] {
    let y = [0.3, -0.2, 0.9, 0.4, -0.7, 0.3];
    [
        CubicSpline::natural(&X, &y).unwrap(),
        CubicSpline::clamped(&X, &y, 1.5, -0.5).unwrap(),
        CubicSpline::periodic(&X, &y).unwrap(),
    ]
}

#[test]
fn value_and_both_derivatives_are_continuous_at_every_knot() {
    const H: f64 = 1e-9;
    for spline in all() {
        for knot in X {
            let (before, after) = (spline.evaluate(knot - H), spline.evaluate(knot + H));
            assert!(close(before, after, 1e-6), "{before:?} {after:?} at {knot} of {spline:?}");
        }
        let y = X.map(|x| spline.evaluate(x)[0]);
        assert!(y.iter().zip([0.3, -0.2, 0.9, 0.4, -0.7, 0.3]).all(|(a, b)| (a - b).abs() < 1e-15), "{y:?}");
    }
}

#[test]
fn derivatives_are_those_of_the_value() {
    const H: f64 = 1e-5;
    for spline in all() {
        for k in -30..60 {
            let x = 0.1 * f64::from(k) + 0.033;
            let ([a, a1, _], [_, d1, d2], [b, b1, _]) =
                (spline.evaluate(x - H), spline.evaluate(x), spline.evaluate(x + H));
            assert!(((b - a) / (2.0 * H) - d1).abs() < 1e-6 && ((b1 - a1) / (2.0 * H) - d2).abs() < 1e-6, "{x}");
        }
    }
}

#[test]
fn periodic_splines_repeat() {
    let spline = &all()[2];
    assert_eq!(spline.domain(), (-1.0, 2.3));
    for k in 0..33 {
        let x = -1.0 + 0.1 * f64::from(k) + 0.01;
        for turns in [-3.0, -1.0, 1.0, 5.0] {
            assert!(close(spline.evaluate(x + turns * 3.3), spline.evaluate(x), 1e-12), "{x} {turns}");
        }
    }
    // Three points, the last of which repeats the first: by symmetry f′ = 0 at all of them.
    let three = CubicSpline::periodic(&[0.0, 1.0, 2.0], &[1.0, -1.0, 1.0]).unwrap();
    assert!(close(three.evaluate(0.0), [1.0, 0.0, -12.0], 1e-14));
    assert!(close(three.evaluate(1.0), [-1.0, 0.0, 12.0], 1e-14));
}

/// The largest errors of f, f′ and f″ for the sine over one period with n pieces.
fn errors(n: u32, spline: impl Fn(&[f64], &[f64]) -> CubicSpline) -> [f64; 3] {
    let x: Vec<f64> = (0..=n).map(|k| TAU * f64::from(k) / f64::from(n)).collect();
    let mut y: Vec<f64> = x.iter().map(|x| x.sin()).collect();
    y[n as usize] = 0.0;
    let spline = spline(&x, &y);
    let mut worst = [0.0_f64; 3];
    for k in 0..4000 {
        let x = TAU * f64::from(k) / 4000.0;
        let exact = [x.sin(), x.cos(), -x.sin()];
        for (worst, (a, b)) in worst.iter_mut().zip(spline.evaluate(x).iter().zip(exact)) {
            *worst = worst.max((a - b).abs());
        }
    }
    worst
}

/// Halving the spacing divides the errors of f, f′, f″ by 16, 8 and 4.
#[test]
fn errors_fall_with_the_fourth_power_of_the_spacing() {
    type Through = fn(&[f64], &[f64]) -> CubicSpline;
    let natural: Through = |x, y| CubicSpline::natural(x, y).unwrap();
    let clamped: Through = |x, y| CubicSpline::clamped(x, y, 1.0, 1.0).unwrap();
    let periodic: Through = |x, y| CubicSpline::periodic(x, y).unwrap();
    for spline in [natural, clamped, periodic] {
        let (coarse, fine) = (errors(40, spline), errors(80, spline));
        for (order, (a, b)) in [4.0, 3.0, 2.0].into_iter().zip(coarse.iter().zip(fine)) {
            let found = (a / b).log2();
            assert!((found - order).abs() < 0.1, "order {found} instead of {order}: {coarse:?} {fine:?}");
        }
    }
}

#[test]
fn unsound_tables_are_refused_with_numbers() {
    use FunctionError::*;
    let natural = CubicSpline::natural;
    assert_eq!(natural(&[0.0, 1.0], &[0.0]), Err(Lengths { abscissae: 2, values: 1 }));
    assert_eq!(natural(&[0.0], &[0.0]), Err(TooFewPoints { found: 1, needed: 2 }));
    assert_eq!(natural(&[], &[]), Err(TooFewPoints { found: 0, needed: 2 }));
    assert_eq!(natural(&[0.0, f64::NAN], &[0.0; 2]), Err(NonFinite { what: "abscissae", index: 1 }));
    assert_eq!(natural(&[0.0, 1.0], &[f64::INFINITY, 0.0]), Err(NonFinite { what: "values", index: 0 }));
    let flat = natural(&[0.0, 1.0, 1.0, 2.0], &[0.0; 4]);
    assert_eq!(flat, Err(NotIncreasing { index: 2, before: 1.0, found: 1.0 }));
    let slope = CubicSpline::clamped(&[0.0, 1.0], &[0.0; 2], 0.0, f64::NAN);
    assert_eq!(slope, Err(NonFinite { what: "slopes", index: 1 }));
    let open = CubicSpline::periodic(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.1]);
    assert_eq!(open, Err(NotPeriodic { first: 0.0, last: 0.1 }));
    // A difference due to rounding is accepted; the smallest intended one is rejected.
    let nearly = |gap: f64| CubicSpline::periodic(&[0.0, 1.0, 2.0], &[50.0, -100.0, 50.0 + gap]);
    assert_eq!(nearly(2e-11).unwrap().evaluate(2.0), nearly(0.0).unwrap().evaluate(0.0));
    assert!(matches!(nearly(1e-9), Err(NotPeriodic { .. })));
    assert_eq!(CubicSpline::periodic(&[0.0, 1.0], &[0.0; 2]), Err(TooFewPoints { found: 2, needed: 3 }));
    let apart = natural(&[0.0, 1e-300, 2e-300], &[0.0, 1e300, 0.0]);
    assert!(matches!(apart, Err(NonFinite { what: "coefficients", .. })), "{apart:?}");
    assert!(open.unwrap_err().to_string().contains("begins with 0 and ends with 0.1"));
}

#[test]
fn not_a_number_has_no_value() {
    for spline in all() {
        assert!(spline.evaluate(f64::NAN)[0].is_nan());
    }
}

/// The third derivative is that of the cubic, higher ones are zero; outside of the table they follow the continuation.
#[test]
fn higher_derivatives_by_hand() {
    let at = |spline: &CubicSpline, x: f64| {
        let mut all = [f64::NAN; 5];
        assert_eq!(spline.derivatives(x, &mut all), 5);
        assert!(close([all[0], all[1], all[2]], spline.evaluate(x), 1e-15), "{x}");
        [all[3], all[4]]
    };
    let natural = CubicSpline::natural(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0]).unwrap();
    assert_eq!(at(&natural, 0.5), [-3.0, 0.0]);
    assert_eq!(at(&natural, 1.0), [3.0, 0.0]);
    assert_eq!(at(&natural, 2.5), [0.0, 0.0]);
    let y = X.map(|x| cubic(x)[0]);
    let clamped = CubicSpline::clamped(&X, &y, cubic(X[0])[1], cubic(X[5])[1]).unwrap();
    assert!((at(&clamped, 5.0)[0] + 12.0).abs() < 1e-9);
    let periodic = CubicSpline::periodic(&[0.0, 1.0, 3.0], &[0.0, 1.0, 0.0]).unwrap();
    assert!((at(&periodic, 0.5)[0] - at(&periodic, 30.5)[0]).abs() < 1e-12);
}
