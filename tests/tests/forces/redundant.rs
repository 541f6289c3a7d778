//! Forces that redundant rows leave undetermined, forces that are determined nevertheless, and forces of least norm.

use crate::machines::*;
use kin_runtime::{Forces, Instant, Kinematics, Mechanism, Signal, SolveError, State, mechanism};

/// A beam in two pins, pushed along itself, below a load of an input's size.
#[mechanism(allow_redundant)]
#[input(load, push)]
#[bodies(beam)]
#[revolute(left: ground @ (-0.6, 0), beam @ (-0.6, 0))]
#[revolute(right: ground @ (0.6, 0), beam @ (0.6, 0))]
#[force(weight: beam @ (0.2, 0), (0, -load))]
#[force(along: beam @ (0, 0), (push, 0))]
#[derive(Default)]
struct Beam;

/// The same with one pin written as two rows of its own and the other by a long axis.
#[mechanism(allow_redundant)]
#[input(load, push)]
#[bodies(beam)]
#[point_on_line(left_x: ground @ (-0.6, 0), beam @ (-0.6, 0), axis = (0, 40))]
#[point_on_line(left_y: ground @ (-0.6, 0), beam @ (-0.6, 0), axis = (0.001, 0))]
#[revolute(right: ground @ (0.6, 0), beam @ (0.6, 0))]
#[force(weight: beam @ (0.2, 0), (0, -load))]
#[force(along: beam @ (0, 0), (push, 0))]
#[derive(Default)]
struct BeamByLines;

/// Two motors on one shaft, which carries a couple.
#[mechanism(allow_redundant)]
#[bodies(shaft)]
#[revolute(O: ground @ (0, 0), shaft @ (0, 0))]
#[driver(one: shaft.phi = 0.3)]
#[driver(other: shaft.phi = 0.3)]
#[torque(load: shaft = -10)]
#[derive(Default)]
struct TwoMotors;

fn near(found: f64, exact: f64, size: f64) {
    assert!((found - exact).abs() <= 1e-9 * size, "{found} instead of {exact}");
}

fn beam(mechanism: &impl Kinematics, load: f64, push: f64) -> [Forces; 2] {
    let inputs = [Signal::constant(load), Signal::constant(push)];
    let at = Instant { t: 0.0, inputs: &inputs };
    let state = mechanism.solver().state(&at).unwrap();
    [mechanism.solver().forces(&state).unwrap(), mechanism.solver().forces_of_least_norm(&state).unwrap()]
}

#[test]
fn two_pins_share_equally_what_is_asked_for_and_nothing_otherwise() {
    for load in [1.0, 3e-7, 1e8] {
        let push = 2.5 * load;
        let [forces, least] = beam(&Beam, load, push);
        for joint in ["left", "right"] {
            assert!(!forces.reaction(joint).unwrap().determined, "{forces}");
            assert_eq!(None, forces.reaction(joint).unwrap().force);
            assert!(!least.reaction(joint).unwrap().determined, "{least}");
        }
        let of = |joint: &str| least.reaction(joint).unwrap().force.unwrap();
        // Moments about the pins tell the vertical forces; along the beam only the sum is known.
        near(of("left")[1], load / 3.0, load);
        near(of("right")[1], 2.0 * load / 3.0, load);
        near(of("left")[0], -push / 2.0, load);
        near(of("right")[0], -push / 2.0, load);
        near(least.shaking.force[0], push, load);
    }
}

#[test]
fn least_forces_do_not_depend_on_how_rows_are_written() {
    let [forces, least] = beam(&BeamByLines, 7.0, 3.0);
    let of = |forces: &Forces, joint: &str| forces.reaction(joint).unwrap().force.unwrap();
    near(of(&least, "left_x")[0], -1.5, 7.0);
    near(of(&least, "right")[0], -1.5, 7.0);
    // The vertical force of the left pin is a row of its own here, and so it is known.
    assert!(forces.reaction("left_y").unwrap().determined, "{forces}");
    near(of(&forces, "left_y")[1], 7.0 / 3.0, 7.0);
    assert!(!forces.reaction("left_x").unwrap().determined, "{forces}");
}

