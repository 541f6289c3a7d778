//! Klann's leg: how long and how high does it step, and for which part of the turn is its foot on the ground?
//!
//! A six-bar: a crank moves a connecting rod, which two rockers and the knee of the leg hold; the foot goes straight along
//! the ground and high above it on its way back.
//!
//! ```text
//!      E───── D                 O crank axle, pin C
//!     ╱        ▔ rocker_up      B, D axles of the rockers
//!    F───H──────C               H elbow on the rod, F knee
//!    │   ╲    O╱                E hip, G foot
//!    │     B
//!    G
//! ```
//!
//! Dimensions: the optimised proportions of "Klann" at boim.com/Walkin8r, in millimetres:
//! OC = 17.5, B = (−38.8, −12.5), D = (−14.6, 41.9), BH = 23.7, CF = 73.4, CH = 38.8, HF = 35.2, DE = 34.1, EF = 57.7,
//! FG = 59, EG = 111.7. J. Klann, US patent 6260862, has the leg.
//!
//! ```text
//! cargo run --release --example klann --features plot -- plot foot --out foot.svg
//! cargo run --release --example klann -- animate --out klann.html
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// Klann's walking leg.
#[mechanism]
#[bodies(crank, rod, rocker_low, rocker_up, leg)]
#[define(knee_x = (ch.powi(2) + hf.powi(2) - cf.powi(2)) / (2*ch))]
#[define(foot_x = (ef.powi(2) + eg.powi(2) - fg.powi(2)) / (2*ef))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(C: crank @ (oc, 0), rod @ (ch, 0))]
#[revolute(B: ground @ (bx, by), rocker_low @ (0, 0))]
#[revolute(H: rocker_low @ (bh, 0), rod @ (0, 0))]
#[revolute(D: ground @ (dx, dy), rocker_up @ (0, 0))]
#[revolute(E: rocker_up @ (de, 0), leg @ (0, 0))]
#[revolute(F: rod @ (knee_x, sqrt(hf.powi(2) - knee_x.powi(2))), leg @ (ef, 0))]
#[point(foot = leg @ (foot_x, sqrt(eg.powi(2) - foot_x.powi(2))))]
#[driver(drive: crank.phi = omega * t)]
#[guess(rod.phi = -0.1, rocker_low.phi = 0.7, rocker_up.phi = 2.4, leg.phi = -1.8)]
pub struct Klann {
    /// Crank
    #[param(17.5, unit = "mm")]
    pub oc: f64,
    /// Axle B of the lower rocker, x
    #[param(-38.8, unit = "mm")]
    pub bx: f64,
    /// Axle B of the lower rocker, y
    #[param(-12.5, unit = "mm")]
    pub by: f64,
    /// Axle D of the upper rocker, x
    #[param(-14.6, unit = "mm")]
    pub dx: f64,
    /// Axle D of the upper rocker, y
    #[param(41.9, unit = "mm")]
    pub dy: f64,
    /// Lower rocker
    #[param(23.7, unit = "mm")]
    pub bh: f64,
    /// Upper rocker
    #[param(34.1, unit = "mm")]
    pub de: f64,
    /// Connecting rod, from the crank to the elbow
    #[param(38.8, unit = "mm")]
    pub ch: f64,
    /// Connecting rod, from the elbow to the knee
    #[param(35.2, unit = "mm")]
    pub hf: f64,
    /// Connecting rod, from the crank to the knee
    #[param(73.4, unit = "mm")]
    pub cf: f64,
    /// Leg, from the hip to the knee
    #[param(57.7, unit = "mm")]
    pub ef: f64,
    /// Leg, from the knee to the foot
    #[param(59, unit = "mm")]
    pub fg: f64,
    /// Leg, from the hip to the foot
    #[param(111.7, unit = "mm")]
    pub eg: f64,
    /// Crank speed
    #[param(-2.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Klann>()
}
