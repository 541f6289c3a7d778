//! Normal forces that redundant rows leave undetermined at some states, and masses below zero.

use kin_runtime::{Instant, Kinematics, Measure, Mechanism, Signal, SolveError, State, mechanism};
use std::f64::consts::FRAC_PI_2;

/// A cam pushes a plate, on which a curve lifts a follower that a servo moves as well: the rows that are one too many
/// leave the normal force of the cam undetermined except where it does not push.
#[mechanism(allow_redundant)]
#[bodies(cam, plate, follower)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(guide: ground @ (0, 0), plate @ (0, 0), axis = (1, 0))]
#[flat_follower(push: cam @ (0, 0), plate @ (0, 0), axis = (0, -1), support(theta) = 1 + 0.2*cos(theta))]
#[translational(lift: ground @ (1, 0), follower @ (0, 0), axis = (0, 1))]
#[on_curve(ramp: plate @ (0, 0), follower @ (0, 0), implicit(X, Y) = Y - 1 + cos(X))]
#[driver(motor: cam.phi = t)]
#[constraint(tie: follower.y = 1 - cos(0.2*cos(cam.phi)))]
#[gravity(0, -9.81)]
#[mass(plate @ (0, 0), mass = 1)]
#[mass(follower @ (0, 0), mass = 1)]
#[guess(cam.phi = 0.5, plate.x = 1.1, follower.x = 1, follower.y = 0.02)]
struct Ramp;

/// An arm with a mass at its end.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[driver(motor: arm.phi = 0.3 + t)]
#[gravity(0, -9.81)]
#[mass(arm @ (0.5, 0), mass = m)]
struct Arm {
    #[param(1.0)]
    m: f64,
}

/// An arm that two motors turn together.
#[mechanism(allow_redundant)]
#[bodies(arm)]
#[input(u)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[point(tip = arm @ (1, 0))]
#[driver(first: arm.phi = u)]
#[driver(second: arm.phi = u)]
struct Twice;

#[test]
fn states_without_a_normal_force_are_passed_over() {
    let solver = Ramp.solver();
    let state_at = |t: f64| {
        let x = 0.2 * t.cos();
        let q = [0.0, 0.0, t, 1.0 + x, 0.0, 0.0, 1.0, 1.0 - x.cos(), 0.0];
        solver.state_from(&Instant::at(t), &q).expect("it closes")
    };
    let states: Vec<State> = [0.5, 1.0, FRAC_PI_2, 2.0].map(state_at).to_vec();
    let normal = |state: &State| {
        let forces = solver.forces(state).expect("there are masses");
        forces.reactions.iter().find(|reaction| reaction.name == "push").expect("it is a joint").normal
    };
    assert_eq!([false, false, true, false], [0, 1, 2, 3].map(|k| normal(&states[k]).is_some()));
    for order in [[0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1]] {
        let states: Vec<State> = order.map(|k| states[k].clone()).to_vec();
        let changes = solver.contact_changes(&states).expect("there are masses");
        assert!(changes.iter().all(|change| change.t == FRAC_PI_2 && change.name == "push"), "{changes:?}");
    }
}

#[test]
fn a_mass_below_zero_is_an_error_of_every_analysis_of_forces() {
    let arm = Arm { m: -1.0 };
    let state = arm.solver().state(&0.0.into()).expect("it closes");
    let effort = Measure::named(Arm::model(), "motor.effort").expect("it has one");
    let errors = [arm.solver().forces(&state).err(), arm.solver().measure(&state, &[effort]).err()];
    for error in errors {
        assert!(matches!(error, Some(SolveError::NegativeMass { body: "arm", .. })), "{error:?}");
    }
}

#[test]
fn forces_of_a_mass_below_zero_have_no_derivatives() {
    let arm = Arm { m: -1.0 };
    let state = arm.solver().state(&0.0.into()).expect("it closes");
    let effort = [Measure::named(Arm::model(), "motor.effort").expect("it has one")];
    let errors = [
        arm.solver().measure_sensitivities(&state, &effort, &[0]).err(),
        arm.solver().gradient(std::slice::from_ref(&state), &effort, &[1.0]).err(),
    ];
    for error in errors {
        assert!(matches!(error, Some(SolveError::NegativeMass { body: "arm", .. })), "{error:?}");
    }
}

#[test]
fn a_tracker_knows_the_forces_that_a_solver_knows() {
    let arm = Arm::default();
    let at = Instant::at(0.4);
    let state = arm.solver().state(&at).expect("it closes");
    let expected = arm.solver().motion(&state).expect("it is finite").forces.expect("there are masses");
    let found = arm.solver().tracker(&at).expect("it closes").motion().expect("it is finite").forces;
    assert_eq!(Some(expected), found);
}

#[test]
fn the_ratio_to_an_input_exists_although_one_of_its_motors_cannot_turn_alone() {
    let inputs = [Signal::new(0.3, 1.0, 0.0)];
    let state = Twice.solver().state(&Instant { t: 0.0, inputs: &inputs }).expect("it closes");
    let measures = ["tip.x/u", "tip.x/first"].map(|name| Measure::named(Twice::model(), name).expect("it exists"));
    let [by_input, by_motor] = Twice.solver().measure(&state, &measures).expect("it is finite")[..] else {
        panic!("there are two")
    };
    assert!((by_input + 0.3_f64.sin()).abs() < 1e-15 && by_motor.is_nan(), "{by_input} {by_motor}");
}
