//! Source: `tests/data/scotch_yoke.json`.

use kin_runtime::mechanism;

/// Scotch yoke: the crank pin on the inclined slot of a yoke that slides along an inclined axis.
#[mechanism]
#[bodies(crank, yoke)]
#[point(S = yoke @ (0.3, -0.06))]
#[revolute(O: ground @ (0.03, -0.02), crank @ (-0.05, 0.01))]
#[translational(guide: ground @ (-0.1, 0.04), yoke @ (0.11, 0.02), axis = (0.96, 0.28), angle = c0)]
#[point_on_line(pin: S, crank @ (-0.05 + r, 0.01), axis = (0.2, 1))]
#[driver(drive: crank.phi = 0.6 + w * t)]
#[guess(yoke.phi = 0.2)]
pub struct ScotchYoke {
    /// Crank radius
    #[param(0.19, unit = "m")]
    pub r: f64,
    /// Inclination of the yoke
    #[param(0.25, unit = "rad")]
    pub c0: f64,
    /// Speed of the drive
    #[param(2.7, unit = "rad/s")]
    pub w: f64,
}
