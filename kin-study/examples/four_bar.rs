//! Studies of the lecture's four-bar: its program runs them, and asks for what they found.
//!
//! ```text
//! cargo run --release --example four_bar -- run examples/four_bar.toml --out target/four_bar
//! cargo run --release --example four_bar -- query "select * from study limit 5" --in target/four_bar
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
    kin_study::main::<FourBar>()
}
