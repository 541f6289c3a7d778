//! Source: `tests/data/bogie_on_rail.json`, with the loads of `tests/data/forces/bogie_on_rail.json`.

use kin_runtime::mechanism;

/// Bogie with two wheel centres on a sine rail that is fixed in the ground.
#[mechanism]
#[bodies(bogie)]
#[coordinates(u1, u2)]
#[point(M = bogie @ (0.01, 0.1))]
#[point(C = ground @ (0.1, 0.05))]
#[on_curve(front: C, bogie @ (-0.16, -0.06), parametric(u1) = (a * u1, b * sin(k * u1)))]
#[on_curve(rear: C, bogie @ (0.15, -0.05), parametric(u2) = (a * u2, b * sin(k * u2)))]
#[driver(drive: M.x = 0.4 + 0.7*t + 0.1*sin(2*t))]
#[guess(bogie.x = 0.4, bogie.y = 0.15, bogie.phi = 0.1, u1 = 0.3, u2 = 0.9)]
#[gravity(0, -9.81)]
#[mass(bogie @ (-0.07, 0.036), mass = 2.86, inertia = 0.0151)]
#[force(pull: bogie @ (0.051, -0.054), (14.4, 9.94))]
#[force(thrust: bogie @ (-0.067, 0.051), (12, -6.71), frame = bogie)]
#[torque(load: bogie = 1.71)]
#[spring(spring: ground @ (-0.19, -0.13), bogie @ (-0.05, -0.011), stiffness = 70, free_length = 1.11, damping = 20)]
#[torsion_spring(torsion: ground, bogie, stiffness = 0.601, free_angle = 0.198, damping = 0.0286)]
pub struct BogieOnRail {
    /// Length along the rail of one unit of the parameter
    #[param(0.5)]
    pub a: f64,
    /// Height of the rail's waves
    #[param(0.08)]
    pub b: f64,
    /// Their wave number
    #[param(1.9)]
    pub k: f64,
}
