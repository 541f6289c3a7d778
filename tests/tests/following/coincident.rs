//! Motions in which two neighbouring points of a rope meet, where the direction of the rope between them has no value.

use super::jumps::reached;
use kin_runtime::{Degeneracy, Instant, Kinematics, Mechanism, Options, PlanError, Refusal, SolveError, mechanism};

/// A cabin and a counterweight on one rope over two pulleys. At t = 9 the cabin is at its pulley, if `beside` is 0.
#[mechanism]
#[body(cabin, x = beside, phi = 0)]
#[body(weight, x = 1, phi = 0)]
#[rope(rope: cabin @ (0, 0), ground @ (0, 10), ground @ (1, 10), weight @ (0, 0), length = 12)]
#[driver(drive: cabin.y = 1 + t)]
#[guess(weight.y = 5)]
struct Lift {
    beside: f64,
}

/// The same by a function of a formula; the position of the counterweight is linear in it.
#[mechanism]
#[body(cabin, x = beside, phi = 0)]
#[coordinates(rest)]
#[driver(drive: cabin.y = 1 + t)]
#[constraint(rope: rest + distance(cabin @ (0, 0), ground @ (0, 10)) = 12)]
struct Formula {
    beside: f64,
}

/// A crank whose pin passes the first pulley of a rope at t = 9, if the crank has the length 1.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[body(weight, x = 2, phi = 0)]
#[rope(rope: crank @ (1 + beside, 0), ground @ (0, 1), ground @ (2, 1), weight @ (0, 0), length = 5)]
#[driver(drive: crank.phi = pi / 2 + 0.1 * (t - 9))]
#[guess(weight.y = -1)]
struct Turning {
    beside: f64,
}

/// The driver ends at t = 8, where the cabin is 0.02 below its pulley and a wheel has turned by 8000 rad.
#[mechanism]
#[body(cabin, x = 0, phi = 0)]
#[body(weight, x = 1, phi = 0)]
#[body(wheel, x = 0, y = 0)]
#[rope(rope: cabin @ (0, 0), ground @ (0, 10), ground @ (1, 10), weight @ (0, 0), length = 12)]
#[driver(drive: cabin.y = 9.98 - sqrt(8 - t))]
#[driver(spin: wheel.phi = 1000 * t)]
#[guess(weight.y = 5)]
struct Wound;

const GRIDS: [&[f64]; 5] = [
    &[0.0, 18.0],
    &[8.0, 8.4, 8.8, 9.2, 9.6, 10.0],
    &[8.0, 8.5, 9.0, 9.5, 10.0],
    &[8.0, 8.999_999_99, 9.000_000_01],
    &[8.9, 9.05, 9.2],
];

/// Followed in five ways, the motion ends before t = 9 on every grid, and at t = 9 there is no state.
fn ends<M: Mechanism + Sync>(mechanism: &M) {
    for times in GRIDS {
        let before = times.iter().filter(|t| **t < 8.999_999).count();
        let exact = times.iter().filter(|t| **t < 9.0).count();
        let found = reached(mechanism, times);
        assert!(found.iter().all(|count| (before..=exact).contains(count)), "{times:?}: {found:?}");
    }
    for use_plan in [true, false] {
        let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
        for t in [9.0, 9.0 + 1e-13, 9.0 - 1e-10] {
            let error = solver.state(&Instant::at(t)).expect_err("two points coincide");
            let is_named = matches!(
                error,
                SolveError::DegenerateGeometry { joint: "rope", fault: Degeneracy::Coincident, .. }
                    | SolveError::Plan(PlanError::Coincident { joint: "rope", .. })
            );
            assert!(is_named, "{use_plan} {t}: {error}");
        }
        for times in [&[8.0, 10.0][..], &[8.0, 9.0, 10.0], &[8.6, 8.9, 9.2], &[10.0, 8.0]] {
            let error = solver.sweep(times).expect_err("two points coincide").source;
            let SolveError::StepRefused { t, joint: "rope", reason: Refusal::Coincident, .. } = error else {
                panic!("{use_plan} {times:?}: {error}")
            };
            assert!((t - 9.0).abs() < 1e-9, "{use_plan} {times:?}: {t}");
        }
    }
    let mut planned = mechanism.solver().planned(&Instant::at(8.0)).expect("it closes");
    let error = planned.at(&Instant::at(10.0)).expect_err("two points coincide");
    assert!(matches!(error, PlanError::Coincident { t, joint: "rope" } if (t - 9.0).abs() < 1e-9), "{error}");
}

/// The motion passes beside the pulley.
fn passes<M: Mechanism + Sync>(mechanism: &M) {
    for times in GRIDS {
        assert_eq!([times.len(); 5], reached(mechanism, times), "{times:?}");
    }
}

#[test]
fn a_motion_ends_where_two_points_of_a_rope_meet() {
    ends(&Lift { beside: 0.0 });
    ends(&Formula { beside: 0.0 });
    ends(&Turning { beside: 0.0 });
}

#[test]
fn points_of_a_rope_pass_one_another_at_a_small_distance() {
    for beside in [0.1, -1e-3, 1e-4] {
        passes(&Lift { beside });
        passes(&Formula { beside });
        passes(&Turning { beside });
    }
}

/// Another end of a motion is not taken for coinciding points because an angle is large.
#[test]
fn points_that_are_near_do_not_coincide_where_bodies_have_turned_often() {
    for use_plan in [true, false] {
        let solver = Wound.solver().with_options(Options { use_plan, ..Options::default() });
        let error = solver.sweep(&[7.9, 8.1]).expect_err("the driver ends").source;
        let is_named =
            matches!(error, SolveError::StepRefused { t, reason: Refusal::Undefined, .. } if (t - 8.0).abs() < 1e-9);
        assert!(is_named, "{use_plan}: {error}");
    }
}
