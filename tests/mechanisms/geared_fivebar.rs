//! Source: `tests/data/geared_fivebar.json`.

use kin_runtime::mechanism;

/// Geared five-bar: two cranks on the ground, coupled by an external gear pair, move the joint of two links.
#[mechanism]
#[bodies(crank1, crank2, link1, link2)]
#[point(C = link2 @ (0, 0))]
#[revolute(O1: ground @ (0, 0), crank1 @ (0, 0))]
#[revolute(O2: ground @ (c0, 0.02), crank2 @ (0.02, 0.01))]
#[revolute(A: crank1 @ (0.12, 0), link1 @ (-0.145, 0))]
#[revolute(B: crank2 @ (0.12, 0.01), link2 @ (0.3, 0))]
#[revolute(C: link1 @ (0.145, 0), C)]
#[gear(mesh: crank1, crank2, radii = (r1, r2), offset = c0)]
#[driver(drive: crank1.phi = 0.5 + w * t)]
#[guess(crank2.phi = 1.2, link1.phi = 1.4, link2.phi = -0.9)]
pub struct GearedFivebar {
    /// Radius of the gear on the first crank
    #[param(0.11, unit = "m")]
    pub r1: f64,
    /// Radius of the gear on the second crank
    #[param(0.22, unit = "m")]
    pub r2: f64,
    /// Distance of the cranks, and constant of the gear pair
    #[param(0.33)]
    pub c0: f64,
    /// Speed of the drive
    #[param(2.5, unit = "rad/s")]
    pub w: f64,
}
