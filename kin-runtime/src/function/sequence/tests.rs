//! Tests of sequences: positions, junctions, rejected input.

use super::Sequence;
use crate::function::FunctionError;
use crate::function::{MotionLaw, ScalarFunction};

fn cam() -> Sequence {
    let cam = Sequence::starting_at(1.0, 0.2)
        .dwell(0.5)
        .rise(MotionLaw::Cycloidal, 0.03, 2.0)
        .dwell(1.0)
        .polynomial(&[0.0, 0.0, 0.0, -0.1, 0.15, -0.06], 0.5)
        .return_to_start(MotionLaw::ModifiedTrapezoidal, 1.0);
    cam.periodic().unwrap()
}

#[test]
fn segments_follow_one_another() {
    let cam = cam();
    assert_eq!(cam.domain(), (1.0, 6.0));
    assert_eq!(cam.evaluate(1.2), [0.2, 0.0, 0.0]);
    // In the middle of a cycloidal rise: half the height, peak velocity 2h/β, no acceleration.
    let [s, v, a] = cam.evaluate(2.5);
    assert!((s - 0.215).abs() < 1e-15 && (v - 0.03).abs() < 1e-15 && a.abs() < 1e-15);
    // At a quarter of the rise: peak acceleration 2πh/β².
    let a = cam.evaluate(2.0)[2];
    assert!((a - core::f64::consts::TAU * 0.03 / 4.0).abs() < 1e-15);
    assert!((cam.evaluate(4.0)[0] - 0.23).abs() < 1e-15);
    assert!((cam.evaluate(5.0)[0] - 0.22).abs() < 1e-15);
    for x in [1.3, 2.2, 4.9, 5.7] {
        let (once, later, earlier) = (cam.evaluate(x), cam.evaluate(x + 25.0), cam.evaluate(x - 15.0));
        for k in 0..3 {
            assert!((once[k] - later[k]).abs() < 1e-12 && (once[k] - earlier[k]).abs() < 1e-12, "{x}");
        }
    }
}

#[test]
fn junctions_tell_what_jumps() {
    let cam = cam();
    let at: Vec<f64> = cam.junctions().map(|(x, ..)| x).collect();
    assert_eq!(at, [1.0, 1.5, 3.5, 4.5, 5.0]);
    for (x, before, after) in cam.junctions() {
        for (k, most) in [1e-15, 1e-15, 1e-14].into_iter().enumerate() {
            assert!((before[k] - after[k]).abs() < most, "{before:?} and {after:?} at {x}");
        }
    }
    // The first junction of a periodic sequence joins its end with its start.
    let saw = Sequence::starting_at(2.0, 0.0).rise(MotionLaw::ConstantVelocity, 3.0, 1.0);
    let saw = saw.return_to_start(MotionLaw::ConstantVelocity, 2.0).periodic().unwrap();
    let (x, before, after) = saw.junctions().next().unwrap();
    assert_eq!((x, before, after), (2.0, [0.0, -1.5, 0.0], [0.0, 3.0, 0.0]));
    let rough = Sequence::starting_at(0.0, 0.0).dwell(1.0).rise(MotionLaw::Harmonic, 2.0, 0.5).dwell(1.0).build();
    let jumps: Vec<f64> = rough.unwrap().junctions().map(|(_, before, after)| after[2] - before[2]).collect();
    let peak = 2.0 * core::f64::consts::PI.powi(2) / 2.0 / 0.25;
    assert_eq!(jumps.len(), 4);
    assert!(jumps[0] == 0.0 && (jumps[1] - peak).abs() < 1e-12 && (jumps[2] - peak).abs() < 1e-12 && jumps[3] == 0.0);
}

#[test]
fn what_runs_once_continues_straight() {
    let once = Sequence::starting_at(0.0, 1.0).rise(MotionLaw::ConstantVelocity, 2.0, 4.0).dwell(1.0).build().unwrap();
    assert_eq!(once.evaluate(-2.0), [0.0, 0.5, 0.0]);
    assert_eq!(once.evaluate(9.0), [3.0, 0.0, 0.0]);
    assert!(!once.is_periodic());
    let back = Sequence::starting_at(0.0, 1.0).to(MotionLaw::Harmonic, -3.0, 4.0).fall(MotionLaw::Harmonic, 1.0, 1.0);
    assert!((back.build().unwrap().evaluate(7.0)[0] + 4.0).abs() < 1e-15);
}

