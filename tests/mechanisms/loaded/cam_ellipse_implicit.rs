//! Source: `tests/data/cam_ellipse_implicit.json`, with the loads of `tests/data/forces/cam_ellipse_implicit.json`.

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
#[gravity(0, -9.81)]
#[mass(cam @ (0.035, -0.029), mass = 1.29, inertia = 0.000889)]
#[mass(follower @ (0.01, -0.024), mass = 2.65, inertia = 0.00315)]
#[force(pull: cam @ (0.038, 0.014), (-13.6, -14.5))]
#[force(thrust: follower @ (-0.035, -0.0094), (14.5, 4.06), frame = follower)]
#[torque(load: cam = 0.556)]
#[spring(spring: follower @ (-0.026, -0.0076), cam @ (0.01, -0.024), stiffness = 126, free_length = 0.174, damping = 23.8)]
#[torsion_spring(torsion: ground, cam, stiffness = 0.842, free_angle = -0.204, damping = 0.0659)]
pub struct CamEllipseImplicit {
    /// Semi-axis along x of the cam
    #[param(0.23)]
    pub a: f64,
    /// Semi-axis along y
    #[param(0.17)]
    pub b: f64,
    /// Offset of the guide, which the file carries without using it
    #[param(0.03)]
    pub e: f64,
    /// Speed of the drive
    #[param(2.05)]
    pub w: f64,
}
