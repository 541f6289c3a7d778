//! The textbook's eccentric circular cam under a flat face: the lift is r + e sin φ.

use kin_runtime::mechanism;

/// Eccentric circular cam with a translating flat-faced follower.
#[mechanism]
#[bodies(cam, follower)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(guide: ground @ (0.01, 0), follower @ (0.01, 0.03), axis = (0, 1))]
#[flat_follower(contact: cam @ (0, 0), follower @ (0.02, 0), axis = (1, 0), support(theta) = r + e*cos(theta))]
#[driver(drive: cam.phi = 0.3 + w*t + 0.2*t*t)]
#[guess(follower.y = r)]
pub struct EccentricFlatTranslating {
    /// Radius of the cam
    #[param(0.04, unit = "m")]
    pub r: f64,
    /// Distance of its centre from the shaft
    #[param(0.012, unit = "m")]
    pub e: f64,
    /// Speed of the shaft at t = 0
    #[param(2.0, unit = "rad/s")]
    pub w: f64,
}
