//! The balance of power: within the reported values, and compared with differences of the energy along the motion.

use crate::{Weighted, forces_at, swept};
use kin_runtime::Forces;
use kin_tests::compare::{Differences, largest};
use kin_tests::stencil::Stencil;

/// Drivers, applied loads and dampers supply the rate of all energy: by the derivatives of the energies themselves to
/// 1e-10, and by sixth-order differences of the energy of the motion, solved again at neighbouring instants.
pub(crate) fn power_is_the_rate_of_energy<M: Weighted>(from: f64, to: f64) {
    let mechanism = M::default();
    let mut differences = Differences::new();
    for stencil in Stencil::several(from, to) {
        let trajectory = swept(&mechanism, &stencil.times(from));
        let forces = trajectory.states[1..].iter().map(|state| forces_at(&mechanism, state));
        let Some(forces) = forces.collect::<Option<Vec<Forces>>>() else { return };
        let middle = &forces[Stencil::REACH];
        let powers = [middle.driver_power, middle.applied_power, middle.damper_power];
        differences.at(format_args!("t = {}", middle.t));
        differences.number("miss of power", 0.0, middle.power_miss(), 1e-10);
        let energies: Vec<f64> = forces.iter().map(|f| f.kinetic + f.gravity + f.elastic).collect();
        let rate = stencil.rate(&energies);
        let size = largest(&powers).max(rate.abs()).max(largest(&energies) / (to - from));
        differences.number("rate of energy", rate, powers.iter().sum(), 1e-8 * size);
    }
    differences.finish();
}
