//! Source: `tests/data/peaucellier.json`, with the loads of `tests/data/forces/peaucellier.json`.

use kin_runtime::mechanism;

/// Peaucellier–Lipkin inversor: `Q` draws an exact straight line, perpendicular to OC at (a² − b²)/(2c) from O.
#[mechanism]
#[bodies(crank, OA, OB, AP, PB, BQ, QA)]
#[point(Q = BQ @ (b/2, 0))]
#[revolute(C: ground @ (0.96 * c, 0.28 * c), crank @ (-c/2, 0))]
#[revolute(O_OA: ground @ (0, 0), OA @ (0, 0))]
#[revolute(O_OB: ground @ (0, 0), OB @ (-a/2, 0))]
#[revolute(A_AP: OA @ (a, 0), AP @ (-b/2, 0))]
#[revolute(A_QA: OA @ (a, 0), QA @ (b/2, 0))]
#[revolute(B_PB: OB @ (a/2, 0), PB @ (b/2, 0))]
#[revolute(B_BQ: OB @ (a/2, 0), BQ @ (-b/2, 0))]
#[revolute(P_AP: crank @ (c/2, 0), AP @ (b/2, 0))]
#[revolute(P_PB: crank @ (c/2, 0), PB @ (-b/2, 0))]
#[revolute(Q: Q, QA @ (-b/2, 0))]
#[driver(drive: crank.phi = 0.1 + 0.9 * sin(1.3 * t) + 0.05 * t)]
#[guess(OA.phi = 0.6, OB.phi = -0.2, AP.phi = -1.7, PB.phi = -1.1, BQ.phi = 1.5, QA.phi = 2.0)]
#[gravity(0, -9.81)]
#[mass(crank @ (0.1, -0.096), mass = 1.79, inertia = 0.0161)]
#[mass(OA @ (0.035, -0.12), mass = 1.42, inertia = 0.0509)]
#[mass(OB @ (-0.04, 0.12), mass = 2.62, inertia = 0.0501)]
#[mass(AP @ (0.046, -0.14), mass = 1.9, inertia = 0.028)]
#[mass(PB @ (-0.14, 0.16), mass = 2.54, inertia = 0.0343)]
#[mass(BQ @ (0.091, -0.044), mass = 2.75, inertia = 0.0239)]
#[mass(QA @ (0.19, 0.054), mass = 2.05, inertia = 0.0514)]
#[force(pull: QA @ (0.072, -0.15), (-12, -13.3))]
#[force(thrust: OB @ (0.09, -0.12), (6.39, 6), frame = OB)]
#[torque(load: PB = -4.39)]
#[spring(spring: ground @ (-0.36, 0.28), OA @ (0.17, -0.16), stiffness = 56, free_length = 0.554, damping = 5.21)]
#[torsion_spring(torsion: crank, QA, stiffness = 4.48, free_angle = 0.571, damping = 0.193)]
pub struct Peaucellier {
    /// Long arms OA and OB
    #[param(0.53)]
    pub a: f64,
    /// Sides of the rhombus
    #[param(0.23)]
    pub b: f64,
    /// Crank CP, and the distance OC
    #[param(0.21)]
    pub c: f64,
}
