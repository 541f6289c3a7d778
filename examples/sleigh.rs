//! A sleigh on one blade (after Chaplygin): its heading and the speed along its blade are driven. Which way does it go?
//!
//! The blade does not slip sideways, so that the point above it moves along the blade only; every other point of the
//! sleigh moves as it must. Heading and speed do not determine the place, only its rate.
//!
//! ```text
//!           ┌──────────────────┐
//!           │   o seat         │          blade:  −ẋ_P sin ψ + ẏ_P cos ψ = 0
//!           │          P ══════╪═▶        push:    ẋ_P cos ψ + ẏ_P sin ψ − v(t) = 0
//!           └──────────────────┘          ψ = sleigh.phi + set
//! ```
//!
//! ```text
//! cargo run --release --example sleigh
//! cargo run --release --example sleigh -- sweep --from 0 --to 12 --steps 120 --format csv --points
//! cargo run --release --example sleigh -- info
//! ```

use kin_runtime::{Kinematics, mechanism};
use std::process::ExitCode;

/// A sleigh that meanders.
#[mechanism(cross_check)]
#[bodies(sleigh)]
#[point(P = sleigh @ (0.4, 0))]
#[point(seat = sleigh @ (-0.3, 0.1))]
#[knife_edge(blade: P, angle = set)]
#[speed(push: P, angle = set, value = v * (1 - exp(-t)))]
#[driver(heading: sleigh.phi = swing * sin(omega * t) - set)]
#[guess(sleigh.x = -0.4, sleigh.y = 0)]
pub struct Sleigh {
    /// Angle of the blade in the sleigh
    #[param(0.1, unit = "rad")]
    pub set: f64,
    /// Speed along the blade, when it is reached
    #[param(2.0, unit = "m/s")]
    pub v: f64,
    /// Largest heading
    #[param(0.8, unit = "rad")]
    pub swing: f64,
    /// Frequency of the meander
    #[param(1.5, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<Sleigh>();
    }
    let sleigh = Sleigh::default();
    let times: Vec<f64> = (0..=12).map(f64::from).collect();
    let path = match sleigh.kinematic_analysis(&times) {
        Ok(path) => path,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    println!("     t   blade.x   blade.y   heading   seat slips by");
    for state in &path {
        let Ok(motion) = sleigh.solver().motion(state) else { return ExitCode::FAILURE };
        let (blade, seat) = (motion[Sleigh::P], motion[Sleigh::seat]);
        let heading = state.q[2] + sleigh.set;
        let slip = seat.v[1] * heading.cos() - seat.v[0] * heading.sin();
        println!("{:6.1} {:9.4} {:9.4} {heading:9.4} {slip:10.4} m/s", state.t, blade.r[0], blade.r[1]);
    }
    ExitCode::SUCCESS
}
