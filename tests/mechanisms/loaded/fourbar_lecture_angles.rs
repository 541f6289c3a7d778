//! Source: `tests/data/fourbar_lecture_angles.json`, with the loads of `tests/data/forces/fourbar_lecture_angles.json`.

use kin_runtime::mechanism;

/// The lecture's four-bar by the global method: three link angles and two closure equations.
/// Link 3 points from the coupler to the ground.
#[mechanism]
#[coordinates(phi1, phi2, phi3)]
#[body(crank, x = 0, y = 0, phi = phi1)]
#[body(coupler, x = l1*cos(phi1), y = l1*sin(phi1), phi = phi2)]
#[body(rocker, x = l1*cos(phi1)+l2*cos(phi2), y = l1*sin(phi1)+l2*sin(phi2), phi = phi3)]
#[constraint(loop_x: l1*cos(phi1) + l2*cos(phi2) + l3*cos(phi3) = d1)]
#[constraint(loop_y: l1*sin(phi1) + l2*sin(phi2) + l3*sin(phi3) = d2)]
#[driver(drive: phi1 = pi/4 + w * t)]
#[guess(phi2 = 0.9, phi3 = 5.0)]
#[gravity(0, -9.81)]
#[mass(crank @ (0.019, 0.069), mass = 2.65, inertia = 0.00477)]
#[mass(coupler @ (0.271, 0.044), mass = 2.69, inertia = 0.0122)]
#[mass(rocker @ (0.138, -0.019), mass = 0.616, inertia = 0.000883)]
#[force(pull: crank @ (0.107, -0.074), (-12.6, -14.6))]
#[force(thrust: rocker @ (0.098, -0.044), (4.74, 10.4), frame = rocker)]
#[torque(load: coupler = 1.34)]
#[spring(spring: rocker @ (0.22, -0.037), coupler @ (0.219, -0.033), stiffness = 80.3, free_length = 0.176, damping = 10.4)]
#[torsion_spring(torsion: crank, rocker, stiffness = 1.34, free_angle = 0.491, damping = 0.16)]
pub struct FourbarLectureAngles {
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
