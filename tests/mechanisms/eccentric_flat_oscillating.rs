//! The eccentric cam under the face of a lever, with frames at general positions and an inclined face.

use kin_runtime::mechanism;

/// Eccentric circular cam with an oscillating flat-faced follower; the pivot of the lever stands on a slide that moves.
#[mechanism]
#[bodies(cam, lever, slide)]
#[revolute(O: ground @ (0, 0), cam @ (0.01, -0.02))]
#[revolute(F: slide @ (0.01, 0), lever @ (0.02, -0.01))]
#[translational(way: ground @ (-0.15, 0.02), slide @ (0, 0), axis = (1, 0.2))]
#[flat_follower(contact: cam @ (0.01, -0.02), lever @ (0.15, fy), axis = (1, vy), support(theta) = r + e*cos(theta - a))]
#[driver(drive: cam.phi = 0.3 + w * t)]
#[driver(feed: slide.x = -0.15 + 0.01 * sin(t))]
#[guess(lever.phi = 0.1)]
pub struct EccentricFlatOscillating {
    /// Radius of the cam
    #[param(0.04, unit = "m")]
    pub r: f64,
    /// Distance of its centre from the shaft
    #[param(0.012, unit = "m")]
    pub e: f64,
    /// Direction of its centre in the cam's frame
    #[param(0.4, unit = "rad")]
    pub a: f64,
    /// Height of the face in the lever's frame
    #[param(0.005, unit = "m")]
    pub fy: f64,
    /// Slope of the face in the lever's frame
    #[param(0.1)]
    pub vy: f64,
    /// Speed of the shaft
    #[param(2.0, unit = "rad/s")]
    pub w: f64,
}
