//! Virtual work at rest: the effort of a driver is the derivative of the potential energy with respect to the driven
//! quantity, minus the work of the other loads. Derivatives are differences between solutions with the driver moved.

use crate::bodies::{named, poses};
use crate::{FiveBarLeg, MeasuredExcavator, Weighted};
use kin_runtime::{Instant, Kinematics, Measure, Mechanism, Signal, State, mechanism};
use kin_tests::compare::Differences;
use kin_tests::mechanisms::signals;
use kin_tests::stencil::Stencil;

/// The mechanism at rest with these values of its inputs.
fn at_rest<M: Weighted>(mechanism: &M, values: &[f64], start: Option<&State>) -> State {
    let inputs: Vec<Signal> = values.iter().map(|value| Signal::constant(*value)).collect();
    let at = Instant { t: 0.0, inputs: &inputs };
    let state = match start {
        Some(near) => mechanism.solver().state_from(&at, &near.q),
        None => mechanism.solver().state(&at),
    };
    state.expect("it closes")
}

/// How far the loads that are no weights and no springs have moved along their forces at the state `middle`.
fn work<M: Weighted>(state: &State, middle: &State) -> f64 {
    let (model, here, there) = (M::model(), poses(middle), poses(state));
    let of_forces = M::LOADS.forces.iter().map(|&((body, local), components, turns)| {
        let body = named(model, body);
        let [fx, fy] = if turns { here[body].turned(components) } else { components };
        let [[x, y], ..] = there[body].point(local);
        fx * x + fy * y
    });
    let of_torques = M::LOADS.torques.iter().map(|&(from, on, couple)| {
        couple * (there[named(model, on)].at[2] - from.map_or(0.0, |from| there[named(model, from)].at[2]))
    });
    of_forces.chain(of_torques).sum()
}

/// The inputs of these mechanisms are what their drivers drive, in the same order, and nothing else moves them.
fn efforts_are_virtual_work<M: Weighted>(drivers: &[&str]) {
    let mechanism = M::default();
    let mut differences = Differences::new();
    for t in [0.0, 0.7, 1.6] {
        let values: Vec<f64> = signals::<M>(t).iter().map(|signal| signal.value).collect();
        let middle = at_rest(&mechanism, &values, None);
        let forces = mechanism.solver().forces(&middle).expect("it is held");
        assert_eq!(drivers.len(), values.len());
        differences.at(format_args!("t = {t}"));
        for (k, driver) in drivers.iter().enumerate() {
            let [_, stencil, _] = Stencil::several(0.0, 1.0);
            let samples = stencil.around(|shift| {
                let mut moved = values.clone();
                moved[k] += shift;
                let state = at_rest(&mechanism, &moved, Some(&middle));
                let forces = mechanism.solver().forces(&state).expect("it is held");
                forces.gravity + forces.elastic - work::<M>(&state, &middle)
            });
            let (effort, needed) = (forces.effort(driver).expect("a driver"), stencil.rate(&samples));
            differences.number(driver, needed, effort, 1e-8 * needed.abs().max(1.0));
            // The input is what the driver drives.
            let input = forces.inputs[k].effort.expect("it is determined");
            differences.number(forces.inputs[k].name, effort, input, 1e-12 * effort.abs());
        }
        assert!(forces.kinetic.abs() < 1e-20, "{forces}");
    }
    differences.finish();
}

#[test]
fn motors_of_a_leg() {
    efforts_are_virtual_work::<FiveBarLeg>(&["drive[0]", "drive[1]"]);
}

#[test]
fn cylinders_of_an_excavator() {
    efforts_are_virtual_work::<MeasuredExcavator>(&["cyl_boom", "cyl_stick", "cyl_bucket"]);
}

/// A pendulum whose pivot and whose angle one input moves.
#[mechanism]
#[body(pivot, x = 0, phi = 0)]
#[bodies(arm)]
#[input(u)]
#[revolute(O: pivot @ (0, 0), arm @ (0, 0))]
#[driver(lift: pivot.y = u*u)]
#[driver(drive: arm.phi = 2*u)]
#[gravity(0, -9.81)]
#[mass(arm @ (0.3, 0), mass = 2, inertia = 0.1)]
struct Lifted;

