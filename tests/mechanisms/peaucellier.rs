//! Source: `tests/data/peaucellier.json`.

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
pub struct Peaucellier {
    /// Long arms OA and OB
    #[param(0.53, unit = "m")]
    pub a: f64,
    /// Sides of the rhombus
    #[param(0.23, unit = "m")]
    pub b: f64,
    /// Crank CP, and the distance OC
    #[param(0.21, unit = "m")]
    pub c: f64,
}
