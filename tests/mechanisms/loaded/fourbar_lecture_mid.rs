//! Source: `tests/data/fourbar_lecture_mid.json`, with the loads of `tests/data/forces/fourbar_lecture_mid.json`.

use kin_runtime::mechanism;

/// The lecture's four-bar, solution 1: frames in the middle of the links, x axes along them.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[point(B = coupler @ (l2/2, 0))]
#[revolute(O: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: B, rocker @ (-l3/2, 0))]
#[revolute(D: ground @ (d1, d2), rocker @ (l3/2, 0))]
#[driver(drive: crank.phi = pi / 4 + w * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
#[gravity(0, -9.81)]
#[mass(crank @ (-0.031, 0.069), mass = 2.65, inertia = 0.00477)]
#[mass(coupler @ (0.071, 0.044), mass = 2.69, inertia = 0.0122)]
#[mass(rocker @ (-0.012, -0.019), mass = 0.616, inertia = 0.000883)]
#[force(pull: crank @ (0.057, -0.074), (-12.6, -14.6))]
#[force(thrust: rocker @ (-0.052, -0.044), (4.74, 10.4), frame = rocker)]
#[torque(load: coupler = 1.34)]
#[spring(spring: rocker @ (0.07, -0.037), coupler @ (0.019, -0.033), stiffness = 80.3, free_length = 0.176, damping = 10.4)]
#[torsion_spring(torsion: crank, rocker, stiffness = 1.34, free_angle = 0.491, damping = 0.16)]
pub struct FourbarLectureMid {
    /// Crank length
    #[param(0.1)]
    pub l1: f64,
    /// Coupler length
    #[param(0.4)]
    pub l2: f64,
    /// Rocker length
    #[param(0.3)]
    pub l3: f64,
    /// Ground pin D, x
    #[param(0.4)]
    pub d1: f64,
    /// Ground pin D, y
    #[param(0.1)]
    pub d2: f64,
    /// Speed of the drive
    #[param(2.3)]
    pub w: f64,
}
