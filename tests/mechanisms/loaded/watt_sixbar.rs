//! Source: `tests/data/watt_sixbar.json`, with the loads of `tests/data/forces/watt_sixbar.json`.

use kin_runtime::mechanism;

/// Watt-I six-bar: a four-bar whose ternary coupler and ternary rocker carry a second dyad.
#[mechanism]
#[bodies(crank, coupler, rocker, link5, link6)]
#[point(G = link6 @ (0.27, 0))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.15, 0), coupler @ (-0.18, -0.04))]
#[revolute(B: coupler @ (0.19, -0.03), rocker @ (0.28, 0.03))]
#[revolute(D: ground @ (0.42, 0.05), rocker @ (0, 0))]
#[revolute(E: coupler @ (0.02, 0.17), link5 @ (-0.15, 0.01))]
#[revolute(F: rocker @ (0.17, -0.14), link6 @ (0, 0))]
#[revolute(G: link5 @ (0.16, 0), G)]
#[driver(drive: crank.phi = 0.3 + w * t + 0.2 * sin(2 * t))]
#[guess(coupler.phi = 0.8, rocker.phi = 1.6, link5.phi = 0.4, link6.phi = 2.2)]
#[gravity(0, -9.81)]
#[mass(crank @ (-0.093, 0.045), mass = 1.71, inertia = 0.0152)]
#[mass(coupler @ (-0.045, -0.12), mass = 2.48, inertia = 0.0104)]
#[mass(rocker @ (-0.054, -0.1), mass = 0.502, inertia = 0.00174)]
#[mass(link5 @ (0.065, 0.077), mass = 0.572, inertia = 0.00444)]
#[mass(link6 @ (0.038, -0.092), mass = 1.68, inertia = 0.00748)]
#[force(pull: link5 @ (-0.086, 0.051), (-7.96, 11.8))]
#[force(thrust: crank @ (0.068, 0.066), (12.5, 12.6), frame = crank)]
#[torque(load: rocker = 2.54)]
#[spring(spring: crank @ (-0.039, -0.048), rocker @ (0.12, -0.066), stiffness = 81.9, free_length = 0.419, damping = 11.2)]
#[torsion_spring(torsion: link5, rocker, stiffness = 2.19, free_angle = 0.134, damping = 0.0619)]
pub struct WattSixbar {
    /// Speed of the drive
    #[param(1.7)]
    pub w: f64,
}
