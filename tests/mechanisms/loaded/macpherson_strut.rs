//! Source: `tests/data/macpherson_strut.json`, with the loads of `tests/data/forces/macpherson_strut.json`.

use kin_runtime::mechanism;

/// MacPherson strut: the wheel carrier slides in a strut that turns; the height of the wheel centre `W` is driven.
/// The sliding joint stands between two moving bodies, and its axis is not given as a unit vector.
#[mechanism]
#[bodies(arm, knuckle, strut)]
#[point(W = knuckle @ (0.1, 0.05))]
#[point(K = knuckle @ (0, 0))]
#[revolute(G: ground @ (0, 0), arm @ (-0.17, 0))]
#[revolute(K: arm @ (0.17, 0), K)]
#[translational(slide: knuckle @ (-0.02, 0.1), strut @ (0, 0.02), axis = (-0.2, 1), angle = 0.07)]
#[revolute(T: ground @ (0.21, 0.62), strut @ (0, 0.02))]
#[driver(drive: W.y = 0.05 + 0.06 * sin(w * t) + 0.01 * t)]
#[guess(strut.phi = 0.1)]
#[gravity(0, -9.81)]
#[mass(arm @ (-0.017, 0.012), mass = 2.76, inertia = 0.0112)]
#[mass(knuckle @ (0.031, 0.053), mass = 1.43, inertia = 0.00783)]
#[mass(strut @ (-0.063, 0.052), mass = 2.99, inertia = 0.00528)]
#[force(pull: arm @ (-0.038, 0.073), (10.5, 10))]
#[force(thrust: strut @ (0.066, 0.015), (13.1, -12.5), frame = strut)]
#[torque(load: arm = 1.86)]
#[spring(spring: ground @ (-0.12, 0.15), arm @ (-0.064, -0.021), stiffness = 79.8, free_length = 0.247, damping = 4.26)]
#[torsion_spring(torsion: strut, arm, stiffness = 1.21, free_angle = 0.287, damping = 0.175)]
pub struct MacphersonStrut {
    /// Speed of the drive
    #[param(2.1)]
    pub w: f64,
}
