//! Source: `tests/data/rack_pinion_slider.json`.

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
pub struct RackPinionSlider {
    /// Crank radius
    #[param(0.09, unit = "m")]
    pub r: f64,
    /// Rod length
    #[param(0.34, unit = "m")]
    pub l: f64,
    /// Radius of the pinion
    #[param(0.07, unit = "m")]
    pub rp: f64,
    /// Constant of rack and pinion
    #[param(0.11, unit = "m")]
    pub c0: f64,
    /// Inclination of the rack against its guide
    #[param(0.28, unit = "rad")]
    pub c: f64,
    /// Speed of the drive
    #[param(2.6, unit = "rad/s")]
    pub w: f64,
}
