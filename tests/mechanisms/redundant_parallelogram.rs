//! Source: `tests/data/redundant_parallelogram.json`.

use kin_runtime::mechanism;

/// A parallelogram with a third parallel link: thirteen consistent rows of rank twelve.
#[mechanism(allow_redundant)]
#[bodies(crank, coupler, rocker, middle)]
#[revolute(O1: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (-b/2, 0.02))]
#[revolute(B: coupler @ (b/2, 0.02), rocker @ (a/2, 0))]
#[revolute(O2: ground @ (b, 0), rocker @ (-a/2, 0))]
#[revolute(O3: ground @ (s * b, 0), middle @ (0, 0))]
#[revolute(C: coupler @ (-b/2 + s * b, 0.02), middle @ (a, 0))]
#[driver(drive: crank.phi = 0.6 + w * t - 0.1 * pow(t, 2))]
#[guess(rocker.phi = 0.6, middle.phi = 0.6)]
pub struct RedundantParallelogram {
    /// Length of the three parallel links
    #[param(0.27, unit = "m")]
    pub a: f64,
    /// Coupler length
    #[param(0.63, unit = "m")]
    pub b: f64,
    /// Place of the middle link, as a share of the coupler
    #[param(0.29)]
    pub s: f64,
    /// Speed of the drive
    #[param(1.4, unit = "rad/s")]
    pub w: f64,
}
