//! Source: `tests/data/cam_oscillating_follower.json`, with the loads of `tests/data/forces/cam_oscillating_follower.json`.

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
#[gravity(0, -9.81)]
#[mass(cam @ (0.073, -0.014), mass = 0.483, inertia = 0.00144)]
#[mass(follower @ (-0.022, 0.026), mass = 0.9, inertia = 0.00413)]
#[force(pull: follower @ (0.052, -0.054), (4.1, 14.2))]
#[force(thrust: cam @ (-0.013, -0.039), (4.36, 12), frame = cam)]
#[torque(load: follower = 1.59)]
#[spring(spring: ground @ (0.18, 0.15), follower @ (0.021, 0.046), stiffness = 68.9, free_length = 0.12, damping = 4.89)]
#[torsion_spring(torsion: ground, follower, stiffness = 1.76, free_angle = 0.24, damping = 0.0814)]
pub struct CamOscillatingFollower {
    /// Mean radius of the pitch curve
    #[param(0.2)]
    pub a: f64,
    /// Its eccentricity
    #[param(0.03)]
    pub b: f64,
    /// Its second harmonic
    #[param(0.012)]
    pub c: f64,
    /// Speed of the drive
    #[param(2.4)]
    pub w: f64,
}
