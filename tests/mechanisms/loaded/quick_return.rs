//! Source: `tests/data/quick_return.json`, with the loads of `tests/data/forces/quick_return.json`.

use kin_runtime::mechanism;

/// Quick-return shaper: a crank pin's block slides in the offset slot of a rocker, the rocker drives a ram by a rod.
#[mechanism]
#[bodies(crank, block, rocker, rod, ram)]
#[point(R = ram @ (0.05, 0.02))]
#[point(B = rocker @ (l/2, 0.01))]
#[revolute(O2: ground @ (x1, a), crank @ (0, 0))]
#[revolute(C: crank @ (r, 0), block @ (0, 0))]
#[translational(slot: rocker @ (0, 0.01 + e), block @ (0, 0), axis = (1, 0), angle = 0.15)]
#[revolute(O4: ground @ (0, 0), rocker @ (-l/2, 0.01))]
#[revolute(B: B, rod @ (-b, 0))]
#[revolute(R: rod @ (0, 0), R)]
#[translational(guide: ground @ (0, h), R, axis = (1, 0))]
#[driver(drive: crank.phi = 0.4 + w * t + 0.08 * pow(t, 2))]
#[guess(block.phi = 1.3, rocker.phi = 1.2, rod.phi = 0.0)]
#[gravity(0, -9.81)]
#[mass(crank @ (0.1, -0.018), mass = 0.86, inertia = 0.00805)]
#[mass(block @ (-0.095, -0.073), mass = 1.41, inertia = 0.0133)]
#[mass(rocker @ (0.032, 0.11), mass = 0.447, inertia = 0.00434)]
#[mass(rod @ (0.075, 0.12), mass = 1.74, inertia = 0.0185)]
#[mass(ram @ (0.055, -0.077), mass = 1.38, inertia = 0.0141)]
#[force(pull: block @ (-0.085, 0.083), (4.18, 8.88))]
#[force(thrust: crank @ (0.039, -0.089), (-10.3, 8.1), frame = crank)]
#[torque(load: rod = 2.55)]
#[spring(spring: crank @ (0.015, -0.07), ram @ (0.11, -0.12), stiffness = 93.5, free_length = 0.3, damping = 3.09)]
#[torsion_spring(torsion: ram, rocker, stiffness = 2.16, free_angle = -0.122, damping = 0.173)]
pub struct QuickReturn {
    /// Crank pin, y
    #[param(0.27)]
    pub a: f64,
    /// Crank pin, x
    #[param(0.012)]
    pub x1: f64,
    /// Crank length
    #[param(0.12)]
    pub r: f64,
    /// Rocker length
    #[param(0.62)]
    pub l: f64,
    /// Rod length
    #[param(0.33)]
    pub b: f64,
    /// Height of the guide
    #[param(0.58)]
    pub h: f64,
    /// Offset of the slot
    #[param(0.015)]
    pub e: f64,
    /// Speed of the drive
    #[param(1.9)]
    pub w: f64,
}
