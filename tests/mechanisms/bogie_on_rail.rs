//! Source: `tests/data/bogie_on_rail.json`.

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
pub struct BogieOnRail {
    /// Length along the rail of one unit of the parameter
    #[param(0.5, unit = "m")]
    pub a: f64,
    /// Height of the rail's waves
    #[param(0.08, unit = "m")]
    pub b: f64,
    /// Their wave number
    #[param(1.9)]
    pub k: f64,
}
