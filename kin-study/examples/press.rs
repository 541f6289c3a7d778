//! Tolerances: how many of a hundred thousand toggle presses end within 0.05 mm of where they should?
//!
//! ```text
//! cargo run --release --example press -- run examples/press.toml --out target/press
//! cargo run --release --example press -- query "select avg(case when abs(lower_end - 0.1) < 0.00005 then 1.0 else 0.0 end)
//!     as yield from study" --in target/press
//! cargo run --release --example press -- histogram target/press press.svg
//! ```

use kin_runtime::mechanism;
use kin_study_examples::{histogram, picture};
use std::process::ExitCode;

/// A toggle press on a crank.
#[mechanism]
#[bodies(crank, rod, upper, lower, ram)]
#[revolute(O: ground @ (ox, oy), crank @ (0, 0))]
#[revolute(C: crank @ (r, 0), rod @ (0, 0))]
#[revolute(T: ground @ (0, h), upper @ (0, 0))]
#[revolute(K: upper @ (a, 0), rod @ (l, 0))]
#[revolute(L: upper @ (a, 0), lower @ (0, 0))]
#[revolute(R: lower @ (b, 0), ram @ (0, 0))]
#[translational(guide: ground @ (0, 0), ram @ (0, 0), axis = (0, 1))]
#[driver(drive: crank.phi = omega * t)]
#[guess(rod.phi = 3.1, upper.phi = -1.4, lower.phi = -1.7, ram.y = 0.1)]
#[gravity(0, -9.81)]
#[mass(crank @ (0, 0), mass = 40, inertia = 1.2)]
#[mass(rod @ (l/2, 0), mass = 9, inertia = 0.4)]
#[mass(upper @ (a/2, 0), mass = 8, inertia = 0.14)]
#[mass(lower @ (b/2, 0), mass = 8, inertia = 0.14)]
#[mass(ram @ (0, -0.1), mass = 60)]
#[force(resistance: ram @ (0, -0.2), (0, work))]
pub struct Press {
    /// Crank radius
    #[param(0.08, unit = "m")]
    pub r: f64,
    /// Rod
    #[param(0.72, unit = "m")]
    pub l: f64,
    /// Upper link of the toggle
    #[param(0.45, unit = "m")]
    pub a: f64,
    /// Lower link of the toggle
    #[param(0.45, unit = "m")]
    pub b: f64,
    /// The shaft, across
    #[param(0.8, unit = "m")]
    pub ox: f64,
    /// The shaft, up
    #[param(0.55, unit = "m")]
    pub oy: f64,
    /// The upper pin of the toggle, up
    #[param(1.0, unit = "m")]
    pub h: f64,
    /// Crank speed
    #[param(6.0, unit = "rad/s")]
    pub omega: f64,
    /// What the work piece resists with
    #[param(20000.0, unit = "N")]
    pub work: f64,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().collect();
    match &words.iter().skip(1).map(String::as_str).collect::<Vec<_>>()[..] {
        ["histogram", study, out] => {
            let micrometres = |end: f64| 1e6 * (end - 0.1);
            picture(histogram(study, "How far the lower end of the ram is off, µm", "lower_end", micrometres), out)
        }
        _ => kin_study::main::<Press>(),
    }
}
