//! Sensitivity by brute force: which links of a walking leg must be exact, so that its foot stays flat on the ground?
//!
//! The study takes a hundred thousand legs whose links are up to two percent longer or shorter, and counts how far the foot
//! rises while it carries. The picture draws the hundred flattest legs over their links: where the lines run together, the
//! length matters.
//!
//! ```text
//! cargo run --release --example leg -- run examples/leg.toml --out target/leg
//! cargo run --release --example leg -- picture target/leg leg.svg
//! cargo run --release --example leg -- histogram target/leg rise.svg
//! ```

use kin_runtime::mechanism;
use kin_study_examples::{histogram, parallel, picture};
use std::process::ExitCode;

/// One of Theo Jansen's legs.
#[mechanism]
#[bodies(crank, bar_j, bar_k, thigh, bar_c, bar_f, shin)]
#[define(outer_x = (b.powi(2) + d.powi(2) - e.powi(2)) / (2*b))]
#[define(foot_x = (g.powi(2) + i.powi(2) - h.powi(2)) / (2*g))]
#[revolute(shaft: ground @ (0, 0), crank @ (0, 0))]
#[revolute(pin_j: crank @ (m, 0), bar_j @ (0, 0))]
#[revolute(pin_k: crank @ (m, 0), bar_k @ (0, 0))]
#[revolute(axle: ground @ (38, -7.8), thigh @ (0, 0))]
#[revolute(axle_c: ground @ (38, -7.8), bar_c @ (0, 0))]
#[revolute(upper: bar_j @ (j, 0), thigh @ (b, 0))]
#[revolute(outer: thigh @ (outer_x, -sqrt(d.powi(2) - outer_x.powi(2))), bar_f @ (0, 0))]
#[revolute(knee_c: bar_c @ (c, 0), shin @ (0, 0))]
#[revolute(knee_k: bar_k @ (k, 0), shin @ (0, 0))]
#[revolute(top: bar_f @ (f, 0), shin @ (g, 0))]
#[point(foot = shin @ (foot_x, -sqrt(i.powi(2) - foot_x.powi(2))))]
#[driver(drive: crank.phi = t)]
#[guess(bar_j.phi = pi/2 - 0.9, bar_k.phi = -pi/2 + 0.7, thigh.phi = pi/2 + 0.3, bar_c.phi = -pi/2 - 0.3)]
#[guess(bar_f.phi = -pi/2 - 0.4, shin.phi = pi/2 - 1.1)]
pub struct Leg {
    /// Crank
    #[param(15, unit = "mm")]
    pub m: f64,
    /// Thigh, from the axle to the upper corner
    #[param(41.5, unit = "mm")]
    pub b: f64,
    /// From the axle to the knee
    #[param(39.3, unit = "mm")]
    pub c: f64,
    /// Thigh, from the axle to the outer corner
    #[param(40.1, unit = "mm")]
    pub d: f64,
    /// Thigh, from corner to corner
    #[param(55.8, unit = "mm")]
    pub e: f64,
    /// From thigh to shin
    #[param(39.4, unit = "mm")]
    pub f: f64,
    /// Shin, from the knee to the top
    #[param(36.7, unit = "mm")]
    pub g: f64,
    /// Shin, from the top to the foot
    #[param(65.7, unit = "mm")]
    pub h: f64,
    /// Shin, from the knee to the foot
    #[param(49, unit = "mm")]
    pub i: f64,
    /// From the crank to the thigh
    #[param(50, unit = "mm")]
    pub j: f64,
    /// From the crank to the knee
    #[param(61.9, unit = "mm")]
    pub k: f64,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().collect();
    match &words.iter().skip(1).map(String::as_str).collect::<Vec<_>>()[..] {
        ["picture", study, out] => {
            let columns = ["b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "rise"];
            picture(parallel(study, "The flattest legs of a hundred thousand", &columns, "rise"), out)
        }
        ["histogram", study, out] => {
            picture(histogram(study, "How far the foot rises while it carries, mm", "rise", |rise| rise), out)
        }
        _ => kin_study::main::<Leg>(),
    }
}
