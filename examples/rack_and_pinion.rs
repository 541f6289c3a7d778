//! A steering gear: how far do the wheels turn, and how differently?
//!
//! The steering wheel's pinion moves a rack across the car; tie rods lead from its ends to the arms of both wheels. The
//! inner wheel of a curve must turn further than the outer one, which the sloping arms bring about.
//!
//! ```text
//! cargo run --release --example rack_and_pinion
//! cargo run --release --example rack_and_pinion -- sweep --from 0 --to 1 --steps 20 --format csv
//! ```
//!
//! `left.phi` and `right.phi` are the angles of the wheels; `difference` is what Ackermann asks for.

use kin_runtime::mechanism;
use std::process::ExitCode;

/// Rack-and-pinion steering with tie rods.
#[mechanism]
#[bodies(pinion, rack, left, right)]
#[define(difference = left.phi - right.phi)]
#[revolute(column: ground @ (0, -0.12 + r), pinion @ (0, 0))]
#[translational(guide: ground @ (0, -0.12), rack @ (0, 0), axis = (1, 0))]
#[rack_pinion(mesh: ground @ (0, -0.12), rack @ (0, 0), axis = (1, 0), pinion = pinion, radius = r)]
#[revolute(king_left: ground @ (-track/2, 0), left @ (0, 0))]
#[revolute(king_right: ground @ (track/2, 0), right @ (0, 0))]
#[distance(rod_left: rack @ (-w, 0), left @ (inset, -arm), length = rod)]
#[distance(rod_right: rack @ (w, 0), right @ (-inset, -arm), length = rod)]
#[driver(steer: pinion.phi = 2*pi * t)]
pub struct Steering {
    /// Radius of the pinion
    #[param(0.008, unit = "m")]
    pub r: f64,
    /// Distance of the king pins
    #[param(1.3, unit = "m")]
    pub track: f64,
    /// Half the length of the rack
    #[param(0.33, unit = "m")]
    pub w: f64,
    /// Length of the steering arms, backwards
    #[param(0.13, unit = "m")]
    pub arm: f64,
    /// How far the arms slope inwards
    #[param(0.035, unit = "m")]
    pub inset: f64,
    /// Length of the tie rods
    #[param(0.28518, unit = "m")]
    pub rod: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Steering>()
}
