//! Source: `tests/data/slider_crank_inline.json`, with the loads of `tests/data/forces/slider_crank_inline.json`.

use kin_runtime::mechanism;

/// In-line slider-crank with a crank that is not driven uniformly; the rod's frame is off the line of its joints.
#[mechanism]
#[bodies(crank, rod, slider)]
#[point(slider_B = slider @ (0.02, -0.03))]
#[point(rod_B = rod @ (0.7 * l, h))]
#[revolute(O: ground @ (0, 0), crank @ (-r/2, 0))]
#[revolute(A: crank @ (r/2, 0), rod @ (-0.3 * l, h))]
#[revolute(B: rod_B, slider_B)]
#[translational(guide: ground @ (0, 0), slider_B, axis = (1, 0))]
#[driver(drive: crank.phi = a + b * t + c * sin(w * t))]
#[guess(rod.phi = -0.1)]
#[gravity(0, -9.81)]
#[mass(crank @ (-0.044, -0.039), mass = 0.853, inertia = 0.0247)]
#[mass(rod @ (-0.083, 0.2), mass = 2.23, inertia = 0.0212)]
#[mass(slider @ (-0.12, 0.15), mass = 0.721, inertia = 0.0249)]
#[force(pull: slider @ (-0.076, 0.079), (-13.3, -10.4))]
#[force(thrust: rod @ (0.17, -0.15), (6.43, 10.1), frame = rod)]
#[torque(load: crank = -1.95)]
#[spring(spring: rod @ (0.066, -0.05), crank @ (0.13, 0.082), stiffness = 28, free_length = 0.18, damping = 1.77)]
#[torsion_spring(torsion: crank, rod, stiffness = 4.89, free_angle = 0.111, damping = 0.162)]
pub struct SliderCrankInline {
    /// Crank length
    #[param(0.23)]
    pub r: f64,
    /// Rod length
    #[param(0.71)]
    pub l: f64,
    /// Crank angle at t = 0
    #[param(0.31)]
    pub a: f64,
    /// Mean speed of the crank
    #[param(2.1)]
    pub b: f64,
    /// Amplitude of the ripple
    #[param(0.17)]
    pub c: f64,
    /// Speed of the drive
    #[param(3.3)]
    pub w: f64,
    /// The rod's joints, above its frame
    #[param(0.04)]
    pub h: f64,
}
