//! Peaucellier's cell: how straight is the line that it draws?
//!
//! Straight to rounding. O, P and Q are always on one line and OP · OQ = a² − b²: Q is the inverse of P in a circle around
//! O. The crank leads P on a circle through O, whose inverse is a straight line, (a² − b²)/(2c) from O and upright on OC.
//! Peaucellier found it in 1864; it was the first linkage known to turn a circle into a straight line.
//!
//! ```text
//!               A
//!           ╱   │ ╲         OA = OB = a      rhombus APBQ with sides b
//!        ╱     ╱   ╲        OC = CP = c
//!     O──C────P     Q
//!        ╲     ╲   ╱
//!           ╲   │ ╱
//!               B
//! ```
//!
//! The dimensions are this example's own: the line is straight for any a > b and c; they say how long it is. P cannot come
//! nearer to O than a − b, which limits the swing of the crank.
//!
//! ```text
//! cargo run --release --example peaucellier -- sweep --from 0 --to 6.283 --steps 24 --points --format csv
//! cargo run --release --example peaucellier --features plot -- plot Q.x --to 6.283 --out line.svg
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// Peaucellier's inversor: Q draws a straight line.
#[mechanism]
#[bodies(crank, long_a, long_b, side_ap, side_bp, side_aq, side_bq)]
#[revolute(O_a: ground @ (0, 0), long_a @ (0, 0))]
#[revolute(O_b: ground @ (0, 0), long_b @ (0, 0))]
#[revolute(C: ground @ (c, 0), crank @ (0, 0))]
#[revolute(A_p: long_a @ (a, 0), side_ap @ (0, 0))]
#[revolute(B_p: long_b @ (a, 0), side_bp @ (0, 0))]
#[revolute(A_q: long_a @ (a, 0), side_aq @ (0, 0))]
#[revolute(B_q: long_b @ (a, 0), side_bq @ (0, 0))]
#[revolute(P_a: crank @ (c, 0), side_ap @ (b, 0))]
#[revolute(P_b: crank @ (c, 0), side_bp @ (b, 0))]
#[revolute(Q_ab: side_aq @ (b, 0), side_bq @ (b, 0))]
#[point(P = crank @ (c, 0))]
#[point(Q = side_aq @ (b, 0))]
#[driver(drive: crank.phi = swing * sin(omega * t))]
#[guess(long_a.phi = 0.4, long_b.phi = -0.4, side_ap.phi = -2.3, side_bp.phi = 2.3, side_aq.phi = -0.8, side_bq.phi = 0.8)]
pub struct Peaucellier {
    /// Long arms OA and OB
    #[param(0.5, unit = "m")]
    pub a: f64,
    /// Sides of the rhombus
    #[param(0.2, unit = "m")]
    pub b: f64,
    /// Crank CP, and the distance OC
    #[param(0.2, unit = "m")]
    pub c: f64,
    /// Largest angle of the crank
    #[param(1.3, unit = "rad")]
    pub swing: f64,
    /// Pace of the swing
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Peaucellier>()
}
