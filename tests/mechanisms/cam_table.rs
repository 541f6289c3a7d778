//! A cam whose lift is a table.

use core::f64::consts::TAU;
use kin_runtime::function::CubicSpline;
use kin_runtime::mechanism;

/// A follower that is driven from a table over the cam's angle, and a rocker that it turns.
#[mechanism]
#[function(lift)]
#[bodies(cam, follower, rocker)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(guide: ground @ (a, 0), follower @ (0, 0), axis = (0, 1))]
#[revolute(P: ground @ (0, 0.1), rocker @ (0, 0))]
#[point_on_line(slot: rocker @ (0, 0), follower @ (0, 0), axis = (1, 0))]
#[driver(turn: cam.phi = omega * t)]
#[driver(rise: follower.y = base + lift(cam.phi))]
#[define(speed = lift(2 * cam.phi) + lift(omega))]
#[guess(follower.y = base, rocker.phi = 0)]
pub struct CamTable {
    /// Lift over the cam's angle
    pub lift: CubicSpline,
    /// Distance of the guide
    pub a: f64,
    /// Lowest position of the follower
    pub base: f64,
    /// Speed of the cam
    pub omega: f64,
}

impl Default for CamTable {
    fn default() -> Self {
        let angle: Vec<f64> = (0..=12).map(|k| TAU * f64::from(k) / 12.0).collect();
        let lift = [0.0, 0.002, 0.011, 0.024, 0.035, 0.039, 0.040, 0.038, 0.030, 0.018, 0.007, 0.001, 0.0];
        let lift = CubicSpline::periodic(&angle, &lift).expect("a sound table");
        Self { lift, a: 0.15, base: 0.07, omega: 2.0 }
    }
}
