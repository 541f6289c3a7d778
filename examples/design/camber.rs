//! A camber curve: where must the upper arm of a suspension be held so that the wheel leans as it should when it rises?
//!
//! The wheel is to lean inwards by 1.5° where it has risen by 80 mm, and outwards by 0.9° where it has fallen as far: more
//! on the way up, where a bend presses the car down. The length of the upper arm and its pin on the car are free.
//!
//! ```text
//!   U ────────o    ▐█▌         U is at (x, y): free, and so is the length of the arm
//!              ╲   ▐█▌         camber: positive where the top leans outwards
//!               ╲──▐█▌
//!               ╱  ▐█▌
//!   L ─────────o   ▐█▌
//! ```
//!
//! ```text
//! cargo run --release --example camber --features design
//! cargo run --release --example camber --features design -- sweep camber rise
//! ```

use kin_runtime::design::{Design, DesignError, Designed, Search};
use kin_runtime::{Kinematics, Measure, Mechanism, mechanism};
use std::f64::consts::FRAC_PI_2;
use std::process::ExitCode;

/// A double wishbone suspension of a right wheel, seen from behind; t is the phase of a bump.
#[mechanism]
#[bodies(lower, upper, upright)]
#[revolute(L: ground @ (0.30, 0.20), lower @ (0, 0))]
#[revolute(U: ground @ (x, y), upper @ (0, 0))]
#[revolute(ball_low: lower @ (0.3506, 0), upright @ (-0.10, -0.12))]
#[revolute(ball_up: upper @ (arm, 0), upright @ (-0.13, 0.15))]
#[point(centre = upright @ (0, 0))]
#[define(camber = -180/pi * upright.phi)]
#[define(rise = centre.y - 0.3)]
#[driver(bump: centre.y = 0.3 + 0.08 * sin(t))]
#[guess(lower.phi = 0, upper.phi = 0.1, upright.x = 0.75, upright.y = 0.3, upright.phi = 0)]
#[derive(Debug)]
pub struct Suspension {
    /// The pin of the upper arm on the car, to the side
    #[param(0.38, unit = "m")]
    pub x: f64,
    /// The pin of the upper arm on the car, above the road
    #[param(0.42, unit = "m")]
    pub y: f64,
    /// The upper arm
    #[param(0.2419, unit = "m")]
    pub arm: f64,
}

/// The camber that is wanted at a rise, in degrees: a parabola through 0, −1.5° and 0.9°.
fn wanted(rise: f64) -> f64 {
    -15.0 * rise - 46.875 * rise * rise
}

/// Phases of the bump from the lowest to the highest place of the wheel.
fn phases() -> Vec<f64> {
    (-8..=8).map(|k| FRAC_PI_2 * f64::from(k) / 8.5).collect()
}

/// The suspension whose camber is nearest to what is wanted.
///
/// # Errors
/// As the search.
pub fn found() -> Result<Designed<Suspension>, DesignError> {
    let curve: Vec<(f64, f64)> = phases().into_iter().map(|t| (t, wanted(0.08 * t.sin()))).collect();
    Design::new(&Suspension::default())
        .free("x", 0.30..=0.50)?
        .free("y", 0.36..=0.48)?
        .free("arm", 0.12..=0.32)?
        .function("camber", &curve)?
        .search(&Search { starts: 20, ..Search::default() })
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<Suspension>();
    }
    match found() {
        Ok(found) => {
            println!("{found}\n\n  rise in m   camber in °   wanted");
            let solver = found.mechanism.solver();
            let camber: Vec<Measure> = Measure::named(Suspension::model(), "camber").into_iter().collect();
            for state in solver.sweep(&phases()).expect("a design moves").states.iter().step_by(4) {
                let rise = state[Suspension::centre].r[1] - 0.3;
                let value = solver.measure(state, &camber).expect("a define has a value")[0];
                println!("  {rise:9.4}   {value:11.4}   {:6.3}", wanted(rise));
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
