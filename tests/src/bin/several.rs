//! A program that hosts several mechanisms: the first argument says which, the rest is that mechanism's command line.
//!
//! ```text
//! cargo run -p kin-tests --bin several -- fourbar solve --at 0.5
//! ```

use std::ffi::OsString;
use std::process::ExitCode;

use kin_runtime::cli::run_from;
use kin_tests::mechanisms::{
    FourbarEnds, FourbarLectureMid, InfeasibleFourbar, RedundantParallelogram, SingularSliderCrank, StrokeLimits,
    UnderdrivenFivebar,
};

fn main() -> ExitCode {
    let mut args: Vec<OsString> = std::env::args_os().collect();
    let name = if args.len() > 1 { args.remove(1) } else { OsString::new() };
    match name.to_str() {
        Some("fourbar") => run_from::<FourbarLectureMid>(args),
        Some("ends") => run_from::<FourbarEnds>(args),
        Some("infeasible") => run_from::<InfeasibleFourbar>(args),
        Some("limits") => run_from::<StrokeLimits>(args),
        Some("redundant") => run_from::<RedundantParallelogram>(args),
        Some("singular") => run_from::<SingularSliderCrank>(args),
        Some("underdriven") => run_from::<UnderdrivenFivebar>(args),
        _ => {
            eprintln!(
                "error: the first argument is fourbar, ends, infeasible, limits, redundant, singular or underdriven"
            );
            ExitCode::from(2)
        }
    }
}
