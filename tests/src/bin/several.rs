//! A program that hosts several mechanisms: the first argument says which, the rest is that mechanism's command line.
//!
//! ```text
//! cargo run -p kin-tests --bin several -- fourbar solve --at 0.5
//! ```

use std::ffi::OsString;
use std::process::ExitCode;

use kin_runtime::cli::run_from;
use kin_runtime::function::FromFn;
use kin_runtime::mechanism;
use kin_tests::mechanisms::{
    CamTable, FiveBarLeg, FourbarEnds, FourbarLectureMid, InfeasibleFourbar, RedundantParallelogram,
    SingularSliderCrank, StrokeLimits, UnderdrivenFivebar,
};

/// A follower whose lift claims a second derivative that it does not have.
#[mechanism]
#[function(lift)]
#[coordinates(y)]
#[driver(rise: y = lift(t))]
struct WrongCam {
    lift: FromFn<fn(f64) -> [f64; 3]>,
}

impl Default for WrongCam {
    fn default() -> Self {
        Self { lift: FromFn(|x| [x.sin(), x.cos(), -1.01 * x.sin()]) }
    }
}

/// A condition that may be faster than any sweep.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = t)]
#[unilateral(teeth: sin(k * u) > 0.3)]
struct Teeth {
    #[param(1)]
    k: f64,
}

fn main() -> ExitCode {
    let mut args: Vec<OsString> = std::env::args_os().collect();
    let name = if args.len() > 1 { args.remove(1) } else { OsString::new() };
    match name.to_str() {
        Some("cam") => run_from::<CamTable>(args),
        Some("wrong_cam") => run_from::<WrongCam>(args),
        Some("fourbar") => run_from::<FourbarLectureMid>(args),
        Some("ends") => run_from::<FourbarEnds>(args),
        Some("leg") => run_from::<FiveBarLeg>(args),
        Some("infeasible") => run_from::<InfeasibleFourbar>(args),
        Some("limits") => run_from::<StrokeLimits>(args),
        Some("redundant") => run_from::<RedundantParallelogram>(args),
        Some("singular") => run_from::<SingularSliderCrank>(args),
        Some("teeth") => run_from::<Teeth>(args),
        Some("underdriven") => run_from::<UnderdrivenFivebar>(args),
        _ => {
            eprintln!(
                "error: the first argument is cam, wrong_cam, fourbar, ends, infeasible, leg, limits, redundant, singular, teeth or underdriven"
            );
            ExitCode::from(2)
        }
    }
}
