//! Source: `tests/data/quick_return.json`.

use kin_runtime::mechanism;

/// Quick-return shaper: a crank pin's block slides in the offset slot of a rocker, the rocker drives a ram by a rod.
#[mechanism]
#[bodies(crank, block, rocker, rod, ram)]
#[point(R = ram @ (0.05, 0.02))]
#[point(B = rocker @ (l/2, 0.01))]
#[revolute(O2: ground @ (x1, a), crank @ (0, 0))]
#[revolute(C: crank @ (r, 0), block @ (0, 0))]
#[translational(slot: rocker @ (0, 0.01 + e), block @ (0, 0), axis = (1, 0), angle = 0.15)]
#[revolute(O4: ground @ (0, 0), rocker @ (-l/2, 0.01))]
#[revolute(B: B, rod @ (-b, 0))]
#[revolute(R: rod @ (0, 0), R)]
#[translational(guide: ground @ (0, h), R, axis = (1, 0))]
#[driver(drive: crank.phi = 0.4 + w * t + 0.08 * pow(t, 2))]
#[guess(block.phi = 1.3, rocker.phi = 1.2, rod.phi = 0.0)]
pub struct QuickReturn {
    /// Crank pin, y
    #[param(0.27, unit = "m")]
    pub a: f64,
    /// Crank pin, x
    #[param(0.012, unit = "m")]
    pub x1: f64,
    /// Crank length
    #[param(0.12, unit = "m")]
    pub r: f64,
    /// Rocker length
    #[param(0.62, unit = "m")]
    pub l: f64,
    /// Rod length
    #[param(0.33, unit = "m")]
    pub b: f64,
    /// Height of the guide
    #[param(0.58, unit = "m")]
    pub h: f64,
    /// Offset of the slot
    #[param(0.015, unit = "m")]
    pub e: f64,
    /// Speed of the drive
    #[param(1.9, unit = "rad/s")]
    pub w: f64,
}
