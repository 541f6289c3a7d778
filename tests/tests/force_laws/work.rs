//! Virtual work at rest: the effort of a driver is the derivative of the potential energy by what it drives, less the
//! work of the other loads, by differences of the mechanism solved again with that driver moved.

use crate::bodies::{named, poses};
use crate::{FiveBarLeg, MeasuredExcavator, Weighted};
use kin_runtime::{Instant, Signal, State};
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
