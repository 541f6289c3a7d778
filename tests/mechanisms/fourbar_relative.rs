//! Source: the lecture, slide 14: solution 3.

use kin_runtime::mechanism;

/// The lecture's four-bar, solution 3: every origin is given in the frame of the body before, and three angles remain.
#[mechanism]
#[body(crank, origin = ground @ (0, 0))]
#[body(coupler, origin = crank @ (l1, 0))]
#[body(rocker, origin = coupler @ (l2, 0))]
#[point(B = coupler @ (l2, 0))]
#[revolute(D: ground @ (d1, d2), rocker @ (l3, 0))]
#[driver(drive: crank.phi = pi/4 + w * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourbarRelative {
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