#[test]
fn motors_on_one_shaft_share_a_couple_only_where_that_is_asked_for() {
    let state = TwoMotors.state_at(&Instant::at(0.0)).unwrap();
    let forces = TwoMotors.solver().forces(&state).unwrap();
    assert!(forces.efforts.iter().all(|effort| effort.effort.is_none() && !effort.determined), "{forces}");
    let least = TwoMotors.solver().forces_of_least_norm(&state).unwrap();
    for effort in &least.efforts {
        near(effort.effort.unwrap(), 5.0, 1.0);
        assert!(!effort.determined);
    }
}

/// Newton's and Euler's laws of the parallelogram's coupler, with the flap that hangs on it.
#[test]
fn least_forces_balance_and_no_others_are_smaller() {
    let state = Parallelogram.state_at(&Instant::at(0.2)).unwrap();
    let solver = Parallelogram.solver();
    let least = solver.forces_of_least_norm(&state).unwrap();
    let force = |joint: &str| least.reaction(joint).unwrap().force.unwrap();
    let [a, b, c, hinge] = ["A", "B", "C", "hinge"].map(force);
    let place = |k: usize| state.q_ddot[k];
    // The second operand of A and hinge's first are the coupler; of B and C it is the first, too.
    let (cos, sin) = (state.q[5].cos(), state.q[5].sin());
    let (omega, alpha) = (state.q_dot[5], state.q_ddot[5]);
    let centre =
        [place(3) - 0.05 * (alpha * sin + omega * omega * cos), place(4) + 0.05 * (alpha * cos - omega * omega * sin)];
    near(a[0] - b[0] - c[0] - hinge[0], 3.0 * centre[0], 40.0);
    near(a[1] - b[1] - c[1] - hinge[1], 3.0 * (centre[1] + 9.81), 40.0);
    assert!(least.reaction("hinge").unwrap().determined);
    let usual = solver.forces(&state).unwrap();
    near(usual.effort("drive").unwrap(), least.effort("drive").unwrap(), 1.0);
}

/// A joint that is determined stays so beside loads of any size.
#[test]
fn large_loads_do_not_blur_what_is_determined() {
    let [forces, _] = beam(&BeamByLines, 1e8, 3e8);
    assert!(forces.reaction("left_y").unwrap().determined, "{forces}");
    near(forces.reaction("left_y").unwrap().force.unwrap()[1], 1e8 / 3.0, 1e8);
}

/// Dimensions leave the carrier free although no symbol shows it; where its angle is given, statics tells the torque.
#[test]
fn a_square_system_that_dimensions_leave_open_is_held_by_a_given_coordinate() {
    let carrier = FreeCarrier;
    assert!(FreeCarrier::model().forces.unwrap().solved, "this is about machines with closed forms");
    let place = FreeCarrier::model().coordinates.iter().position(|c| c.name == "carrier.phi").unwrap();
    let held = carrier.solver().with_given(place, Signal::constant(0.4));
    let state = held.state(&Instant::at(0.1)).unwrap();
    let forces = held.forces(&state).unwrap();
    let power = forces.driver_power;
    near(power, forces.energy_rate - forces.applied_power - forces.damper_power, power.abs().max(1.0));
    assert!(forces.effort("carrier.phi").is_some(), "{forces}");
    assert!(forces.reaction("S").is_some());
}

/// A crank-slider whose slider is driven to its dead centre, where the pins' forces grow without bounds.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[input(place)]
#[driver(push: slider.x = place)]
#[guess(crank.phi = 0.5, rod.phi = -0.1)]
#[mass(crank @ (0.1, 0), mass = 1, inertia = 0.01)]
#[gravity(0, -9.81)]
#[derive(Default)]
struct DeadCentre;

#[test]
fn a_dead_centre_names_the_joints_whose_forces_grow() {
    let at = |place: f64| [Signal::constant(place)];
    let inputs = at(0.9);
    // Position analysis stands there, velocity analysis says that it is singular, with the rows that depend on one another.
    match DeadCentre.solver().state(&Instant { t: 0.0, inputs: &inputs }) {
        Err(SolveError::Singular { rows, .. }) => assert!(rows.contains(&"push"), "{rows:?}"),
        other => panic!("{other:?}"),
    }
    // A state that somebody made by hand is there, too.
    let inputs = at(0.8);
    let near = DeadCentre.solver().state(&Instant { t: 0.0, inputs: &inputs }).unwrap();
    assert!(DeadCentre.solver().forces(&near).is_ok());
    let q = vec![0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.9, 0.0, 0.0];
    let state = State { q, q_dot: vec![0.0; 9], q_ddot: vec![0.0; 9], inputs: at(0.9).to_vec(), ..near };
    match DeadCentre.solver().forces(&state) {
        Err(SolveError::UnboundedForces { joints, .. }) => {
            assert!(["B", "push"].iter().all(|joint| joints.contains(joint)), "{joints:?}");
        }
        other => panic!("{other:?}"),
    }
}

