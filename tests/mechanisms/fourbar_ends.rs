//! Source: the lecture, slide 13: solution 2.

use kin_runtime::mechanism;

/// The lecture's four-bar, solution 2: frames at the ends of the links. The crank's origin never moves, so seven
/// coordinates vary.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[bodies(coupler, rocker)]
#[point(B = coupler @ (l2, 0))]
#[revolute(A: crank @ (l1, 0), coupler @ (0, 0))]
#[revolute(B: B, rocker @ (0, 0))]
#[revolute(D: ground @ (d1, d2), rocker @ (l3, 0))]
#[driver(drive: crank.phi = pi/4 + w * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourbarEnds {
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
