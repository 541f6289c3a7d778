//! A valve train from a table: a cam lifts a tappet as measured every 15°. Is the motion of the valve smooth?
//!
//! The table becomes a C² spline, which is the outline of the cam: the tappet stands on it and goes through every entry of
//! the table, its velocity is smooth and its acceleration continuous. A rocker turns its lift into that of a valve. The
//! camshaft does not turn evenly either: it runs up to speed by a motion law, whose slope at its end is the speed.
//!
//! ```text
//!        rocker ════●════       base circle, and the lift upon it:
//!       tappet │         │ valve    ρ(θ) = base + lift(π/2 − θ)
//!              ▼         ▼      the tappet stands at θ = π/2 of the ground
//!            ( cam )
//! ```
//!
//! The table is this example's own, of the size of a car's intake valve.
//!
//! ```text
//! cargo run --release --example cam_drive --features plot -- plot tappet.y tappet.y_ddot --from 0.2 --to 0.4 --out lift.svg
//! cargo run --release --example cam_drive -- sweep --from 0 --to 1.2 --steps 240 --format csv
//! cargo run --release --example cam_drive -- check
//! ```
//!
//! The columns `tappet.y`, `tappet.y_dot` and `tappet.y_ddot` are position, velocity and acceleration of the follower.

use kin_runtime::function::{CubicSpline, MotionLaw, Sequence};
use kin_runtime::mechanism;
use std::process::ExitCode;

/// Lift in millimetres, measured every 15° of the cam's angle.
pub const TABLE: [f64; 25] = [
    0.0, 0.0, 0.0, 0.0, 0.0, 0.02, 0.25, 1.1, 2.71, 4.72, 6.6, 7.9, 8.4, 7.9, 6.6, 4.72, 2.71, 1.1, 0.25, 0.02, 0.0,
    0.0, 0.0, 0.0, 0.0,
];

/// A valve train: a cam's table drives a tappet, a rocker and a valve.
#[mechanism(cross_check)]
#[function(shaft, lift)]
#[body(cam, x = 0, y = 0)]
#[body(tappet, x = 0, phi = 0)]
#[body(rocker, x = a, y = h)]
#[body(valve, x = a + b, phi = 0)]
#[driver(turn: cam.phi = shaft(t))]
#[on_curve(follow: cam @ (0, 0), tappet @ (0, 0), polar(theta) = base + lift(pi/2 - theta))]
#[point_on_line(left: rocker @ (0, 0), tappet @ (0, l), axis = (1, 0))]
#[point_on_line(right: rocker @ (0, 0), valve @ (0, 0), axis = (1, 0))]
#[define(valve_lift = valve.y - h)]
#[guess(cam.phi = 0, tappet.y = base, rocker.phi = 0, valve.y = h)]
pub struct CamDrive {
    /// Angle of the camshaft over time
    pub shaft: Sequence,
    /// Lift of the tappet over the cam's angle
    pub lift: CubicSpline,
    /// Radius of the base circle
    pub base: f64,
    /// Length of the push rod
    pub l: f64,
    /// Height of the rocker's pin
    pub h: f64,
    /// Distance from the tappet to the pin
    pub a: f64,
    /// Distance from the pin to the valve
    pub b: f64,
}

impl Default for CamDrive {
    fn default() -> Self {
        // Half a turn to get going, then a turn in 0.2 s for five turns.
        let turn = std::f64::consts::TAU;
        let shaft = Sequence::starting_at(0.0, 0.0)
            .polynomial(&[0.0, 0.0, 0.0, turn, -0.5 * turn], 0.2)
            .rise(MotionLaw::ConstantVelocity, 5.0 * turn, 1.0)
            .build();
        let angle = std::array::from_fn::<f64, 25, _>(|k| k as f64 * turn / 24.0);
        let lift = CubicSpline::periodic(&angle, &TABLE.map(|lift| 1e-3 * lift));
        Self {
            shaft: shaft.expect("a sound sequence"),
            lift: lift.expect("a sound table"),
            base: 0.018,
            l: 0.08,
            h: 0.098,
            a: 0.03,
            b: 0.042,
        }
    }
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<CamDrive>()
}
