//! The lecture's four-bar, described joint by joint (the local method, solution 1).
//!
//! ```text
//!            B
//!          /   \          C  ground – crank        (0, 0)
//!        /      \ rocker  A  crank – coupler
//!       A        \        B  coupler – rocker
//!      / coupler  D       D  rocker – ground       (d1, d2)
//!     C
//! ```
//!
//! Every body carries a frame in the middle of its link, x axis along it; a point of a body is written in that frame.
//! Four revolute joints are eight equations, the driver is the ninth, for nine coordinates:
//!
//! ```text
//! cargo run --example four_bar
//! cargo run --release --example four_bar -- solve --at 0.5
//! cargo run --release --example four_bar -- sweep --from 0 --to 1 --steps 100 --format csv --out four_bar.csv
//! cargo run --release --example four_bar -- solve --set l1=0.12,l2=0.45 --guess rocker.phi=1.5
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// The lecture's four-bar, described joint by joint.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
#[revolute(D: rocker @ (l3/2, 0), ground @ (d1, d2))]
#[driver(drive: crank.phi = phi0 + omega * t)]
#[point(tip = coupler @ (0, 0.1))]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourBar {
    /// Crank length
    #[param(0.1, unit = "m")]
    pub l1: f64,
    /// Coupler length
    #[param(0.4, unit = "m")]
    pub l2: f64,
    /// Rocker length
    #[param(0.3, unit = "m")]
    pub l3: f64,
    /// Ground pin D, x
    #[param(0.4, unit = "m")]
    pub d1: f64,
    /// Ground pin D, y
    #[param(0.1, unit = "m")]
    pub d2: f64,
    /// Crank angle at t = 0
    #[param(pi/4, unit = "rad")]
    pub phi0: f64,
    /// Crank speed
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<FourBar>()
}
