//! A 3-RRR robot whose motors are given: in how many ways can its platform stand, and how does each move on?
//!
//! The forward problem. The three loops of legs and platform close together and only by iteration; an elimination leaves
//! one polynomial of degree six, so that there are six closures at most. `modes` finds all of them and proves that there
//! are no others; the page of `animate` has each as a choice.
//!
//! ```text
//!                  M3
//!                  o              M1 M2 M3  motors, corners of an equilateral triangle
//!                   ╲             crank, rod, platform
//!                   ╱╲
//!          o───╲   ╱__╲ ──╱──o
//!          M1   ╲─╱    ╲─╱  M2
//! ```
//!
//! The dimensions are this example's own; with them all six closures are real.
//!
//! ```text
//! cargo run --release --example robot_closures -- modes
//! cargo run --release --example robot_closures -- animate --out closures.html
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A planar robot whose motors are given: one swings, two hold.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (base*cos(2*pi*i/3 - 5*pi/6), base*sin(2*pi*i/3 - 5*pi/6)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (l, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (m, 0), platform @ (size*cos(2*pi*i/3 - 5*pi/6), size*sin(2*pi*i/3 - 5*pi/6)))]
#[point(tool = platform @ (0, 0))]
#[driver(swing: crank[0].phi = 0.5 + 0.25 * sin(2*pi*t))]
#[driver(hold: crank[1].phi = 0.3)]
#[driver(keep: crank[2].phi = -0.7)]
pub struct RobotClosures {
    /// From the centre to the motors
    #[param(0.5, unit = "m")]
    pub base: f64,
    /// From the tool to the corners of the platform
    #[param(0.35, unit = "m")]
    pub size: f64,
    /// Cranks
    #[param(0.3, unit = "m")]
    pub l: f64,
    /// Rods
    #[param(0.4, unit = "m")]
    pub m: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<RobotClosures>()
}
