//! Source: Andrews' squeezing mechanism of the test set for IVP solvers; see `tests/data/PUBLISHED.md`.

use kin_runtime::mechanism;

/// Andrews' squeezing mechanism with the frames of its seven bodies at their pins.
/// The crank passes `beta` at t = 0 with the speed `beta_dot`.
#[mechanism]
#[bodies(K1, K2, K3, K4, K5, K6, K7)]
#[point(P = K2 @ (-d, 0))]
#[revolute(O: ground @ (0, 0), K1 @ (0, 0))]
#[revolute(F: K1 @ (rr, 0), K2 @ (0, 0))]
#[revolute(B: ground @ (xb, yb), K3 @ (0, 0))]
#[revolute(P3: K3 @ (0, -ss), P)]
#[revolute(A5: ground @ (xa, ya), K5 @ (0, 0))]
#[revolute(G: K5 @ (zt, 0), K4 @ (0, 0))]
#[revolute(P4: K4 @ (0, -e), P)]
#[revolute(A7: ground @ (xa, ya), K7 @ (0, 0))]
#[revolute(H: K7 @ (0, -u), K6 @ (0, 0))]
#[revolute(P6: K6 @ (zf, 0), P)]
#[driver(drive: K1.phi = beta + beta_dot * t)]
#[guess(K2.phi = -0.06, K3.phi = 0.46, K4.phi = 0.71, K5.phi = 0.49, K6.phi = 1.01, K7.phi = 1.23)]
pub struct AndrewsPins {
    /// P from F on K2
    #[param(0.028, unit = "m")]
    pub d: f64,
    /// P from G on K4
    #[param(0.02, unit = "m")]
    pub e: f64,
    /// Crank OF
    #[param(0.007, unit = "m")]
    pub rr: f64,
    /// P from B on K3
    #[param(0.035, unit = "m")]
    pub ss: f64,
    /// H from A on K7
    #[param(0.04, unit = "m")]
    pub u: f64,
    /// P from H on K6
    #[param(0.02, unit = "m")]
    pub zf: f64,
    /// G from A on K5
    #[param(0.04, unit = "m")]
    pub zt: f64,
    /// Ground pin A, x
    #[param(-0.06934, unit = "m")]
    pub xa: f64,
    /// Ground pin A, y
    #[param(-0.00227, unit = "m")]
    pub ya: f64,
    /// Ground pin B, x
    #[param(-0.03635, unit = "m")]
    pub xb: f64,
    /// Ground pin B, y
    #[param(0.03273, unit = "m")]
    pub yb: f64,
    /// Crank angle at t = 0
    #[param(-0.06171389001427645, unit = "rad")]
    pub beta: f64,
    /// Crank speed at t = 0
    #[param(40, unit = "rad/s")]
    pub beta_dot: f64,
}
