//! Source: `tests/data/toggle_press.json`, with the loads of `tests/data/forces/toggle_press.json`.

use kin_runtime::mechanism;

/// Toggle press: a crank and its rod move a knee. The lower knee link is massless, a distance; the ram is guided by
/// `x` and `angle`.
#[mechanism]
#[bodies(crank, rod, upper, ram)]
#[point(K = ram @ (0.01, 0.06))]
#[revolute(O: ground @ (-0.35, 0.4), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (-lr/2, 0))]
#[revolute(J: rod @ (lr/2, 0), upper @ (lu, 0))]
#[revolute(T: ground @ (0, 0.71), upper @ (0, 0))]
#[distance(knee: upper @ (lu, 0), K, length = ll)]
#[x(guide: K = 0.01)]
#[angle(upright: ram = 0.05)]
#[driver(drive: crank.phi = -0.4 + w * t)]
#[guess(rod.phi = 0.1, upper.phi = -1.3, ram.y = 0.0)]
#[gravity(0, -9.81)]
#[mass(crank @ (0.074, 0.12), mass = 0.737, inertia = 0.00759)]
#[mass(rod @ (0.031, 0.1), mass = 2.81, inertia = 0.00782)]
#[mass(upper @ (0.08, -0.017), mass = 1.12, inertia = 0.00313)]
#[mass(ram @ (-0.055, 0.065), mass = 1.36, inertia = 0.0102)]
#[force(pull: ram @ (0.085, 0.081), (14.8, -5.87))]
#[force(thrust: crank @ (-0.11, 0.12), (11.8, 11.6), frame = crank)]
#[torque(load: rod = -3.33)]
#[spring(spring: ground @ (0.23, 0.1), ram @ (-0.077, 0.082), stiffness = 59.8, free_length = 0.4, damping = 5.23)]
#[torsion_spring(torsion: crank, upper, stiffness = 2.85, free_angle = 0.772, damping = 0.27)]
pub struct TogglePress {
    /// Crank length
    #[param(0.08)]
    pub r: f64,
    /// Rod length
    #[param(0.37)]
    pub lr: f64,
    /// Upper knee link
    #[param(0.31)]
    pub lu: f64,
    /// Lower knee link
    #[param(0.33)]
    pub ll: f64,
    /// Speed of the drive
    #[param(2.2)]
    pub w: f64,
}
