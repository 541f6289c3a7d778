//! A double wishbone suspension: how much camber and track does a wheel gain while it rises and falls?
//!
//! Seen from the front, two arms of different lengths carry the upright. The shorter upper arm pulls the top of the wheel
//! inwards when it rises, which the leaning of the body in a bend would otherwise undo.
//!
//! ```text
//!      upper
//!   U ────────o    ▐█▌         U, L  pins on the car
//!              ╲   ▐█▌         camber: positive where the top leans outwards
//!               ╲──▐█▌ centre
//!               ╱  ▐█▌         contact: where the tyre meets the road
//!   L ─────────o   ▐█▌
//!      lower
//! ```
//!
//! The dimensions are this example's own, those of a small sports car.
//!
//! ```text
//! cargo run --release --example wishbone --features plot -- plot camber:rise track:rise --to 6.283 --out curves.svg
//! cargo run --release --example wishbone -- sweep --to 6.283 --steps 12 --points
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A double wishbone suspension of a right wheel, seen from behind.
#[mechanism]
#[bodies(lower, upper, upright)]
#[revolute(L: ground @ (0.30, 0.20), lower @ (0, 0))]
#[revolute(U: ground @ (0.38, 0.42), upper @ (0, 0))]
#[revolute(ball_low: lower @ (lower_length, 0), upright @ (-0.10, -0.12))]
#[revolute(ball_up: upper @ (upper_length, 0), upright @ (-0.13, 0.15))]
#[point(centre = upright @ (0, 0))]
#[point(contact = upright @ (0, -tyre))]
#[define(camber = -180/pi * upright.phi)]
#[define(rise = centre.y - tyre)]
#[define(track = contact.x - 0.75)]
#[driver(bump: centre.y = tyre + travel * sin(omega * t))]
#[guess(lower.phi = 0, upper.phi = 0.1, upright.x = 0.75, upright.y = tyre, upright.phi = 0)]
pub struct Wishbone {
    /// Lower arm
    #[param(0.3506, unit = "m")]
    pub lower_length: f64,
    /// Upper arm
    #[param(0.2419, unit = "m")]
    pub upper_length: f64,
    /// Radius of the tyre
    #[param(0.30, unit = "m")]
    pub tyre: f64,
    /// How far the wheel rises and falls
    #[param(0.08, unit = "m")]
    pub travel: f64,
    /// Pace of the bumps
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Wishbone>()
}
