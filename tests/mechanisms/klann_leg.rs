//! Source: `tests/data/klann_leg.json`.

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
pub struct KlannLeg {
    /// Speed of the drive
    #[param(-1.6, unit = "rad/s")]
    pub w: f64,
}
