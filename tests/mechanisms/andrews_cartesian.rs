//! Source: `tests/data/andrews_cartesian.json`.

use kin_runtime::mechanism;

/// Andrews' squeezing mechanism: seven bodies, ten revolute joints, frames at the mass centres of the IVP test set.
/// The body angles are β, β + Θ, γ, Φ + δ, δ, Ω + ε and ε of the test set; the crank is driven by β(t).
#[mechanism]
#[bodies(K1, K2, K3, K4, K5, K6, K7)]
#[point(D = K3 @ (sd - sb, sa - sc))]
#[point(E = K2 @ (da - d, 0))]
#[revolute(O: ground @ (0, 0), K1 @ (-ra, 0))]
#[revolute(F: K1 @ (rr - ra, 0), K2 @ (da, 0))]
#[revolute(E3: E, K3 @ (-sb, sa - ss))]
#[revolute(E4: E, K4 @ (0, -ea))]
#[revolute(E6: E, K6 @ (fa, 0))]
#[revolute(B: ground @ (xb, yb), K3 @ (-sb, sa))]
#[revolute(G: K4 @ (0, e - ea), K5 @ (zt - ta, -tb))]
#[revolute(A5: ground @ (xa, ya), K5 @ (-ta, -tb))]
#[revolute(H: K6 @ (fa - zf, 0), K7 @ (ub, ua - u))]
#[revolute(A7: ground @ (xa, ya), K7 @ (ub, ua))]
#[driver(drive: K1.phi = beta0 + w * t + 300 * pow(t, 2))]
#[guess(K2.phi = -0.1, K3.phi = 0.5, K4.phi = 0.7, K5.phi = 0.5, K6.phi = 1.0, K7.phi = 1.2)]
pub struct AndrewsCartesian {
    /// E from F on K2
    #[param(0.028, unit = "m")]
    pub d: f64,
    /// Mass centre of K2 from F
    #[param(0.0115, unit = "m")]
    pub da: f64,
    /// G from E on K4
    #[param(0.02, unit = "m")]
    pub e: f64,
    /// Mass centre of K4 from E
    #[param(0.01421, unit = "m")]
    pub ea: f64,
    /// F from O on K1
    #[param(0.007, unit = "m")]
    pub rr: f64,
    /// Mass centre of K1 from O
    #[param(0.00092, unit = "m")]
    pub ra: f64,
    /// E from B on K3
    #[param(0.035, unit = "m")]
    pub ss: f64,
    /// Mass centre of K3 from B, along
    #[param(0.01874, unit = "m")]
    pub sa: f64,
    /// Mass centre of K3 from B, across
    #[param(0.01043, unit = "m")]
    pub sb: f64,
    /// D from B on K3, along
    #[param(0.018, unit = "m")]
    pub sc: f64,
    /// D from B on K3, across
    #[param(0.02, unit = "m")]
    pub sd: f64,
    /// Mass centre of K5 from A, along
    #[param(0.02308, unit = "m")]
    pub ta: f64,
    /// Mass centre of K5 from A, across
    #[param(0.00916, unit = "m")]
    pub tb: f64,
    /// H from A on K7
    #[param(0.04, unit = "m")]
    pub u: f64,
    /// Mass centre of K7 from A, along
    #[param(0.01228, unit = "m")]
    pub ua: f64,
    /// Mass centre of K7 from A, across
    #[param(0.00449, unit = "m")]
    pub ub: f64,
    /// H from E on K6
    #[param(0.02, unit = "m")]
    pub zf: f64,
    /// Mass centre of K6 from E
    #[param(0.01421, unit = "m")]
    pub fa: f64,
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
    pub beta0: f64,
    /// Speed of the drive
    #[param(40, unit = "rad/s")]
    pub w: f64,
}
