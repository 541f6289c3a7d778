//! Source: Marghitu and Dupac, Advanced Dynamics, examples 5.5 and 5.6; see `tests/data/PUBLISHED.md`.

use kin_runtime::mechanism;

/// R-RTR-RRT: a slider pinned to the crank slides on link 3, which moves a second slider `E` by link 4.
#[mechanism]
#[bodies(crank, slider2, link3, link4, slider5)]
#[point(B = crank @ (ab, 0))]
#[point(D = link3 @ (-cd, 0))]
#[point(E = link4 @ (de, 0))]
#[point(F = link3 @ (cf, 0))]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: B, slider2 @ (0, 0))]
#[translational(slide: link3 @ (0, 0), slider2 @ (0, 0), axis = (1, 0))]
#[revolute(C: ground @ (-ac, 0), link3 @ (0, 0))]
#[revolute(D: D, link4 @ (0, 0))]
#[revolute(E: E, slider5 @ (0, 0))]
#[translational(guide: ground @ (-ac - a, 0), slider5 @ (0, 0), axis = (0, 1))]
#[driver(drive: crank.phi = 200 * pi / 180 + 2 * pi * rpm / 60 * t)]
#[guess(link3.phi = -0.3, link4.phi = 2, slider5.y = 0.2)]
pub struct MarghituSixLink {
    /// Crank AB
    #[param(0.15, unit = "m")]
    pub ab: f64,
    /// Distance of the ground pins A and C
    #[param(0.30, unit = "m")]
    pub ac: f64,
    /// D from C on link 3
    #[param(0.20, unit = "m")]
    pub cd: f64,
    /// Link 4
    #[param(0.14, unit = "m")]
    pub de: f64,
    /// F from C on link 3
    #[param(0.50, unit = "m")]
    pub cf: f64,
    /// Guide of slider 5, left of C
    #[param(0.25, unit = "m")]
    pub a: f64,
    /// Speed of the crank
    #[param(700, unit = "rpm")]
    pub rpm: f64,
}
