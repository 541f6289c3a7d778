//! A Scotch yoke: how does the piston of a pump move when its crank pin slides in a straight slot?
//!
//! Exactly as r cos φ: where a slider-crank adds the harmonics of its rod, the yoke moves as the projection of the pin.
//! The pin on the slot is one row, `point_on_line`; the block that would slide there is not needed as a body.
//!
//! ```text
//!            │     │
//!      ══════╡  o  ╞══ piston     pin:   r cos φ from the shaft along the guide
//!            │ ╱   │              guide: along x
//!            │O    │
//! ```
//!
//! The dimensions are this example's own: any crank radius gives the same law.
//!
//! ```text
//! cargo run --release --example scotch_yoke -- sweep --from 0 --to 0.1 --steps 24
//! cargo run --release --example scotch_yoke --features plot -- plot piston.x piston.x_dot --out piston.svg
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A pump driven by a Scotch yoke.
#[mechanism]
#[bodies(crank, yoke)]
#[revolute(shaft: ground @ (0, 0), crank @ (0, 0))]
#[translational(guide: ground @ (0, 0), yoke @ (0, 0), axis = (1, 0))]
#[point_on_line(slot: yoke @ (0, 0), crank @ (r, 0), axis = (0, 1))]
#[point(piston = yoke @ (l, 0))]
#[driver(drive: crank.phi = 2*pi*rpm/60 * t)]
pub struct ScotchYoke {
    /// Crank radius
    #[param(0.04, unit = "m")]
    pub r: f64,
    /// From the slot to the piston
    #[param(0.1, unit = "m")]
    pub l: f64,
    /// Crank speed
    #[param(600, unit = "rpm")]
    pub rpm: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<ScotchYoke>()
}
