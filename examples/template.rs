//! A starting point: copy this file and change it.
//!
//! In a crate of its own it is `src/main.rs`, and `Cargo.toml` depends on kin-runtime alone; the guide's first
//! chapter has both, and what can be done with them. A test keeps the two the same.
//!
//! ```text
//! cargo run --release --example template
//! cargo run --release --example template -- animate --out motion.html
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A slider-crank: a crank turns, a rod pushes a slider along the x axis.
#[mechanism(cross_check)]
// What moves. Every body has a frame of its own; `ground` is there already.
#[bodies(crank, rod, slider)]
// How the bodies are connected: points are written `body @ (x, y)`, in the frame of that body.
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
// What moves it: one driver for each degree of freedom.
#[driver(drive: crank.phi = omega * t)]
// What is reported besides: points and formulas, with velocities and accelerations.
#[point(middle = rod @ (l/2, 0))]
#[define(reach = slider.x - r)]
// Where it is at first, roughly: the links can be assembled in two ways, and the nearer one is taken.
#[guess(crank.phi = 0.1, rod.phi = -0.1, slider.x = r + l)]
pub struct SliderCrank {
    // The numbers that may change, each with a default; units are checked and printed.
    /// Crank radius
    #[param(0.2, unit = "m")]
    pub r: f64,
    /// Rod length
    #[param(0.7, unit = "m")]
    pub l: f64,
    /// Speed of the crank
    #[param(3.0, unit = "rad/s")]
    pub omega: f64,
}

/// A complete command line.
fn main() -> ExitCode {
    kin_runtime::cli::main::<SliderCrank>()
}

/// Or in a program of your own, as in this test: `cargo test` runs it, and checks the closed forms.
#[test]
fn a_longer_crank() -> Result<(), kin_runtime::SolveError> {
    use kin_runtime::{Instant, Kinematics};

    let engine = SliderCrank { r: 0.25, ..SliderCrank::default() };
    let state = engine.state_at(&Instant::at(0.1))?;
    let (crank, slider) = (state[SliderCrank::crank], state[SliderCrank::slider]);
    println!("crank at {:.2} rad, slider at {:.4} m, {:.4} m/s", crank.phi, slider.x, slider.x_dot);
    assert!(slider.x < engine.r + engine.l && slider.x_dot < 0.0);
    Ok(())
}
