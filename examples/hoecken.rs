//! Hoecken's linkage: over which part of its turn does a crank move a point nearly straight, and how straight is that?
//!
//! A four-bar whose coupler goes on beyond the rocker as far as before it draws a D. For every part β of the turn there are
//! best ratios; over half a turn the line is 4.181 crank lengths long and 0.096 % of that wide.
//!
//! ```text
//!                T
//!              ╱             OA = crank   AB = BT = CB = 2.8 crank   OC = 2.2 crank
//!            B
//!          ╱   ╲
//!        A       ╲
//!      O           C
//! ```
//!
//! Ratios: R. L. Norton, Design of Machinery, table "Link ratios for smallest attainable errors in straightness", the row
//! of β = 180°. That of β = 120°, `--set d=0.02625,l=0.03438`, is ten times as straight and three quarters as long.
//!
//! ```text
//! cargo run --release --example hoecken --features plot -- plot T --out curve.svg
//! cargo run --release --example hoecken -- sweep --from 1.5708 --to 4.7124 --steps 18 --points
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// Hoecken's approximate straight line.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (l, 0), rocker @ (0, 0))]
#[revolute(C: ground @ (d, 0), rocker @ (l, 0))]
#[point(T = coupler @ (2*l, 0))]
#[driver(drive: crank.phi = omega * t)]
#[guess(coupler.phi = 1.35, rocker.phi = -1.35)]
pub struct Hoecken {
    /// Crank
    #[param(0.01, unit = "m")]
    pub r: f64,
    /// From shaft to rocker pin
    #[param(0.022, unit = "m")]
    pub d: f64,
    /// Rocker, and either half of the coupler
    #[param(0.028, unit = "m")]
    pub l: f64,
    /// Crank speed
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Hoecken>()
}
