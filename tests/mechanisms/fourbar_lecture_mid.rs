//! Source: `tests/data/fourbar_lecture_mid.json`.

use kin_runtime::mechanism;

/// The lecture's four-bar, solution 1: frames in the middle of the links, x axes along them.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[point(B = coupler @ (l2/2, 0))]
#[revolute(O: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: B, rocker @ (-l3/2, 0))]
#[revolute(D: ground @ (d1, d2), rocker @ (l3/2, 0))]
#[driver(drive: crank.phi = pi / 4 + w * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourbarLectureMid {
    /// Crank length
    #[param(0.1, unit = "m")]
    pub l1: f64,
    /// Coupler length
    #[param(0.4, unit = "m")]
    pub l2: f64,
    /// Rocker length
    #[param(0.3, unit = "m")]
    pub l3: f64,
    /// Ground pin D, x
    #[param(0.4, unit = "m")]
    pub d1: f64,
    /// Ground pin D, y
    #[param(0.1, unit = "m")]
    pub d2: f64,
    /// Speed of the drive
    #[param(2.3, unit = "rad/s")]
    pub w: f64,
}
