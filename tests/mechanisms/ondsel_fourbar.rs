//! Source: OndselSolver, `testapp/fourbar.asmt`; see `tests/data/PUBLISHED.md`.

use kin_runtime::mechanism;

/// A four-bar whose crank makes full turns, with all frames off the links.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0.1, 0.1))]
#[revolute(B: crank @ (0.9, 0.1), coupler @ (0.1, 0.1))]
#[revolute(C: coupler @ (1.9, 0.1), rocker @ (0.1, 0.1))]
#[revolute(Q: rocker @ (1.4, 0.1), ground @ (2, 0))]
#[driver(drive: crank.phi = 2 * pi * t)]
#[guess(coupler.phi = 0.8, rocker.phi = -1.6)]
pub struct OndselFourbar;
