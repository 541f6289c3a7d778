//! Laws of forces, for every kind of joint and load: the balance of power, the resultant on the ground, the same
//! machine in several formulations, undetermined forces, and mechanisms with free degrees of freedom.

use crate::machines::*;
use kin_runtime::model::Frame;
use kin_runtime::{Forces, Instant, Kinematics, Mechanism, Signal, SolveError, State, mechanism};
use kin_tests::mechanisms::loaded;

/// Tolerance relative to the largest of the powers, or of the forces.
const EXACT: f64 = 1e-10;
/// The step of the central difference of the energy.
const STEP: f64 = 1e-3;

fn at(t: f64, signals: &[Signal]) -> Instant<'_> {
    Instant { t, inputs: signals }
}

fn energy(forces: &Forces) -> f64 {
    forces.kinetic + forces.gravity + forces.elastic
}

/// The forces at the time t, on the branch of the state `centre`.
fn forces_near<M: Kinematics>(mechanism: &M, centre: &State, t: f64) -> Forces {
    let inputs: Vec<Signal> = centre.inputs.iter().map(|signal| signal.after(t - centre.t)).collect();
    let state = mechanism.solver().state_from(&at(t, &inputs), &centre.q).unwrap();
    mechanism.solver().forces(&state).unwrap()
}

/// The time derivative of the total energy is the power of drivers, applied loads and dampers.
fn balanced<M: Kinematics>(mechanism: &M, centre: &State) {
    let forces = mechanism.solver().forces(centre).unwrap();
    let at = |k: f64| energy(&forces_near(mechanism, centre, centre.t + k * STEP));
    // Central differences of fourth order with two step sizes, extrapolated.
    let difference = |w: f64| (8.0 * (at(w) - at(-w)) - (at(2.0 * w) - at(-2.0 * w))) / (12.0 * w * STEP);
    let rate = (16.0 * difference(1.0) - difference(2.0)) / 15.0;
    assert!(forces.power_miss() <= EXACT, "{}", forces.power_miss());
    let power = forces.driver_power + forces.applied_power + forces.damper_power;
    let size = [forces.driver_power, forces.applied_power, forces.damper_power, rate, energy(&forces)]
        .iter()
        .fold(1e-3, |size: f64, value| size.max(value.abs()));
    let name = M::model().name;
    assert!((rate - power).abs() <= 1e-9 * size, "{name} at {}: {rate} instead of {power}\n{forces}", centre.t);
}

/// The forces of joints on the ground, together with those of springs and couples there, are the shaking force.
fn on_ground(forces: &Forces) {
    let mut sum = [0.0; 2];
    for reaction in &forces.reactions {
        let Some(force) = reaction.force else { continue };
        let joint = forces.model.joints.iter().find(|joint| joint.name == reaction.name);
        let grounded =
            joint.is_none_or(|joint| joint.frames.contains(&Some(Frame::Ground)) || joint.frames[1].is_none());
        let sign = if reaction.on == Some(Frame::Ground) { 1.0 } else { -1.0 };
        let carried = reaction.name.ends_with(".origin");
        if grounded && !carried {
            (0..2).for_each(|c| sum[c] += sign * force[c]);
        }
    }
    let size = forces.shaking.force.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
    for (sum, shaking) in sum.into_iter().zip(forces.shaking.force) {
        assert!((sum - shaking).abs() <= EXACT * size, "{sum} instead of {shaking}");
    }
}

macro_rules! powers {
    ($($name:ident: $Mechanism:ty, $times:expr;)*) => {$(
        #[test]
        fn $name() {
            let mechanism = <$Mechanism>::default();
            for t in $times {
                let state = mechanism.state_at(&Instant::at(t)).unwrap();
                balanced(&mechanism, &state);
            }
        }
    )*};
}

mod powers {
    use super::*;

    powers! {
        middle: Middle, [0.0, 0.4, 1.3];
        carried: Carried, [0.0, 0.4, 1.3];
        angles: Angles, [0.0, 0.4, 1.3];
        carriage: Carriage, [0.0, 0.7, 2.0];
        shaken: Shaken, [0.0, 0.4, 1.3];
        belts: Belts, [0.1, 0.7, 2.0];
        incline: Incline, [0.1, 0.7];
        discs: Discs, [0.1, 0.7];
        flat_face: FlatFace, [0.1, 0.7];
        roller: Roller, [0.1, 0.3];
        tackle: Tackle, [0.1, 1.0];
        press: Press, [0.1, 1.0];
        excavator: loaded::Excavator, [0.1, 0.5];
        planetary: loaded::PlanetaryBasic, [0.1, 0.5];
        bogie: loaded::BogieOnRail, [0.0];
        strut: loaded::MacphersonStrut, [0.1, 0.5];
        platform: loaded::Robot3rrr, [0.0];
    }
}

