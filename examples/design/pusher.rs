//! A pusher for boxes: which four-bar moves a pad along a table and brings it back above the boxes?
//!
//! The guide's chapter on design begins with this mechanism, whose dimensions nobody has thought about yet, and ends with a
//! drawing of the one that does it.
//!
//! ```text
//!        pad                     the pad is to pass (0, 0), (40, 0), (80, 0), (120, 0) on the table,
//!     ╱  ╲                       and (80, 50), (30, 50) on its way back
//!    A────B      O, D  pins on the frame, anywhere below the table
//!    │     ╲
//!    O      D
//! ```
//!
//! ```text
//! cargo run --release --example pusher --features design
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A four-bar that pushes boxes along a table at y = 0.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (ox, oy), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (l, 0), rocker @ (c, 0))]
#[revolute(D: ground @ (dx, dy), rocker @ (0, 0))]
#[point(pad = coupler @ (u, v))]
#[driver(drive: crank.phi = omega * t)]
#[guess(coupler.phi = 0.3, rocker.phi = 1.5)]
#[derive(Debug)]
pub struct Pusher {
    /// Crank
    #[param(40, unit = "mm")]
    pub r: f64,
    /// Coupler
    #[param(110, unit = "mm")]
    pub l: f64,
    /// Rocker
    #[param(100, unit = "mm")]
    pub c: f64,
    /// Shaft, to the side
    #[param(0, unit = "mm")]
    pub ox: f64,
    /// Shaft, above the table
    #[param(-120, unit = "mm")]
    pub oy: f64,
    /// Rocker pin, to the side
    #[param(120, unit = "mm")]
    pub dx: f64,
    /// Rocker pin, above the table
    #[param(-120, unit = "mm")]
    pub dy: f64,
    /// The pad on the coupler, along it
    #[param(80, unit = "mm")]
    pub u: f64,
    /// The pad on the coupler, across it
    #[param(80, unit = "mm")]
    pub v: f64,
    /// Crank speed
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Pusher>()
}
