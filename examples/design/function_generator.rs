//! A function generator: which four-bar turns its rocker by the logarithm of what its crank is turned by?
//!
//! The crank shows x from 1 to 2 on a scale of 60°, and the rocker log₁₀ x on a scale of 90°: how exactly can three lengths
//! and the two zeros of the scales do that? A textbook makes it exact at three points (Freudenstein 1955), which leaves
//! errors of 2.4° between them.
//!
//! ```text
//! cargo run --release --example function_generator --features design
//! cargo run --release --example function_generator --features design -- solve
//! ```

use kin_runtime::design::{Design, DesignError, Designed, Search};
use kin_runtime::mechanism;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};
use std::process::ExitCode;

/// A four-bar with scales at crank and rocker; its ground has the length 1.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[define(scale = rocker.phi - zero)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (l, 0), rocker @ (c, 0))]
#[revolute(D: ground @ (1, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = begin + t)]
#[guess(coupler.phi = 0.5, rocker.phi = 1)]
#[derive(Debug)]
pub struct Generator {
    /// Crank
    #[param(0.65)]
    pub r: f64,
    /// Coupler
    #[param(1.17)]
    pub l: f64,
    /// Rocker
    #[param(0.53)]
    pub c: f64,
    /// Where the scale of the crank begins
    #[param(pi/4)]
    pub begin: f64,
    /// Where the scale of the rocker begins
    #[param(0.0)]
    pub zero: f64,
}

/// (t, ψ): by how much crank and rocker are turned for 61 values of x.
fn logarithm() -> Vec<(f64, f64)> {
    let pair = |x: f64| (FRAC_PI_3 * (x - 1.0), FRAC_PI_2 * x.log10() / 2_f64.log10());
    (0..=60).map(|k| pair(1.0 + f64::from(k) / 60.0)).collect()
}

/// The four-bar with the least sum of squared errors.
///
/// # Errors
/// As the search.
pub fn found() -> Result<Designed<Generator>, DesignError> {
    let begin = Design::new(&Generator::default());
    let design = ["r", "l", "c"].iter().try_fold(begin, |design, name| design.free(name, 0.1..=10.0))?;
    let design = design.free("begin", -PI..=PI)?.free("zero", -PI..=PI)?.function("scale", &logarithm())?;
    let mode = <Generator as kin_runtime::Mechanism>::model().plan.modes[0].name;
    design.mode(mode, None)?.search(&Search { starts: 60, ..Search::default() })
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<Generator>();
    }
    match found() {
        Ok(found) => {
            let mean = (found.error / 61.0).sqrt().to_degrees();
            println!("{found}\n\nThe rocker misses the logarithm by {mean:.4}° as root mean square.");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
