//! A scissor lift with twenty stages, written in a dozen lines: how high does it stand, and how fast does it rise, when its
//! foot is pulled in? With its feet w apart the height is n √(l² − w²) for n stages of bars of length l, and it rises with
//! n w / √(l² − w²) times the speed of the foot: fast while it is flat. The dimensions are this example's own.
//!
//! ```text
//! cargo run --release --example scissor_lift
//! cargo run --release --example scissor_lift -- sweep --from 0 --to 6.28 --steps 60 --format csv
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A scissor lift with twenty stages whose sliding foot is pulled in.
#[mechanism]
#[bodies(left[20], right[20])]
#[revolute(middle[i in 0..20]: left[i] @ (0, 0), right[i] @ (0, 0))]
#[revolute(near[i in 0..19]: left[i] @ (l/2, 0), right[i + 1] @ (-l/2, 0))]
#[revolute(far[i in 0..19]: right[i] @ (l/2, 0), left[i + 1] @ (-l/2, 0))]
#[revolute(foot: ground @ (0, 0), left[0] @ (-l/2, 0))]
#[y(slide: right[0] @ (-l/2, 0) = 0)]
#[driver(pull: right[0].phi = pi - theta - 0.2 * sin(omega * t))]
#[point(top = left[19] @ (l/2, 0))]
#[define(height = top.y)]
#[guess(left[i in 0..20].phi = theta, right[i in 0..20].phi = pi - theta)]
pub struct ScissorLift {
    /// Length of a bar
    #[param(1.0, unit = "m")]
    pub l: f64,
    /// Angle of the bars at t = 0
    #[param(0.5, unit = "rad")]
    pub theta: f64,
    /// Speed of the drive
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<ScissorLift>()
}
