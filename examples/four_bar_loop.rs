//! The lecture's four-bar by the global method: three angles, two equations for the closed loop.
//!
//! ```text
//! l1 cos φ1 + l2 cos φ2 + l3 cos φ3 = d1
//! l1 sin φ1 + l2 sin φ2 + l3 sin φ3 = d2
//! ```
//!
//! Few equations, but the writer has to see the loop; `four_bar` describes the same motion joint by joint. A
//! `constraint` is any equation, left minus right; a scalar coordinate is an angle, a length, whatever it stands for.
//!
//! ```text
//! cargo run --release --example four_bar_loop
//! cargo run --release --example four_bar_loop -- sweep --from 0 --to 6.28 --steps 12
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// The lecture's four-bar by the global method.
#[mechanism]
#[coordinates(phi1, phi2, phi3)]
#[constraint(close_x: l1*cos(phi1) + l2*cos(phi2) + l3*cos(phi3) = d1)]
#[constraint(close_y: l1*sin(phi1) + l2*sin(phi2) + l3*sin(phi3) = d2)]
#[driver(drive: phi1 = phi0 + omega * t)]
#[guess(phi2 = 0.9, phi3 = 5.0)]
pub struct FourBarLoop {
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
    kin_runtime::cli::main::<FourBarLoop>()
}
