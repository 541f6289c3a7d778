//! Source: `tests/data/toggle_press.json`.

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
pub struct TogglePress {
    /// Crank length
    #[param(0.08, unit = "m")]
    pub r: f64,
    /// Rod length
    #[param(0.37, unit = "m")]
    pub lr: f64,
    /// Upper knee link
    #[param(0.31, unit = "m")]
    pub lu: f64,
    /// Lower knee link
    #[param(0.33, unit = "m")]
    pub ll: f64,
    /// Speed of the drive
    #[param(2.2, unit = "rad/s")]
    pub w: f64,
}
