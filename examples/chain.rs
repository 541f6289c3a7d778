//! A chain of thirty links between two walls, written in a dozen lines: where does its end go when its links bend in turn?
//! Names in all output are `link[3].phi`; `sweep --format csv` writes one column for each.
//!
//! ```text
//! cargo run --release --example chain
//! cargo run --release --example chain -- solve --at 0.5 --format json
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A chain of thirty links, each bent against the one before.
#[mechanism]
#[bodies(link[30])]
#[revolute(root: ground @ (0, 0), link[0] @ (0, 0))]
#[revolute(pin[i in 0..29]: link[i] @ (l[i], 0), link[i + 1] @ (0, 0))]
#[driver(swing: link[0].phi = 0.4 * sin(omega * t))]
#[driver(bend[i in 1..30]: link[i].phi - link[i - 1].phi = bend[i] * cos(omega * t))]
#[point(end = link[29] @ (l[29], 0))]
pub struct Chain {
    /// Lengths of the links
    #[param(0.1, unit = "m")]
    pub l: [f64; 30],
    /// Largest bend of each link against the one before
    #[param(0.1, unit = "rad")]
    pub bend: [f64; 30],
    /// Speed of the motion
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Chain>()
}
