//! A planar parallel robot: a platform on three legs, whose group of four bodies has no closed form.

use kin_runtime::mechanism;

/// A 3-RRR robot with driven cranks, 21 coordinates.
#[mechanism]
#[bodies(crank1, rod1, crank2, rod2, crank3, rod3, platform)]
#[revolute(B1: ground @ (0, 0), crank1 @ (0, 0))]
#[revolute(A1: crank1 @ (0.38, 0), rod1 @ (-0.21, 0))]
#[revolute(P1: rod1 @ (0.21, 0), platform @ (-0.15, -0.1))]
#[revolute(B2: ground @ (1.2, 0.05), crank2 @ (0, 0))]
#[revolute(A2: crank2 @ (0.4, 0), rod2 @ (-0.2, 0))]
#[revolute(P2: rod2 @ (0.2, 0), platform @ (0.16, -0.09))]
#[revolute(B3: ground @ (0.55, 1.1), crank3 @ (0, 0))]
#[revolute(A3: crank3 @ (0.36, 0), rod3 @ (-0.22, 0))]
#[revolute(P3: rod3 @ (0.22, 0), platform @ (0, 0.18))]
#[driver(d1: crank1.phi = 1.49 - 0.2 * sin(t))]
#[driver(d2: crank2.phi = 3.4 + 0.15 * sin(t + 0.5))]
#[driver(d3: crank3.phi = -0.73 - 0.15 * sin(t + 1))]
#[guess(rod1.phi = -0.3, rod2.phi = 1.8, rod3.phi = -2.3, platform.phi = 0.1)]
pub struct Robot;
