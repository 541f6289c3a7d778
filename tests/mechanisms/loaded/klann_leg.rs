//! Source: `tests/data/klann_leg.json`, with the loads of `tests/data/forces/klann_leg.json`.

use kin_runtime::mechanism;

/// Klann's walking leg: a Stephenson six-bar with a ternary connecting rod and a ternary leg, foot `F`.
#[mechanism]
#[bodies(crank, rod, rocker_low, rocker_up, leg)]
#[point(F = leg @ (1.35, -0.5))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(M: crank @ (0.2, 0), rod @ (0.57, 0))]
#[revolute(C: rod @ (0, 0), rocker_low @ (0.34, 0))]
#[revolute(B: ground @ (-0.59, -0.176), rocker_low @ (0, 0))]
#[revolute(D: rod @ (-0.52, 0.06), leg @ (0.66, 0.02))]
#[revolute(E: leg @ (0, 0), rocker_up @ (0.31, 0))]
#[revolute(A: ground @ (-0.233, 0.616), rocker_up @ (-0.31, 0))]
#[driver(drive: crank.phi = 0.7 + w * t)]
#[guess(rocker_low.phi = 1.0, rocker_up.phi = -1.7, leg.phi = 2.9)]
#[gravity(0, -9.81)]
#[mass(crank @ (0.21, -0.18), mass = 0.421, inertia = 0.0576)]
#[mass(rod @ (-0.25, 0.15), mass = 1.78, inertia = 0.181)]
#[mass(rocker_low @ (-0.26, -0.12), mass = 0.616, inertia = 0.0693)]
#[mass(rocker_up @ (0.23, -0.39), mass = 1.79, inertia = 0.0823)]
#[mass(leg @ (-0.07, 0.089), mass = 1.92, inertia = 0.099)]
#[force(pull: rod @ (-0.069, 0.3), (13.7, 14.2))]
#[force(thrust: rocker_low @ (0.31, -0.22), (-4.8, 9.72), frame = rocker_low)]
#[torque(load: crank = 9.64)]
#[spring(spring: rocker_low @ (0.18, 0.32), rocker_up @ (0.28, 0.3), stiffness = 8.23, free_length = 0.444, damping = 1.05)]
#[torsion_spring(torsion: rocker_low, crank, stiffness = 5.9, free_angle = -0.802, damping = 0.752)]
pub struct KlannLeg {
    /// Speed of the drive
    #[param(-1.6)]
    pub w: f64,
}
