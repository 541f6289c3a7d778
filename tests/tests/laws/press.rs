//! The toggle press of the guide as a program.

#![allow(unreachable_pub, reason = "a program of its own")]

use kin_runtime::mechanism;

/// A toggle press: a crank straightens a knee, which pushes the ram down.
#[mechanism(cross_check)]
#[bodies(crank, pull, upper, lower)]
#[body(ram, x = 0, phi = 0)]
#[revolute(O: ground @ (-reach, -height), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), pull @ (0, 0))]
#[revolute(K1: pull @ (c, 0), upper @ (l, 0))]
#[revolute(T: ground @ (0, 0), upper @ (0, 0))]
#[revolute(K2: upper @ (l, 0), lower @ (0, 0))]
#[revolute(R: lower @ (l, 0), ram @ (0, 0))]
#[driver(motor: crank.phi = omega * t)]
#[point(knee = upper @ (l, 0))]
#[define(lift = ram.y + 2 * l)]
#[guess(pull.phi = 0, upper.phi = -1.8, lower.phi = -1.3, ram.y = -2 * l)]
pub struct Press {
    /// Crank radius
    #[param(0.05, unit = "m")]
    pub r: f64,
    /// Connecting rod
    #[param(0.55, unit = "m")]
    pub c: f64,
    /// Toggle links
    #[param(0.3, unit = "m")]
    pub l: f64,
    /// How far left of the ram the crank turns
    #[param(0.68, unit = "m")]
    pub reach: f64,
    /// How far below the top it turns
    #[param(0.3, unit = "m")]
    pub height: f64,
    /// Crank speed
    #[param(6.0, unit = "rad/s")]
    pub omega: f64,
}
