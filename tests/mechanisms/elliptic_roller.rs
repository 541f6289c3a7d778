//! A roller on an ellipse, once with the option `roller` and once with an explicit formula of its parallel curve.

use kin_runtime::mechanism;

/// Elliptic cam whose semi-axis along x grows while it turns, with an oscillating roller follower.
#[mechanism]
#[bodies(cam, lever)]
#[coordinates(u)]
#[point(Q = lever @ (0.12, 0.02))]
#[revolute(O: ground @ (0, 0), cam @ (0.005, 0.003))]
#[revolute(F: ground @ (-0.1, 0.03), lever @ (-0.01, 0))]
#[on_curve(contact: cam @ (0.002, -0.004), Q, parametric(u) = ((a + 0.004*t)*cos(u), b*sin(u)), roller = -roller)]
#[driver(drive: cam.phi = 0.3 + 2*t)]
#[guess(lever.phi = 0.05, u = 1.3)]
pub struct EllipticRoller {
    /// Half axis along x of the cam at t = 0
    #[param(0.05, unit = "m")]
    pub a: f64,
    /// Half axis along y
    #[param(0.035, unit = "m")]
    pub b: f64,
    /// Radius of the roller
    #[param(0.01, unit = "m")]
    pub roller: f64,
}

/// The path of the roller's centre, c − R perp(c′)/|c′| with c′ = (−a sin u, b cos u), written out.
#[mechanism]
#[bodies(cam, lever)]
#[coordinates(u)]
#[point(Q = lever @ (0.12, 0.02))]
#[revolute(O: ground @ (0, 0), cam @ (0.005, 0.003))]
#[revolute(F: ground @ (-0.1, 0.03), lever @ (-0.01, 0))]
#[define(at = a + 0.004*t)]
#[on_curve(contact: cam @ (0.002, -0.004), Q, parametric(u) = (
    at*cos(u) + roller*b*cos(u) / sqrt((at*sin(u)).powi(2) + (b*cos(u)).powi(2)),
    b*sin(u) + roller*at*sin(u) / sqrt((at*sin(u)).powi(2) + (b*cos(u)).powi(2)),
))]
#[driver(drive: cam.phi = 0.3 + 2*t)]
#[guess(lever.phi = 0.05, u = 1.3)]
pub struct EllipticPath {
    /// Half axis along x of the cam at t = 0
    #[param(0.05, unit = "m")]
    pub a: f64,
    /// Half axis along y
    #[param(0.035, unit = "m")]
    pub b: f64,
    /// Radius of the roller
    #[param(0.01, unit = "m")]
    pub roller: f64,
}
