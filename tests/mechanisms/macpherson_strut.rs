//! Source: `tests/data/macpherson_strut.json`.

use kin_runtime::mechanism;

/// MacPherson strut: the wheel carrier slides in a strut that turns; the height of the wheel centre `W` is driven.
/// The sliding joint stands between two moving bodies, and its axis is not given as a unit vector.
#[mechanism]
#[bodies(arm, knuckle, strut)]
#[point(W = knuckle @ (0.1, 0.05))]
#[point(K = knuckle @ (0, 0))]
#[revolute(G: ground @ (0, 0), arm @ (-0.17, 0))]
#[revolute(K: arm @ (0.17, 0), K)]
#[translational(slide: knuckle @ (-0.02, 0.1), strut @ (0, 0.02), axis = (-0.2, 1), angle = 0.07)]
#[revolute(T: ground @ (0.21, 0.62), strut @ (0, 0.02))]
#[driver(drive: W.y = 0.05 + 0.06 * sin(w * t) + 0.01 * t)]
#[guess(strut.phi = 0.1)]
pub struct MacphersonStrut {
    /// Speed of the drive
    #[param(2.1, unit = "rad/s")]
    pub w: f64,
}
