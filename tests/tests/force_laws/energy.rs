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
        let mut forces = Vec::new();
        for state in &trajectory.states[1..] {
            let Some(of_state) = forces_at(&mechanism, state) else { return };
            forces.push(of_state);
        }
        balance(&forces, &stencil, to - from, &mut differences);
    }
    differences.finish();
}

/// The same from the forces at all places of a stencil, in a motion of this duration.
fn balance(forces: &[Forces], stencil: &Stencil, duration: f64, differences: &mut Differences) {
    let middle = &forces[Stencil::REACH];
    let powers = [middle.driver_power, middle.applied_power, middle.damper_power];
    differences.at(format_args!("t = {}", middle.t));
    differences.number("miss of power", 0.0, middle.power_miss(), 1e-10);
    let energies: Vec<f64> = forces.iter().map(|f| f.kinetic + f.gravity + f.elastic).collect();
    let rate = stencil.rate(&energies);
    let size = largest(&powers).max(rate.abs()).max(largest(&energies) / duration);
    differences.number("rate of energy", rate, powers.iter().sum(), 1e-8 * size);
}
