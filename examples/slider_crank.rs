//! A slider-crank: a crank turns, a piston slides.
//!
//! A `translational` joint keeps a point on a line and an angle constant. Its axis is a direction in the frame of its
//! first body, here the ground; kin normalises it. The joint reports the piston's stroke along that axis, with its
//! speed, and `define` adds a quantity of one's own: here the angle between rod and axis.
//!
//! ```text
//! cargo run --release --example slider_crank
//! cargo run --release --example slider_crank -- sweep --from 0 --to 0.1 --steps 20 --set rpm=900
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A slider-crank whose cylinder stands `offset` above the crankshaft.
#[mechanism]
#[bodies(crank, rod, piston)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), piston @ (0, 0))]
#[translational(cylinder: ground @ (0, offset), piston @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 0.5 + 2 * pi * rpm / 60 * t)]
#[define(lean = rod.phi - piston.phi)]
#[guess(rod.phi = -0.2)]
pub struct SliderCrank {
    /// Crank radius
    #[param(0.05, unit = "m")]
    pub r: f64,
    /// Rod length
    #[param(0.18, unit = "m")]
    pub l: f64,
    /// Height of the cylinder's axis above the crankshaft
    #[param(0.01, unit = "m")]
    pub offset: f64,
    /// Crank speed
    #[param(600, unit = "rpm")]
    pub rpm: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<SliderCrank>()
}
