//! A quick-return shaper: the ram goes slowly forth and quickly back.
//!
//! The crank pin carries a block that slides in the slot of an oscillating rocker: a `translational` joint between two
//! moving bodies. A rod leads from the rocker's end to the ram, which slides on the ground.
//!
//! ```text
//! cargo run --release --example quick_return
//! cargo run --release --example quick_return -- sweep --from 0 --to 3 --steps 60 --format csv
//! ```
//!
//! The rod closes in two ways. `--guess rod.phi=3.1` assembles the one with the ram on the left.

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A quick-return shaper with an oscillating rocker.
#[mechanism]
#[bodies(crank, block, rocker, rod, ram)]
#[point(tool = ram @ (0.1, 0))]
#[revolute(O2: ground @ (0, a), crank @ (0, 0))]
#[revolute(C: crank @ (r, 0), block @ (0, 0))]
#[translational(slot: rocker @ (0, 0), block @ (0, 0), axis = (1, 0))]
#[revolute(O4: ground @ (0, 0), rocker @ (0, 0))]
#[revolute(B: rocker @ (l, 0), rod @ (0, 0))]
#[revolute(R: rod @ (b, 0), ram @ (0, 0))]
#[translational(guide: ground @ (0, h), ram @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = omega * t)]
#[guess(rocker.phi = 1.2, rod.phi = 0)]
pub struct QuickReturn {
    /// Height of the crank's pin above the rocker's
    #[param(0.27, unit = "m")]
    pub a: f64,
    /// Crank radius
    #[param(0.12, unit = "m")]
    pub r: f64,
    /// Rocker length
    #[param(0.62, unit = "m")]
    pub l: f64,
    /// Rod length
    #[param(0.33, unit = "m")]
    pub b: f64,
    /// Height of the ram's guide
    #[param(0.58, unit = "m")]
    pub h: f64,
    /// Crank speed
    #[param(2.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<QuickReturn>()
}
