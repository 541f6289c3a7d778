//! Source: `tests/data/underdriven_fivebar.json`.

use kin_runtime::mechanism;

/// A five-bar, two degrees of freedom, with one driven crank: eleven rows for twelve coordinates.
#[mechanism]
#[bodies(crank1, crank2, link1, link2)]
#[point(X = link2 @ (0.3, 0.07))]
#[revolute(O1: ground @ (0, 0), crank1 @ (0, 0))]
#[revolute(O2: ground @ (0.45, -0.03), crank2 @ (-0.09, 0))]
#[revolute(A: crank1 @ (0.2, 0), link1 @ (-0.1, 0.02))]
#[revolute(B: crank2 @ (0.09, 0), link2 @ (-0.17, 0))]
#[revolute(C: link1 @ (0.21, 0.05), link2 @ (0.17, 0))]
#[driver(d1: crank1.phi = 1.2 + 0.6 * t)]
#[guess(crank2.phi = 2.5, link1.phi = 0.7, link2.phi = 1.6)]
pub struct UnderdrivenFivebar;
