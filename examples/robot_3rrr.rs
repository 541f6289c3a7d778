//! A 3-RRR robot: how must its three motors turn so that its platform draws a circle without turning itself?
//!
//! The inverse problem: the pose of the platform is driven, the angles of the cranks follow, one dyad per leg in closed
//! form. For the forward problem prescribe the cranks: `#[driver(d[i in 0..3]: crank[i].phi = …)]` in place of the three.
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
//! The dimensions are this example's own: a symmetric robot whose cranks are as long as its rods, as in C. Gosselin and
//! J. Angeles, "The optimum kinematic design of a planar three-degree-of-freedom parallel manipulator" (1988).
//!
//! ```text
//! cargo run --release --example robot_3rrr --features plot -- plot 'crank[0].phi' 'crank[1].phi' 'crank[2].phi' --out motors.svg
//! cargo run --release --example robot_3rrr -- solve --at 0.5 --set angle=0.3
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A planar robot whose platform is held by three legs.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (base*cos(2*pi*i/3 - 5*pi/6), base*sin(2*pi*i/3 - 5*pi/6)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (l, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (l, 0), platform @ (size*cos(2*pi*i/3 - 5*pi/6), size*sin(2*pi*i/3 - 5*pi/6)))]
#[point(tool = platform @ (0, 0))]
#[driver(x: platform.x = radius * cos(2*pi*t))]
#[driver(y: platform.y = radius * sin(2*pi*t))]
#[driver(turn: platform.phi = angle)]
#[guess(crank[0].phi = 1.2, rod[0].phi = -0.2, crank[1].phi = 3.3, rod[1].phi = 1.9, crank[2].phi = -0.9, rod[2].phi = -2.3)]
pub struct Robot3rrr {
    /// From the centre to the motors
    #[param(0.5, unit = "m")]
    pub base: f64,
    /// From the tool to the corners of the platform
    #[param(0.12, unit = "m")]
    pub size: f64,
    /// Cranks and rods
    #[param(0.3, unit = "m")]
    pub l: f64,
    /// Radius of the circle
    #[param(0.1, unit = "m")]
    pub radius: f64,
    /// Angle of the platform
    #[param(0.0, unit = "rad")]
    pub angle: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Robot3rrr>()
}
