//! Tests with the constants of textbooks, and of the derivatives by finite differences.

use super::MotionLaw;
use crate::function::ScalarFunction;

/// The largest |s′| and |s″| of a fine sampling.
fn peaks(law: MotionLaw) -> [f64; 2] {
    let samples = (0..=100_000).map(|k| law.normalised(f64::from(k) / 100_000.0));
    samples.fold([0.0; 2], |[v, a], [_, s_1, s_2]| [f64::max(v, s_1.abs()), f64::max(a, s_2.abs())])
}

#[test]
fn peaks_are_those_of_the_textbooks() {
    let known = [
        (MotionLaw::ConstantVelocity, 1.0, 0.0),
        (MotionLaw::Harmonic, core::f64::consts::FRAC_PI_2, 4.934_802),
        (MotionLaw::Cycloidal, 2.0, core::f64::consts::TAU),
        (MotionLaw::Polynomial345, 1.875, 5.773_503),
        (MotionLaw::Polynomial4567, 2.1875, 7.513_188),
        (MotionLaw::ModifiedSine, 1.759_603, 5.527_957),
        (MotionLaw::ModifiedTrapezoidal, 2.0, 4.888_124),
    ];
    for (law, velocity, acceleration) in known {
        let [v, a] = peaks(law);
        assert!((v - velocity).abs() < 1e-6 && (a - acceleration).abs() < 1e-6, "{law:?}: {v} {a}");
    }
}

#[test]
fn laws_rise_by_one_and_are_symmetric() {
    for law in MotionLaw::ALL {
        assert!(law.normalised(0.0)[0].abs() < 1e-15 && (law.normalised(1.0)[0] - 1.0).abs() < 1e-15, "{law:?}");
        for k in 0..=200 {
            let tau = f64::from(k) / 200.0;
            let ([s, v, a], [t, w, b]) = (law.normalised(tau), law.normalised(1.0 - tau));
            assert!((s + t - 1.0).abs() < 1e-14 && (v - w).abs() < 1e-13 && (a + b).abs() < 1e-12, "{law:?} {tau}");
        }
    }
}

/// Every law but constant velocity and harmonic motion begins and ends at rest, without a jump of acceleration.
#[test]
fn ends_are_at_rest() {
    for law in [
        MotionLaw::Cycloidal,
        MotionLaw::Polynomial345,
        MotionLaw::Polynomial4567,
        MotionLaw::ModifiedSine,
        MotionLaw::ModifiedTrapezoidal,
    ] {
        for tau in [0.0, 1.0] {
            let [_, v, a] = law.normalised(tau);
            assert!(v.abs() < 1e-14 && a.abs() < 1e-13, "{law:?} at {tau}: {v} {a}");
        }
    }
}

#[test]
fn derivatives_agree_with_differences_and_pieces_join() {
    const H: f64 = 1e-5;
    for law in MotionLaw::ALL {
        for k in 1..400 {
            // The samples include the junctions of pieces at 1/8, 3/8, 1/2 and 7/8.
            let tau = f64::from(k) / 400.0;
            let ([before, v_before, _], [_, v, a], [after, v_after, _]) =
                (law.normalised(tau - H), law.normalised(tau), law.normalised(tau + H));
            assert!(((after - before) / (2.0 * H) - v).abs() < 1e-8, "{law:?} s′ at {tau}");
            assert!(((v_after - v_before) / (2.0 * H) - a).abs() < 2e-3, "{law:?} s″ at {tau}");
        }
    }
}

#[test]
fn beyond_its_interval_a_law_rests() {
    for law in MotionLaw::ALL {
        assert_eq!(law.normalised(-0.1), [0.0; 3]);
        assert_eq!(law.normalised(1.1), [1.0, 0.0, 0.0]);
    }
}

/// Every derivative is the derivative of the one before, and the first three are those of `normalised`.
#[test]
fn higher_derivatives_are_derivatives() {
    for law in MotionLaw::ALL {
        for k in 0..50 {
            // The samples avoid the junctions of pieces.
            let (tau, h) = (0.0051 + 0.0199 * f64::from(k), 1e-4);
            let at = |tau: f64| {
                let mut all = [0.0; 7];
                law.derivatives(tau, &mut all);
                all
            };
            let [before, here, after] = [at(tau - h), at(tau), at(tau + h)];
            assert_eq!(law.normalised(tau)[..], here[..3], "{law:?}");
            for order in 0..6 {
                let slope = (after[order] - before[order]) / (2.0 * h);
                let size = 1.0 + here[order + 1].abs() + 13.0_f64.powi(order as i32);
                assert!((slope - here[order + 1]).abs() < 1e-5 * size, "{law:?} {tau} {order}: {slope} {here:?}");
            }
        }
    }
    let mut resting = [f64::NAN; 5];
    MotionLaw::Cycloidal.derivatives(1.5, &mut resting);
    assert_eq!(resting, [1.0, 0.0, 0.0, 0.0, 0.0]);
    // As a function of a mechanism the law has derivatives of any order.
    let mut same = [f64::NAN; 5];
    let law = MotionLaw::Polynomial4567;
    assert_eq!((ScalarFunction::derivatives(&law, 0.3, &mut same), law.evaluate(0.3)), (5, law.normalised(0.3)));
    let mut own = [f64::NAN; 5];
    law.derivatives(0.3, &mut own);
    assert_eq!(same, own);
}
