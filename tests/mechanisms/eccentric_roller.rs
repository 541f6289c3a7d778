//! One cam with a roller follower, written in three ways, which `tests/tests/curves/cams.rs` compares with one another.

use kin_runtime::mechanism;

/// Eccentric circular cam, translating roller follower with an offset guide: the pitch curve in polar form.
#[mechanism]
#[bodies(cam, follower)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(guide: ground @ (0.005, 0), follower @ (0, 0), axis = (0, 1))]
#[define(pitch = r + roller)]
#[on_curve(contact: cam @ (0, 0), follower @ (0, 0), polar(theta) = e*cos(theta) + sqrt(pitch*pitch - (e*sin(theta)).powi(2)))]
#[driver(drive: cam.phi = 0.3 + 2*t + 0.2*t*t)]
#[guess(follower.y = pitch)]
pub struct EccentricRollerPolar {
    /// Radius of the cam
    #[param(0.04, unit = "m")]
    pub r: f64,
    /// Distance of its centre from the shaft
    #[param(0.012, unit = "m")]
    pub e: f64,
    /// Radius of the roller
    #[param(0.01, unit = "m")]
    pub roller: f64,
}

/// The same with the pitch curve in implicit form, around the shaft.
#[mechanism]
#[bodies(cam, follower)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(guide: ground @ (0.005, 0), follower @ (0, 0), axis = (0, 1))]
#[on_curve(contact: cam @ (0, 0), follower @ (0, 0), implicit(X, Y) = (X - e).powi(2) + Y*Y - (r + roller).powi(2))]
#[driver(drive: cam.phi = 0.3 + 2*t + 0.2*t*t)]
#[guess(follower.y = r + roller)]
pub struct EccentricRollerImplicit {
    /// Radius of the cam
    #[param(0.04, unit = "m")]
    pub r: f64,
    /// Distance of its centre from the shaft
    #[param(0.012, unit = "m")]
    pub e: f64,
    /// Radius of the roller
    #[param(0.01, unit = "m")]
    pub roller: f64,
}

/// The same with the cam's own outline, counter-clockwise, and the roller on its outside: R is negative there.
#[mechanism]
#[bodies(cam, follower)]
#[coordinates(u)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(guide: ground @ (0.005, 0), follower @ (0, 0), axis = (0, 1))]
#[on_curve(contact: cam @ (0, 0), follower @ (0, 0), parametric(u) = (e + r*cos(u), r*sin(u)), roller = -roller)]
#[driver(drive: cam.phi = 0.3 + 2*t + 0.2*t*t)]
#[guess(follower.y = r + roller, u = 1.3)]
pub struct EccentricRollerParametric {
    /// Radius of the cam
    #[param(0.04, unit = "m")]
    pub r: f64,
    /// Distance of its centre from the shaft
    #[param(0.012, unit = "m")]
    pub e: f64,
    /// Radius of the roller
    #[param(0.01, unit = "m")]
    pub roller: f64,
}