/// The effort of an input is all that enters with it: where it moves two drivers, the virtual work of both, and
/// the power in motion.
#[test]
fn an_input_bears_what_it_moves() {
    let solver = Lifted.solver();
    let [u, g] = [0.4_f64, 9.81];
    let state = solver.state(&Instant { t: 0.0, inputs: &[Signal::constant(u)] }).unwrap();
    let forces = solver.forces(&state).unwrap();
    let expected = 2.0 * g * (2.0 * u + 0.3 * (2.0 * u).cos() * 2.0);
    assert!((forces.inputs[0].effort.unwrap() - expected).abs() < 1e-12, "{forces}");
    assert_eq!(forces.effort("u"), forces.inputs[0].effort);

    let state = solver.state(&Instant { t: 0.0, inputs: &[Signal::new(u, 0.7, -0.2)] }).unwrap();
    let forces = solver.forces(&state).unwrap();
    let measured = solver.measure(&state, &[Measure::named(Lifted::model(), "u.effort").unwrap()]).unwrap();
    let power = measured[0] * 0.7;
    assert!((power - forces.energy_rate).abs() < 1e-12 * power.abs(), "{power}: {forces}");
}

/// A table that one input lifts and tilts, with an arm that two inputs turn; time moves the table aside.
#[mechanism]
#[input(u)]
#[input(v)]
#[body(table, x = 0.2*t, y = 2*u + 0.1*v*v, phi = 0.3*u)]
#[body(arm, origin = table @ (0.1, 0.4))]
#[body(top, origin = arm @ (0.3, 0), phi = 0.2 - 0.5*v)]
#[driver(drive: arm.phi = 0.4 + v + u*t)]
#[gravity(0.3, -9.81)]
#[mass(table @ (0.05, 0), mass = 2, inertia = 0.2)]
#[mass(arm @ (0.1, 0), mass = 1, inertia = 0.1)]
#[mass(top @ (0, 0.2), mass = 0.5, inertia = 0.05)]
struct Table;

/// The same if every held coordinate is a coordinate with a driver.
#[mechanism]
#[input(u)]
#[input(v)]
#[bodies(table, arm, top)]
#[x(aside: table @ (0, 0) = 0.2*t)]
#[y(lift: table @ (0, 0) = 2*u + 0.1*v*v)]
#[angle(tilt: table = 0.3*u)]
#[revolute(A: table @ (0.1, 0.4), arm @ (0, 0))]
#[revolute(B: arm @ (0.3, 0), top @ (0, 0))]
#[angle(turn: top = 0.2 - 0.5*v)]
#[driver(drive: arm.phi = 0.4 + v + u*t)]
#[gravity(0.3, -9.81)]
#[mass(table @ (0.05, 0), mass = 2, inertia = 0.2)]
#[mass(arm @ (0.1, 0), mass = 1, inertia = 0.1)]
#[mass(top @ (0, 0.2), mass = 0.5, inertia = 0.05)]
struct FreeTable;

/// An input bears the weight and the inertia of bodies whose coordinates it holds, also through those that they carry.
#[test]
fn an_input_bears_what_it_holds() {
    let inputs = [Signal::new(0.3, 0.7, -1.2), Signal::new(-0.2, 0.4, 0.9)];
    let at = Instant { t: 0.6, inputs: &inputs };
    let held = Table.solver().forces(&Table.solver().state(&at).unwrap()).unwrap();
    let free = FreeTable.solver().forces(&FreeTable.solver().state(&at).unwrap()).unwrap();
    for (of_held, of_free) in held.inputs.iter().zip(&free.inputs) {
        let [a, b] = [of_held, of_free].map(|input| input.effort.unwrap());
        assert!((a - b).abs() < 1e-12 * b.abs() && b.abs() > 1.0, "{of_held} instead of {of_free}");
    }
    assert!((held.driver_power - free.driver_power).abs() < 1e-12 * free.driver_power.abs(), "{held}\n{free}");
}
