//! The lecture's four-bar, solution 2: frames at the ends of the links.
//!
//! The crank turns about its own origin, which therefore never moves: `body(crank, x = 0, y = 0)` holds it, and two
//! coordinates and the joint C disappear. Seven coordinates remain; the crank's pose is reported all the same.
//!
//! ```text
//! cargo run --release --example four_bar_ends
//! cargo run --release --example four_bar_ends -- info
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// The lecture's four-bar with frames at the ends of the links.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[bodies(coupler, rocker)]
#[revolute(A: crank @ (l1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (l2, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (l3, 0), ground @ (d1, d2))]
#[driver(drive: crank.phi = phi0 + omega * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourBarEnds {
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
    kin_runtime::cli::main::<FourBarEnds>()
}
