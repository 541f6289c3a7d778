//! Source: `tests/data/chain10.json`.

use kin_runtime::mechanism;

/// An open chain of ten links: the first angle driven, the others relative to the link before.
/// Frames alternate between the joint and the middle of the link.
#[mechanism]
#[bodies(link1, link2, link3, link4, link5, link6, link7, link8, link9, link10)]
#[point(E = link10 @ (0.18, 0))]
#[revolute(J1: ground @ (0.1, -0.2), link1 @ (-0.31/2, 0.01))]
#[revolute(J2: link1 @ (0.31/2, 0.01), link2 @ (0, 0))]
#[revolute(J3: link2 @ (0.29, 0), link3 @ (-0.27/2, 0.01))]
#[revolute(J4: link3 @ (0.27/2, 0.01), link4 @ (0, 0))]
#[revolute(J5: link4 @ (0.33, 0), link5 @ (-0.24/2, 0.01))]
#[revolute(J6: link5 @ (0.24/2, 0.01), link6 @ (0, 0))]
#[revolute(J7: link6 @ (0.22, 0), link7 @ (-0.3/2, 0.01))]
#[revolute(J8: link7 @ (0.3/2, 0.01), link8 @ (0, 0))]
#[revolute(J9: link8 @ (0.26, 0), link9 @ (-0.21/2, 0.01))]
#[revolute(J10: link9 @ (0.21/2, 0.01), link10 @ (0, 0))]
#[driver(d1: link1.phi = 0.3 + 0.7 * t)]
#[driver(d2: link2.phi - link1.phi = 0.2 * sin(1.1 * t))]
#[relative_angle(d3: link2, link3 = -0.4 + 0.3 * pow(t, 2))]
#[relative_angle(d4: link3, link4 = 0.25)]
#[relative_angle(d5: link4, link5 = 0.5 * cos(2 * t))]
#[driver(d6: link6.phi - link5.phi = 0.1 * t + 0.2 * sin(3 * t))]
#[relative_angle(d7: link6, link7 = -0.6 * t)]
#[driver(d8: link8.phi - link7.phi = 0.3 * sin(t) * cos(2 * t))]
#[relative_angle(d9: link8, link9 = 0.2 + 0.05 * pow(t, 3))]
#[driver(d10: link10.phi - link9.phi = -0.35 * sin(1.7 * t) - 0.1 * t)]
#[guess(
    link2.phi = 0.3, link3.phi = -0.1, link4.phi = 0.1, link5.phi = 0.7, link6.phi = 0.7,
    link7.phi = 0.7, link8.phi = 0.7, link9.phi = 0.8, link10.phi = 0.8
)]
pub struct Chain10;
