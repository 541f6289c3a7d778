//! Source: `tests/data/cam_ellipse_implicit.json`.

use kin_runtime::mechanism;

/// Elliptic cam with a translating knife follower whose guide is offset from the cam's axis.
#[mechanism]
#[bodies(cam, follower)]
#[point(Q = follower @ (0.01, -0.1))]
#[revolute(O: ground @ (0.01, 0), cam @ (0.02, -0.03))]
#[translational(guide: ground @ (0.04, 0.5), Q, axis = (0, 1), angle = 0.1)]
#[on_curve(contact: cam @ (0.05, 0.01), Q, implicit(X, Y) = (X / a).powi(2) + (Y / b).powi(2) - 1)]
#[driver(drive: cam.phi = 0.2 + w*t + 0.15*sin(t))]
#[guess(follower.y = 0.32)]
pub struct CamEllipseImplicit {
    /// Semi-axis along x of the cam
    #[param(0.23, unit = "m")]
    pub a: f64,
    /// Semi-axis along y
    #[param(0.17, unit = "m")]
    pub b: f64,
    /// Offset of the guide, which the file carries without using it
    #[param(0.03, unit = "m")]
    pub e: f64,
    /// Speed of the drive
    #[param(2.05, unit = "rad/s")]
    pub w: f64,
}
