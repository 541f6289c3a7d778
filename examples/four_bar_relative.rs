//! The lecture's four-bar, solution 3: every origin is given in the frame of the body before.
//!
//! `body(coupler, origin = crank @ (l1, 0))` puts the coupler's origin on the crank's end, which takes the place of a
//! revolute joint. Only the three angles vary, and closing the loop at D takes two equations: the global method,
//! without writing a single sine.
//!
//! ```text
//! cargo run --release --example four_bar_relative
//! cargo run --release --example four_bar_relative -- solve --at 0.5 --format json
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// The lecture's four-bar with carried origins.
#[mechanism]
#[body(crank, origin = ground @ (0, 0))]
#[body(coupler, origin = crank @ (l1, 0))]
#[body(rocker, origin = coupler @ (l2, 0))]
#[revolute(D: rocker @ (l3, 0), ground @ (d1, d2))]
#[driver(drive: crank.phi = phi0 + omega * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourBarRelative {
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
    kin_runtime::cli::main::<FourBarRelative>()
}
