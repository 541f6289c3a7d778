//! Source: `tests/data/singular_slider_crank.json`.

use kin_runtime::mechanism;

/// A slider-crank driven at its slider up to dead centre, x = r + l at t = 0.475, beyond which it does not assemble.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (-l/2, 0))]
#[revolute(B: rod @ (l/2, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: slider.x = x0 + v * t)]
#[guess(crank.phi = 1.2, rod.phi = -0.3)]
pub struct SingularSliderCrank {
    /// Crank length
    #[param(0.23, unit = "m")]
    pub r: f64,
    /// Rod length
    #[param(0.71, unit = "m")]
    pub l: f64,
    /// Slider at t = 0
    #[param(0.75, unit = "m")]
    pub x0: f64,
    /// Speed of the slider
    #[param(0.4, unit = "m/s")]
    pub v: f64,
}
