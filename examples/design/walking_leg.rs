//! A walking leg with the longest flat step: how much longer can Klann's leg step without lifting its foot from the ground?
//!
//! The dimensions of the leg (example `klann`) may change by a quarter. Wanted is a step that is half as long again, as
//! flat as can be during the half turn in which the foot is on the ground.
//!
//! ```text
//! cargo run --release --example walking_leg --features design
//! cargo run --release --example walking_leg --features design -- animate --out leg.html
//! ```

use kin_runtime::design::{Design, DesignError, Designed, Number, Search};
use kin_runtime::{Kinematics, Scalar};
use std::f64::consts::PI;
use std::process::ExitCode;

#[path = "../klann.rs"]
#[allow(dead_code, reason = "its own main")]
mod klann;

pub use klann::Klann;

/// Instants of the half turn on the ground.
const INSTANTS: usize = 17;
/// Half a turn takes this long.
const HALF: f64 = PI / 2.0;
/// How much longer the step is to be.
const LONGER: f64 = 1.5;

/// The half turn in which the foot of a leg goes most nearly level: when it begins, how much the foot rises meanwhile, and
/// how far it goes.
///
/// # Panics
/// Where the leg does not turn.
pub fn stance(leg: &Klann) -> [f64; 3] {
    const STEPS: usize = 360;
    let times: Vec<f64> = (0..=3 * STEPS / 2).map(|k| 2.0 * HALF * k as f64 / STEPS as f64).collect();
    let motion = leg.kinematic_analysis(&times).expect("it turns");
    let range = |first: usize, axis: usize| {
        let feet = motion.states[first..=first + STEPS / 2].iter().map(|state| state[Klann::foot].r[axis]);
        let (low, high) = feet.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        high - low
    };
    let level = (0..STEPS).min_by(|a, b| range(*a, 1).total_cmp(&range(*b, 1))).unwrap_or(0);
    [times[level], range(level, 1), range(level, 0)]
}

/// The leg with the longer step.
///
/// # Errors
/// As the search.
pub fn found() -> Result<Designed<Klann>, DesignError> {
    let leg = Klann::default();
    let [begin, _, step] = stance(&leg);
    let times: Vec<f64> = (0..INSTANTS).map(|k| begin + HALF * k as f64 / (INSTANTS - 1) as f64).collect();
    let ground = move |at: &[Vec<Number>]| {
        let number = Number::from_f64;
        let mean = at.iter().fold(number(0.0), |sum, foot| sum + foot[1]) / number(at.len() as f64);
        let length = (at[at.len() - 1][0] - at[0][0]).abs() - number(LONGER * step);
        at.iter().map(|foot| foot[1] - mean).chain([length]).collect()
    };
    let about = |value: f64| (0.75 * value).min(1.25 * value)..=(0.75 * value).max(1.25 * value);
    let free = [
        ("bx", leg.bx),
        ("by", leg.by),
        ("dx", leg.dx),
        ("dy", leg.dy),
        ("bh", leg.bh),
        ("de", leg.de),
        ("ch", leg.ch),
        ("hf", leg.hf),
        ("cf", leg.cf),
        ("ef", leg.ef),
        ("fg", leg.fg),
        ("eg", leg.eg),
    ];
    let begin = Design::new(&leg).residuals(&["foot.x", "foot.y"], &times, ground)?;
    let design = free.iter().try_fold(begin, |design, (name, value)| design.free(name, about(*value)))?;
    design.turns(2.0 * HALF, 37, 0.02)?.search(&Search { starts: 8, ..Search::default() })
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<Klann>();
    }
    match found() {
        Ok(found) => {
            println!("{found}\n");
            for (name, leg) in [("Klann's leg", &Klann::default()), ("the leg that was found", &found.mechanism)] {
                let [_, height, length] = stance(leg);
                println!("{name}: a step of {length:.1} mm, in which the foot rises by {height:.2} mm");
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
