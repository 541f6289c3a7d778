//! Errors: what does not assemble, what is singular, what is not a number.

use crate::fixture::{FiveBar, FlatParallelogram, FourBarLoop, FreeParallelogram, Parallelogram, StretchedSlider};
use crate::{Instant, Kinematics, LengthError, Options, Signal, SolveError};

#[test]
fn an_open_loop_is_named_with_its_gap() {
    let error = StretchedSlider.state_at(&Instant::at(0.6)).unwrap_err();
    let SolveError::NotAssembled { t, gap, residual, joint, .. } = &error else { panic!("{error}") };
    assert!(*t == 0.6 && *gap > 1e-3 && residual.abs() > 1e-3 && !joint.is_empty(), "{error}");
}

#[test]
fn contradicting_redundant_rows_do_not_assemble() {
    let error = Parallelogram { length: 0.29 }.state_at(&Instant::at(0.0)).unwrap_err();
    assert!(matches!(error, SolveError::NotAssembled { .. }), "{error}");
}

#[test]
fn full_stretch_is_singular() {
    let at = Instant::at(0.475);
    let q = [0.0, 0.0, 0.0, 0.585, 0.0, 0.0, 0.94, 0.0, 0.0];
    let error = StretchedSlider.velocity_analysis(&at, &q).unwrap_err();
    let SolveError::Singular { t, rank, expected_rank, rows, .. } = &error else { panic!("{error}") };
    assert_eq!((*t, *rank, *expected_rank), (0.475, 8, 9));
    assert_eq!(rows, &["O.x", "A.x", "B.x", "drive"]);
    // The root itself is as accurate as a double root can be.
    let start = [0.0, 0.0, 0.1, 0.58, 0.0, -0.05, 0.94, 0.0, 0.0];
    let position = StretchedSlider.solver().position(&at, &start).unwrap();
    assert!(position.q[2].abs() < 1e-7 && position.residual < 1e-13, "{position:?}");
    assert!(matches!(StretchedSlider.state_at(&at), Err(SolveError::Singular { .. })));
}

#[test]
fn a_flat_parallelogram_is_singular_but_its_neighbours_are_not() {
    let q = [0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.5, 0.0, 0.0];
    let flat = FlatParallelogram { start: 0.0 };
    let error = flat.velocity_analysis(&Instant::at(0.0), &q).unwrap_err();
    assert!(matches!(error, SolveError::Singular { rank: 8, expected_rank: 9, .. }), "{error}");
    let (sin, cos) = 1e-4_f64.sin_cos();
    let q = [0.0, 0.0, 1e-4, 0.2 * cos, 0.2 * sin, 0.0, 0.5, 0.0, 1e-4];
    let q_dot = FlatParallelogram { start: 1e-4 }.velocity_analysis(&Instant::at(0.0), &q).unwrap();
    assert!((q_dot[8] - 1.0).abs() < 1e-9 && q_dot[5].abs() < 1e-9, "{q_dot:?}");
}

#[test]
fn permanent_redundancy_is_not_singular() {
    let state = FreeParallelogram.state_at(&Instant::at(0.0)).unwrap();
    assert_eq!(state.degrees_of_freedom_left, 1);
    assert!(state.q_dot.iter().all(|v| v.abs() < 1e-14));
    let given = Signal { value: 0.6, rate: 1.0, acceleration: 0.0 };
    let driven = FreeParallelogram.solver().with_given(2, given).state(&Instant::at(0.0)).unwrap();
    assert!((driven.q_dot[11] - 1.0).abs() < 1e-12 && driven.degrees_of_freedom_left == 0);
}

#[test]
fn what_is_given_twice_is_a_conflict() {
    let at = Instant::at(0.0);
    for value in [core::f64::consts::FRAC_PI_4, 0.3] {
        let given = Signal { value, rate: 2.3, acceleration: 0.0 };
        let error = FourBarLoop::default().solver().with_given(0, given).state(&at).unwrap_err();
        let SolveError::GivenConflict { coordinate, open, given, .. } = error else { panic!("{error}") };
        assert_eq!((coordinate, open, given), ("phi1", 0, 1));
    }
    let two = FiveBar.solver().with_given(5, Signal { value: 2.5, ..Signal::default() });
    let error = two.with_given(8, Signal { value: 0.73, ..Signal::default() }).state(&at).unwrap_err();
    assert!(matches!(error, SolveError::GivenConflict { open: 1, given: 2, .. }), "{error}");
    let error = FiveBar.solver().with_given(12, Signal::default()).state(&at).unwrap_err();
    assert_eq!(error, SolveError::UnknownCoordinate { index: 12, coordinates: 12 });
    let error = FiveBar.solver().with_guess(12, 0.0).assemble(&at).unwrap_err();
    assert_eq!(error, SolveError::UnknownCoordinate { index: 12, coordinates: 12 });
}

