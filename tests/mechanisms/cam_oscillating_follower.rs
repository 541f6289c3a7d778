//! Source: `tests/data/cam_oscillating_follower.json`.

use kin_runtime::mechanism;

/// Cam with an oscillating roller follower: the roller's centre runs on the pitch curve.
#[mechanism]
#[bodies(cam, follower)]
#[point(Q = follower @ (0.19, 0.05))]
#[revolute(O: ground @ (0, 0), cam @ (0.01, 0.02))]
#[revolute(F: ground @ (0.35, 0.05), follower @ (-0.12, 0.03))]
#[on_curve(contact: cam @ (0.03, -0.01), Q, polar(theta) = a + b*cos(theta) + c*sin(2*theta))]
#[driver(drive: cam.phi = 0.3 + w * t)]
#[guess(follower.phi = 2.4)]
pub struct CamOscillatingFollower {
    /// Mean radius of the pitch curve
    #[param(0.2, unit = "m")]
    pub a: f64,
    /// Its eccentricity
    #[param(0.03, unit = "m")]
    pub b: f64,
    /// Its second harmonic
    #[param(0.012, unit = "m")]
    pub c: f64,
    /// Speed of the drive
    #[param(2.4, unit = "rad/s")]
    pub w: f64,
}
