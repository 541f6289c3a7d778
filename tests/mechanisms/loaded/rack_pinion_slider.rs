//! Source: `tests/data/rack_pinion_slider.json`, with the loads of `tests/data/forces/rack_pinion_slider.json`.

use kin_runtime::mechanism;

/// A slider-crank moves a rack along an inclined guide, and the rack turns a pinion.
#[mechanism]
#[bodies(crank, rod, rack, pinion)]
#[point(K = pinion @ (0.06, 0))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (-l/2, 0))]
#[revolute(B: rod @ (l/2, 0), rack @ (-0.1, 0.01))]
#[translational(guide: ground @ (0.03, -0.05), rack @ (-0.1, 0.01), axis = (0.96, 0.28), angle = c)]
#[revolute(Z: ground @ (0.5, 0.2), pinion @ (0.01, -0.02))]
#[rack_pinion(
    mesh: ground @ (0.03, -0.05), rack @ (-0.1, 0.01),
    axis = (0.96, 0.28), pinion = pinion, radius = rp, offset = c0
)]
#[driver(drive: crank.phi = 0.9 + w * t)]
#[guess(rack.x = 0.49)]
#[gravity(0, -9.81)]
#[mass(crank @ (-0.028, 0.021), mass = 2.9, inertia = 0.0136)]
#[mass(rod @ (0.013, 0.064), mass = 2.92, inertia = 0.00526)]
#[mass(rack @ (-0.044, 0.014), mass = 1.58, inertia = 0.007)]
#[mass(pinion @ (0.055, 0.069), mass = 2.07, inertia = 0.00955)]
#[force(pull: rack @ (-0.015, -0.071), (-7.54, 7.14))]
#[force(thrust: pinion @ (-0.022, 0.059), (6.41, -14.8), frame = pinion)]
#[torque(load: crank = 1.2)]
#[spring(spring: pinion @ (-0.035, -0.033), crank @ (-0.063, 0.013), stiffness = 141, free_length = 0.345, damping = 7.26)]
#[torsion_spring(torsion: rod, rack, stiffness = 0.734, free_angle = -0.133, damping = 0.121)]
pub struct RackPinionSlider {
    /// Crank radius
    #[param(0.09)]
    pub r: f64,
    /// Rod length
    #[param(0.34)]
    pub l: f64,
    /// Radius of the pinion
    #[param(0.07)]
    pub rp: f64,
    /// Constant of rack and pinion
    #[param(0.11)]
    pub c0: f64,
    /// Inclination of the rack against its guide
    #[param(0.28)]
    pub c: f64,
    /// Speed of the drive
    #[param(2.6)]
    pub w: f64,
}
