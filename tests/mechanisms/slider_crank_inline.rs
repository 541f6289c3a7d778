//! Source: `tests/data/slider_crank_inline.json`.

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
pub struct SliderCrankInline {
    /// Crank length
    #[param(0.23, unit = "m")]
    pub r: f64,
    /// Rod length
    #[param(0.71, unit = "m")]
    pub l: f64,
    /// Crank angle at t = 0
    #[param(0.31, unit = "rad")]
    pub a: f64,
    /// Mean speed of the crank
    #[param(2.1, unit = "rad/s")]
    pub b: f64,
    /// Amplitude of the ripple
    #[param(0.17, unit = "rad")]
    pub c: f64,
    /// Speed of the drive
    #[param(3.3, unit = "rad/s")]
    pub w: f64,
    /// The rod's joints, above its frame
    #[param(0.04, unit = "m")]
    pub h: f64,
}
