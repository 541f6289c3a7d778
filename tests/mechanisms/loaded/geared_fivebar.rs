//! Source: `tests/data/geared_fivebar.json`, with the loads of `tests/data/forces/geared_fivebar.json`.

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
#[gravity(0, -9.81)]
#[mass(crank1 @ (-0.03, -0.1), mass = 1.27, inertia = 0.00597)]
#[mass(crank2 @ (0.038, 0.084), mass = 1.35, inertia = 0.0102)]
#[mass(link1 @ (0.035, 0.079), mass = 1.14, inertia = 0.00326)]
#[mass(link2 @ (-0.059, -0.076), mass = 2.8, inertia = 0.0246)]
#[force(pull: link2 @ (-0.1, 0.11), (-11.8, -9.28))]
#[force(thrust: crank2 @ (-0.03, -0.095), (-11.6, 8.57), frame = crank2)]
#[torque(load: link1 = -3.23)]
#[spring(spring: ground @ (-0.29, -0.36), crank2 @ (0.094, 0.02), stiffness = 50.1, free_length = 0.664, damping = 5.47)]
#[torsion_spring(torsion: link2, link1, stiffness = 0.986, free_angle = -0.564, damping = 0.245)]
pub struct GearedFivebar {
    /// Radius of the gear on the first crank
    #[param(0.11)]
    pub r1: f64,
    /// Radius of the gear on the second crank
    #[param(0.22)]
    pub r2: f64,
    /// Distance of the cranks, and constant of the gear pair
    #[param(0.33)]
    pub c0: f64,
    /// Speed of the drive
    #[param(2.5)]
    pub w: f64,
}
