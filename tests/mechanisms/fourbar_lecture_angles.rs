//! Source: `tests/data/fourbar_lecture_angles.json`.

use kin_runtime::mechanism;

/// The lecture's four-bar by the global method: three link angles and two closure equations.
/// Link 3 points from the coupler to the ground.
#[mechanism]
#[coordinates(phi1, phi2, phi3)]
#[constraint(loop_x: l1*cos(phi1) + l2*cos(phi2) + l3*cos(phi3) = d1)]
#[constraint(loop_y: l1*sin(phi1) + l2*sin(phi2) + l3*sin(phi3) = d2)]
#[driver(drive: phi1 = pi/4 + w * t)]
#[guess(phi2 = 0.9, phi3 = 5.0)]
pub struct FourbarLectureAngles {
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
