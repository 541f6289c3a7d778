//! Implicit curves of fourth degree that are small beside the arm whose end follows them. The terms of their gradients are
//! powers of the arm's length, but the gradients themselves are regular: motions go round as on the same curve in polar
//! coordinates, and end at the same dead centres.

use core::f64::consts::PI;
use kin_runtime::{Kinematics, LimitKind, Options, mechanism};

/// A limaçon, (X² + Y² − 2aX)² = b² (X² + Y²), on a cam that turns under an arm.
#[mechanism]
#[bodies(cam, arm)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[revolute(P: ground @ (3, 0), arm @ (o, 0))]
#[on_curve(
    K: cam @ (0, 0), arm @ (o + l, 0),
    implicit(X, Y) = pow(X * X + Y * Y - 2 * a * X, 2) - b * b * (X * X + Y * Y),
)]
#[driver(turn: cam.phi = t)]
#[guess(arm.phi = g)]
struct Implicit {
    l: f64,
    a: f64,
    b: f64,
    g: f64,
    /// Where the origin of the arm is does not matter.
    #[param(0)]
    o: f64,
}

/// The same curve, ρ = b + 2a cos θ.
#[mechanism]
#[bodies(cam, arm)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[revolute(P: ground @ (3, 0), arm @ (0, 0))]
#[on_curve(K: cam @ (0, 0), arm @ (l, 0), polar(theta) = b + 2 * a * cos(theta))]
#[driver(turn: cam.phi = t)]
#[guess(arm.phi = g)]
struct Polar {
    l: f64,
    a: f64,
    b: f64,
    g: f64,
}

/// An oval of Cassini with a narrow waist under an arm.
#[mechanism]
#[body(cam, x = 0, y = 0)]
#[body(arm, x = 3, y = 0)]
#[on_curve(
    K: cam @ (0.1, 0), arm @ (l, 0),
    implicit(X, Y) = pow(X * X + Y * Y, 2) - 2 * (X * X - Y * Y) - pow(k, 4) + 1,
)]
#[driver(turn: cam.phi = 0.2 - t)]
#[guess(arm.phi = 2.6)]
struct Cassini {
    l: f64,
    k: f64,
}

fn without_plan() -> Options {
    Options { use_plan: false, ..Options::default() }
}

#[test]
fn small_curves_are_followed_as_in_polar_coordinates() {
    let times: Vec<f64> = (0..=28).map(|k| 0.25 * f64::from(k)).collect();
    for size in [1.0, 0.5, 0.1, 0.05, 0.02, 0.005] {
        let (a, b, l) = (0.2 * size, 0.7 * size, if size < 0.2 { 3.0 } else { 2.9 });
        let g = PI - b / l;
        let polar = Polar { l, a, b, g }.kinematic_analysis(&times).expect("it goes round");
        for o in [0.0, -l, 1.0] {
            let implicit = Implicit { l, a, b, g, o };
            for options in [Options::default(), without_plan()] {
                let found = implicit.solver().with_options(options).sweep_from(&start(&polar.states[0].q, o), &times);
                let found = found.unwrap_or_else(|error| panic!("{size}, {o}, {}: {error}", options.use_plan));
                for (state, expected) in found.states.iter().zip(&polar.states) {
                    for (x, y) in
                        [(&state.q, &expected.q), (&state.q_dot, &expected.q_dot), (&state.q_ddot, &expected.q_ddot)]
                    {
                        assert!(
                            (x[5] - y[5]).abs() <= 1e-11 * (1.0 + y[5].abs()),
                            "{size}, {o}: {} for {}",
                            x[5],
                            y[5]
                        );
                    }
                }
            }
        }
    }
}

/// The configuration of [`Implicit`] whose arm has its origin at −o from the pivot.
fn start(q: &[f64], o: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    (q[3], q[4]) = (q[3] - o * q[5].cos(), q[4] - o * q[5].sin());
    q
}

#[test]
fn a_dead_centre_on_a_small_curve_is_that_in_polar_coordinates() {
    let times: Vec<f64> = (0..=28).map(|k| 0.25 * f64::from(k)).collect();
    for (l, a, b) in [(2.9, 0.04, 0.14), (2.875, 0.125, 0.375), (2.7, 0.24, 0.75)] {
        let polar = Polar { l, a, b, g: PI - b / l }.kinematic_analysis(&times).expect_err("it locks");
        let at = polar.source.limit().and_then(|limit| limit.at()).expect("a limit");
        for o in [0.0, -l, 1.0] {
            let implicit = Implicit { l, a, b, g: PI, o };
            for options in [Options::default(), without_plan()] {
                let q = start(&polar.trajectory.states[0].q, o);
                let error = implicit.solver().with_options(options).sweep_from(&q, &times).expect_err("it locks");
                let limit = error.source.limit().expect("a limit");
                assert!(limit.at().is_some_and(|t| (t - at).abs() < 1e-9), "{l}, {o}: {error} for {at}");
                assert_eq!(limit.kind(), Some(LimitKind::DeadCentre), "{l}, {o}: {error}");
                assert_eq!(error.trajectory.states.len(), polar.trajectory.states.len());
            }
        }
    }
}

#[test]
fn the_waist_of_an_oval_is_not_a_double_point() {
    let times: Vec<f64> = (0..=14).map(|k| 0.5 * f64::from(k)).collect();
    // By continuation along the arc with second derivatives, independently of the code under test.
    for (k, l, fold) in [
        (1.003, 2.9, 1.137_774_835_231),
        (1.003, 2.99, 4.449_032_416_073),
        (1.000_01, 2.9, 2.112_403_030_270),
        (1.000_01, 2.99, 4.984_412_605_737),
        (1.000_001, 2.99, 5.015_038_843_26),
    ] {
        let error = Cassini { l, k }.kinematic_analysis(&times).expect_err("it locks");
        let limit = error.source.limit().expect("a limit");
        assert!(limit.at().is_some_and(|t| (t - fold).abs() < 1e-9), "{k}, {l}: {error}");
        assert_eq!(limit.kind(), Some(LimitKind::DeadCentre), "{k}, {l}: {error}");
    }
}