#[test]
fn not_a_number_has_no_value() {
    let once = Sequence::starting_at(0.0, 1.0).dwell(1.0).build().unwrap();
    assert!(once.evaluate(f64::NAN).iter().all(|s| s.is_nan()));
    let again = Sequence::starting_at(0.0, 1.0).dwell(1.0).periodic().unwrap();
    assert!([f64::NAN, f64::INFINITY].into_iter().all(|x| again.evaluate(x)[0].is_nan()));
}

#[test]
fn unsound_sequences_are_refused() {
    use FunctionError::*;
    let start = || Sequence::starting_at(0.0, 0.0);
    assert_eq!(start().build(), Err(Empty));
    assert_eq!(Sequence::starting_at(f64::NAN, 0.0).dwell(1.0).build(), Err(NonFiniteSegment { segment: None }));
    assert_eq!(start().dwell(1.0).dwell(0.0).build(), Err(Duration { segment: 1, duration: 0.0 }));
    assert_eq!(start().dwell(f64::INFINITY).build(), Err(NonFiniteSegment { segment: Some(0) }));
    assert_eq!(start().rise(MotionLaw::Harmonic, f64::NAN, 1.0).build(), Err(NonFiniteSegment { segment: Some(0) }));
    assert_eq!(start().polynomial(&[0.1, 1.0], 1.0).build(), Err(Jump { segment: 0, by: 0.1 }));
    let lost = Sequence::starting_at(1e20, 0.0).dwell(1.0).build();
    assert_eq!(lost, Err(Duration { segment: 0, duration: 1.0 }));
    let open = start().rise(MotionLaw::Cycloidal, 0.1, 1.0).periodic();
    assert_eq!(open, Err(NotPeriodic { first: 0.0, last: 0.1 }));
    // A difference due to rounding is accepted; the smallest intended one is rejected.
    let nearly = |gap: f64| {
        start().rise(MotionLaw::Cycloidal, 100.0, 1.0).fall(MotionLaw::Cycloidal, 100.0 - gap, 1.0).periodic()
    };
    assert!(nearly(2e-11).is_ok());
    assert!(matches!(nearly(1e-9), Err(NotPeriodic { .. })));
    assert!(open.unwrap_err().to_string().contains("begins with 0 and ends with 0.1"));
}

/// The third derivative of a cycloidal rise is 4π² h/β³ cos 2πτ; that of a dwell is 0, and that of a polynomial is
/// exact.
#[test]
fn higher_derivatives_by_hand() {
    let cam = cam();
    let at = |x: f64| {
        let mut all = [f64::NAN; 6];
        assert_eq!(cam.derivatives(x, &mut all), 6);
        assert_eq!(cam.evaluate(x)[..], all[..3], "{x}");
        all
    };
    let scale = core::f64::consts::TAU.powi(2) * 0.03 / 8.0;
    assert!((at(1.5)[3] - scale).abs() < 1e-14 && (at(26.5)[3] - scale).abs() < 1e-14);
    assert!((at(2.5)[3] + scale).abs() < 1e-14 && at(2.5)[4].abs() < 1e-14);
    assert_eq!(at(1.2), [0.2, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let middle = at(4.75);
    let expected = [-0.1 * 6.0 + 0.15 * 12.0 - 0.06 * 15.0, 0.15 * 24.0 - 0.06 * 60.0, -0.06 * 120.0];
    for (order, expected) in (3..6).zip(expected) {
        assert!((middle[order] - expected * 2.0_f64.powi(order as i32)).abs() < 1e-11, "{order}: {middle:?}");
    }
    let straight = Sequence::starting_at(0.0, 0.0).rise(MotionLaw::ConstantVelocity, 1.0, 2.0).build().unwrap();
    let mut beyond = [f64::NAN; 4];
    assert_eq!(straight.derivatives(4.0, &mut beyond), 4);
    assert_eq!(beyond, [2.0, 0.5, 0.0, 0.0]);
}