/// A bar on three parallel cranks of one length.
#[mechanism(allow_redundant)]
#[bodies(a, b, c, bar)]
#[revolute(A0: ground @ (0, 0), a @ (0, 0))]
#[revolute(B0: ground @ (2*l, 0), b @ (0, 0))]
#[revolute(C0: ground @ (4*l, 0), c @ (0, 0))]
#[revolute(A: a @ (l, 0), bar @ (0, 0))]
#[revolute(B: b @ (l, 0), bar @ (2*l, 0))]
#[revolute(C: c @ (l, 0), bar @ (4*l, 0))]
#[driver(drive: a.phi = 1)]
#[guess(b.phi = 1, c.phi = 1, bar.x = 0.5*l, bar.y = 0.8*l)]
#[mass(bar @ (l, 0.3*l), mass = 2)]
#[gravity(0, -9.81)]
struct Cranks {
    #[param(1)]
    l: f64,
}

/// Which forces are determined does not depend on the unit of length.
#[test]
fn what_is_determined_does_not_depend_on_the_size() {
    for l in [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e6] {
        let cranks = Cranks { l };
        let state = cranks.state_at(&Instant::at(0.0)).unwrap();
        let forces = cranks.solver().forces(&state).unwrap();
        for reaction in &forces.reactions {
            assert!(!reaction.determined && reaction.force.is_none(), "l = {l}: {reaction}");
        }
        near(forces.effort("drive").unwrap(), 2.0 * 9.81 * l * 1_f64.cos(), l);
    }
}

/// Two motors on one shaft, each with an input of its own.
#[mechanism(allow_redundant)]
#[bodies(shaft)]
#[input(u, v)]
#[revolute(O: ground @ (0, 0), shaft @ (0, 0))]
#[driver(one: shaft.phi = u)]
#[driver(other: shaft.phi = v)]
#[torque(load: shaft = -10)]
struct TwoInputs;

/// Two motors on one shaft that follow one input.
#[mechanism(allow_redundant)]
#[bodies(shaft)]
#[input(u)]
#[revolute(O: ground @ (0, 0), shaft @ (0, 0))]
#[driver(one: shaft.phi = u)]
#[driver(other: 2 * shaft.phi = 2 * u)]
#[torque(load: shaft = -10)]
struct OneInput;

/// An input that can move alone bears the whole load; of two that cannot, nothing tells what each of them bears.
#[test]
fn the_effort_of_an_input_is_determined_where_it_can_move_alone() {
    let inputs = [Signal::new(0.3, 1.0, 0.0); 2];
    let state = TwoInputs.state_at(&Instant { t: 0.0, inputs: &inputs }).unwrap();
    let forces = TwoInputs.solver().forces(&state).unwrap();
    assert!(forces.inputs.iter().all(|input| !input.determined && input.effort.is_none()), "{forces}");
    let least = TwoInputs.solver().forces_of_least_norm(&state).unwrap();
    assert!(least.inputs.iter().all(|input| !input.determined), "{least}");
    least.inputs.iter().for_each(|input| near(input.effort.unwrap(), 5.0, 1.0));

    let state = OneInput.state_at(&Instant { t: 0.0, inputs: &inputs[..1] }).unwrap();
    let forces = OneInput.solver().forces(&state).unwrap();
    assert!(forces.efforts.iter().all(|effort| !effort.determined), "{forces}");
    assert!(forces.inputs[0].determined, "{forces}");
    near(forces.inputs[0].effort.unwrap(), 10.0, 1.0);
}

/// The moment of a pin is 0 however the load is shared, and is no choice among many.
#[test]
fn text_says_what_is_determined_and_what_is_chosen() {
    let [forces, least] = beam(&Beam, 1.0, 2.0);
    let text = forces.reaction("left").unwrap().to_string();
    assert_eq!("left: undetermined, redundant rows share the load; determined: moment 0", text);
    let text = least.reaction("left").unwrap().to_string();
    assert!(text.starts_with("left: undetermined, redundant rows share the load; of least norm: force ("), "{text}");
}