/// The second crank is 0.09 long, at x = 0.45: the coordinate can be given, but not this value.
#[test]
fn what_is_given_out_of_reach_is_no_conflict() {
    for value in [1.0, 0.55, -3.0] {
        let solver = FiveBar.solver().with_given(3, Signal { value, ..Signal::default() });
        let error = solver.state(&Instant::at(0.0)).unwrap_err();
        assert!(matches!(error, SolveError::NotAssembled { .. }), "{value}: {error}");
    }
}

#[test]
fn what_is_not_a_number_is_named() {
    let mechanism = FourBarLoop::default();
    let at = Instant::at(0.0);
    for bad in [f64::NAN, f64::INFINITY] {
        let named = |error: SolveError, what: &str, index: usize, name: &str| {
            assert!(
                matches!(&error, SolveError::NonFinite { what: w, index: k, name: n, .. }
                    if *w == what && *k == index && *n == name),
                "{error}"
            );
        };
        named(mechanism.position_analysis(&at, &[0.0, bad, 0.0]).unwrap_err(), "q", 1, "phi2");
        named(mechanism.velocity_analysis(&at, &[0.0, 0.0, bad]).unwrap_err(), "q", 2, "phi3");
        named(mechanism.acceleration_analysis(&at, &[0.0; 3], &[bad, 0.0, 0.0]).unwrap_err(), "q_dot", 0, "phi1");
        named(mechanism.state_at(&Instant::at(bad)).unwrap_err(), "t", 0, "t");
        named(mechanism.solver().with_guess(1, bad).assemble(&at).unwrap_err(), "guess", 1, "phi2");
        named(mechanism.kinematic_analysis(&[0.0, bad]).unwrap_err().source, "times", 1, "");
        let given = Signal { rate: bad, ..Signal::default() };
        named(mechanism.solver().with_given(1, given).state(&at).unwrap_err(), "given", 0, "phi2");
    }
    let wrong = FourBarLoop { wrong: f64::NAN };
    let error = wrong.state_at(&at).unwrap_err();
    assert!(matches!(error, SolveError::NonFinite { what: "Φ_q", t: Some(0.0), .. }), "{error}");
    assert!(error.to_string().ends_with("at t = 0"), "{error}");
}

#[test]
fn wrong_lengths_are_errors() {
    let mechanism = FourBarLoop::default();
    let at = Instant::at(0.0);
    let length = |what, expected, found| SolveError::Length(LengthError { what, expected, found });
    assert_eq!(mechanism.position_analysis(&at, &[0.0; 2]), Err(length("q", 3, 2)));
    assert_eq!(mechanism.acceleration_analysis(&at, &[0.0; 3], &[0.0; 4]), Err(length("q_dot", 3, 4)));
    let at = Instant { t: 0.0, inputs: &[Signal { value: 0.0, rate: 0.0, acceleration: 0.0 }] };
    assert_eq!(mechanism.state_at(&at).unwrap_err(), length("inputs", 0, 1));
}

#[test]
fn options_that_mean_nothing_are_named() {
    let lever = FourBarLoop::default();
    for options in [
        Options { tolerance: 0.0, ..Options::default() },
        Options { tolerance: f64::NAN, ..Options::default() },
        Options { min_step: -1.0, ..Options::default() },
        Options { max_rotation_per_step: 10.0, ..Options::default() },
        Options { max_steps: 0, ..Options::default() },
        Options { max_iterations: 0, ..Options::default() },
    ] {
        let error = lever.solver().with_options(options).state(&Instant::at(0.3)).unwrap_err();
        assert!(matches!(error, SolveError::Option { .. }), "{error}");
    }
}
