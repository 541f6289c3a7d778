//! Theo Jansen's walking beast: how long is a step of its legs, and how flat does a foot stay on the ground?
//!
//! Two legs on one crank, mirror images of one another, of six links each: `side` is −1 for the left one and 1 for the
//! right one. The crank pin pulls and pushes the bars j and k; the triangle above swings around a fixed axle, and two links
//! more carry the triangle of the foot.
//!
//! ```text
//!            upper
//!          ╱ │  ╲ j           e b d: the thigh, around the fixed axle (−a, −l)
//!       e ╱  │ b  ╲
//!        ╱ d │      O m       m: the crank
//!      outer ─ axle ╱
//!      f │    │ c ╱ k         g h i: the shin, with the foot
//!      top ─ g ─ knee
//!        h ╲   │ i
//!            foot
//! ```
//!
//! Dimensions: Jansen's eleven "holy numbers" and a, l (Theo Jansen, The Great Pretender, 2007), read as millimetres.
//!
//! ```text
//! cargo run --release --example jansen --features plot -- plot 'foot[0]' --out foot.svg
//! cargo run --release --example jansen -- animate --out jansen.html
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// Two of Theo Jansen's legs on one crank.
#[mechanism]
#[bodies(crank, bar_j[2], bar_k[2], thigh[2], bar_c[2], bar_f[2], shin[2])]
#[define(outer_x = (b.powi(2) + d.powi(2) - e.powi(2)) / (2*b))]
#[define(foot_x = (g.powi(2) + i.powi(2) - h.powi(2)) / (2*g))]
#[revolute(shaft: ground @ (0, 0), crank @ (0, 0))]
#[revolute(pin_j[n in 0..2]: crank @ (m, 0), bar_j[n] @ (0, 0))]
#[revolute(pin_k[n in 0..2]: crank @ (m, 0), bar_k[n] @ (0, 0))]
#[revolute(axle[n in 0..2]: ground @ (a * side[n], -l), thigh[n] @ (0, 0))]
#[revolute(axle_c[n in 0..2]: ground @ (a * side[n], -l), bar_c[n] @ (0, 0))]
#[revolute(upper[n in 0..2]: bar_j[n] @ (j, 0), thigh[n] @ (b, 0))]
#[revolute(outer[n in 0..2]: thigh[n] @ (outer_x, -side[n] * sqrt(d.powi(2) - outer_x.powi(2))), bar_f[n] @ (0, 0))]
#[revolute(knee_c[n in 0..2]: bar_c[n] @ (c, 0), shin[n] @ (0, 0))]
#[revolute(knee_k[n in 0..2]: bar_k[n] @ (k, 0), shin[n] @ (0, 0))]
#[revolute(top[n in 0..2]: bar_f[n] @ (f, 0), shin[n] @ (g, 0))]
#[point(foot[n in 0..2] = shin[n] @ (foot_x, -side[n] * sqrt(i.powi(2) - foot_x.powi(2))))]
#[driver(drive: crank.phi = omega * t)]
#[guess(bar_j[n in 0..2].phi = pi/2 - 0.9 * side[n], bar_k[n in 0..2].phi = -pi/2 + 0.7 * side[n])]
#[guess(thigh[n in 0..2].phi = pi/2 + 0.3 * side[n], bar_c[n in 0..2].phi = -pi/2 - 0.3 * side[n])]
#[guess(bar_f[n in 0..2].phi = -pi/2 - 0.4 * side[n], shin[n in 0..2].phi = pi/2 - 1.1 * side[n])]
pub struct Jansen {
    /// The left leg, the right leg
    #[param([-1, 1])]
    pub side: [f64; 2],
    /// Crank
    #[param(15, unit = "mm")]
    pub m: f64,
    /// From the shaft to the fixed axles, across
    #[param(38, unit = "mm")]
    pub a: f64,
    /// From the shaft to the fixed axles, down
    #[param(7.8, unit = "mm")]
    pub l: f64,
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
    /// Crank speed
    #[param(2.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Jansen>()
}
