//! Source: `tests/data/watt_sixbar.json`.

use kin_runtime::mechanism;

/// Watt-I six-bar: a four-bar whose ternary coupler and ternary rocker carry a second dyad.
#[mechanism]
#[bodies(crank, coupler, rocker, link5, link6)]
#[point(G = link6 @ (0.27, 0))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.15, 0), coupler @ (-0.18, -0.04))]
#[revolute(B: coupler @ (0.19, -0.03), rocker @ (0.28, 0.03))]
#[revolute(D: ground @ (0.42, 0.05), rocker @ (0, 0))]
#[revolute(E: coupler @ (0.02, 0.17), link5 @ (-0.15, 0.01))]
#[revolute(F: rocker @ (0.17, -0.14), link6 @ (0, 0))]
#[revolute(G: link5 @ (0.16, 0), G)]
#[driver(drive: crank.phi = 0.3 + w * t + 0.2 * sin(2 * t))]
#[guess(coupler.phi = 0.8, rocker.phi = 1.6, link5.phi = 0.4, link6.phi = 2.2)]
pub struct WattSixbar {
    /// Speed of the drive
    #[param(1.7, unit = "rad/s")]
    pub w: f64,
}