/// Efforts, the reaction in D and the shaking force do not depend on the formulation of the machine.
#[test]
fn one_machine_has_one_set_of_forces() {
    for t in [0.0, 0.4, 1.3] {
        let of = |forces: Result<Forces, SolveError>| forces.unwrap();
        let middle = Middle;
        let start = middle.state_at(&Instant::at(t)).unwrap();
        let middle = of(middle.solver().forces(&start));
        let carried = Carried;
        let state = carried.state_at(&Instant::at(t)).unwrap();
        let carried = of(carried.solver().forces(&state));
        let angles = Angles;
        let state = angles.state_at(&Instant::at(t)).unwrap();
        let angles = of(angles.solver().forces(&state));
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-9 * (1.0 + b.abs()), "t = {t}: {a} instead of {b}");
        for other in [&carried, &angles] {
            near(other.effort("drive").unwrap(), middle.effort("drive").unwrap());
            near(other.shaking.moment, middle.shaking.moment);
            near(other.driver_power, middle.driver_power);
            near(other.kinetic, middle.kinetic);
            (0..2).for_each(|c| near(other.shaking.force[c], middle.shaking.force[c]));
        }
        for joint in ["B", "D"] {
            let (found, exact) = (carried.reaction(joint).unwrap(), middle.reaction(joint).unwrap());
            (0..2).for_each(|c| near(found.force.unwrap()[c], exact.force.unwrap()[c]));
        }
        // The joint that holds the coupler's origin, and the one that holds the crank's.
        for (name, joint) in [("coupler.origin", "A"), ("crank.x", "O")] {
            let (found, exact) = (carried.reaction(name).unwrap(), middle.reaction(joint).unwrap());
            near(found.force.unwrap()[0], exact.force.unwrap()[0]);
        }
        let d = middle.reaction("D").unwrap().force.unwrap();
        near(angles.reaction("loop_x").unwrap().generalized[0], d[0]);
        near(angles.reaction("loop_y").unwrap().generalized[0], d[1]);
    }
}

#[test]
fn joints_with_the_ground_carry_the_shaking_force() {
    let of = |mechanism: &dyn Fn(f64) -> Forces| [0.1, 0.7].map(mechanism);
    macro_rules! grounded {
        ($($Mechanism:ty),*) => {$(
            for forces in of(&|t| {
                let mechanism = <$Mechanism>::default();
                let state = mechanism.state_at(&Instant::at(t)).unwrap();
                mechanism.solver().forces(&state).unwrap()
            }) {
                on_ground(&forces);
            }
        )*};
    }
    grounded!(Carriage, Belts, Incline, Discs, Press, Roller);
}

#[test]
fn a_cylinder_lifts_what_inputs_say() {
    let lift = Lift;
    let inputs = [Signal::new(0.7, 0.1, 0.0), Signal::new(100.0, 0.0, 0.0)];
    let state = lift.state_at(&at(0.0, &inputs)).unwrap();
    let forces = lift.solver().forces(&state).unwrap();
    balanced(&lift, &state);
    assert_eq!("cylinder", forces.efforts[0].name);
    assert!((forces.efforts[0].rate - 0.1).abs() < 1e-12, "{forces}");
    // At rest the cylinder balances the moments of both weights about the pin.
    let inputs = [Signal::constant(0.7), Signal::constant(100.0)];
    let state = lift.state_at(&at(0.0, &inputs)).unwrap();
    let forces = lift.solver().forces(&state).unwrap();
    let (sin, cos) = state.q[2].sin_cos();
    let place = |x: f64, y: f64| [x * cos - y * sin, x * sin + y * cos];
    let (mass, load, end) = (place(1.0, 0.05), place(2.0, 0.0), place(0.8, 0.1));
    let along = [(end[0] - 0.5) / 0.7, (end[1] + 0.2) / 0.7];
    let arm = end[0] * along[1] - end[1] * along[0];
    let effort = 9.81 * (40.0 * mass[0] + 100.0 * load[0]) / arm;
    let found = forces.efforts[0].effort.unwrap();
    assert!((found - effort).abs() < 1e-9 * effort, "{found} instead of {effort}");
}

