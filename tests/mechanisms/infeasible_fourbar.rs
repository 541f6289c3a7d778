//! Source: `tests/data/infeasible_fourbar.json`.

use kin_runtime::mechanism;

/// A four-bar whose links cannot bridge the distance of its ground pins: it assembles at no time.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
#[revolute(D: ground @ (d1, d2), rocker @ (l3/2, 0))]
#[driver(drive: crank.phi = pi / 4 + 2 * t)]
pub struct InfeasibleFourbar {
    /// Crank length
    #[param(0.1, unit = "m")]
    pub l1: f64,
    /// Coupler length
    #[param(0.12, unit = "m")]
    pub l2: f64,
    /// Rocker length
    #[param(0.13, unit = "m")]
    pub l3: f64,
    /// Ground pin D, x
    #[param(0.4, unit = "m")]
    pub d1: f64,
    /// Ground pin D, y
    #[param(0.1, unit = "m")]
    pub d2: f64,
}