#[test]
fn what_redundant_joints_share_is_undetermined_and_the_rest_is_not() {
    let mechanism = Parallelogram;
    let state = mechanism.state_at(&Instant::at(0.2)).unwrap();
    let forces = mechanism.solver().forces(&state).unwrap();
    let determined = |joint: &str| forces.reaction(joint).unwrap().determined;
    for joint in ["A", "B", "C", "O1", "O2", "O3"] {
        assert!(!determined(joint), "{forces}");
    }
    // The flap hangs in a single pin, and the drive supplies the power however the load is distributed.
    assert!(determined("hinge"), "{forces}");
    assert!(forces.effort("drive").is_some() && forces.effort("turn").is_some(), "{forces}");
    balanced(&mechanism, &state);
}

#[test]
fn what_nothing_holds_is_refused_and_a_given_coordinate_holds_it() {
    let pendulum = Pendulum;
    let state = pendulum.solver().with_guess(2, 0.3).state(&Instant::at(0.0)).unwrap();
    match pendulum.solver().forces(&state) {
        Err(SolveError::NotHeld { open: 1, could_be_given, .. }) => assert!(could_be_given.contains(&"rod.phi")),
        other => panic!("{other:?}"),
    }
    let held = pendulum.solver().with_given(2, Signal::constant(0.3));
    let state = held.state(&Instant::at(0.0)).unwrap();
    let forces = held.forces(&state).unwrap();
    let torque = 2.0 * 9.81 * 0.5 * 0.3_f64.cos();
    assert!((forces.effort("rod.phi").unwrap() - torque).abs() < 1e-12, "{forces}");
}

#[test]
fn what_dimensions_leave_open_is_refused() {
    let carrier = FreeCarrier;
    let state = carrier.state_at(&Instant::at(0.1)).unwrap();
    assert_eq!(1, state.degrees_of_freedom_left);
    match carrier.solver().forces(&state) {
        Err(SolveError::NotHeld { open: 1, .. }) => {}
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_blade_carries_a_side_force() {
    let sleigh = Sleigh;
    let state = sleigh.state_at(&Instant::at(0.0)).unwrap();
    let forces = sleigh.solver().forces(&state).unwrap();
    // The forces of blade, pull and heading accelerate the mass.
    let sum = ["blade", "pull"].map(|joint| forces.reaction(joint).unwrap().force.unwrap());
    for (c, inertia) in forces.inertia.force.into_iter().enumerate() {
        assert!((sum[0][c] + sum[1][c] + inertia).abs() < 1e-12, "{forces}");
    }
    let angle = state.q[2] + 0.2;
    let along = sum[0][0] * angle.cos() + sum[0][1] * angle.sin();
    assert!(along.abs() < 1e-12, "a blade does not pull along itself: {forces}");
}

#[test]
fn a_mechanism_without_loads_has_no_forces() {
    let four_bar = kin_tests::mechanisms::FourbarLectureMid::default();
    let state = four_bar.state_at(&Instant::at(0.0)).unwrap();
    assert!(matches!(four_bar.solver().forces(&state), Err(SolveError::NoLoads { .. })));
    assert!(kin_tests::mechanisms::FourbarLectureMid::model().forces.is_none());
}

/// A mass that pushes up and gains speed from nothing is a slip of a sign, or of a search.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[driver(drive: arm.phi = t)]
#[gravity(0, -9.81)]
#[mass(arm @ (1, 0), mass = m, inertia = j - m)]
struct Arm {
    #[param(1)]
    m: f64,
    #[param(3)]
    j: f64,
}

#[test]
fn negative_masses_are_refused() {
    let forces = |m: f64, j: f64| {
        let arm = Arm { m, j };
        arm.solver().forces(&arm.state_at(&Instant::at(0.0)).unwrap())
    };
    assert!(forces(1.0, 3.0).is_ok() && forces(0.0, 0.0).is_ok() && forces(1.0, 1.0).is_ok());
    for (m, j, expected) in [
        (-3.0, 3.0, "a mass of `arm` is -3; neither masses nor moments of inertia are negative"),
        (1.0, 0.5, "a moment of inertia of `arm` is -0.5; neither masses nor moments of inertia are negative"),
    ] {
        assert_eq!(expected, forces(m, j).unwrap_err().to_string());
    }
}
