//! Source: `tests/data/andrews_cartesian.json`, with the loads of `tests/data/forces/andrews_cartesian.json`.

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
#[gravity(0, -9.81)]
#[mass(K1 @ (-0.0027, -0.012), mass = 0.0958, inertia = 0.00000328)]
#[mass(K2 @ (0.0093, 0.011), mass = 0.27, inertia = 0.0000135)]
#[mass(K3 @ (0.0069, -0.0066), mass = 0.115, inertia = 0.00000818)]
#[mass(K4 @ (-0.0049, -0.0038), mass = 0.146, inertia = 0.0000192)]
#[mass(K5 @ (0.0053, -0.0084), mass = 0.134, inertia = 0.00000363)]
#[mass(K6 @ (0.0042, 0.0033), mass = 0.181, inertia = 0.00000731)]
#[mass(K7 @ (-0.0016, -0.0055), mass = 0.118, inertia = 0.00000494)]
#[force(pull: K3 @ (-0.0036, 0.0073), (1.1, 0.833))]
#[force(thrust: K4 @ (-0.01, 0.012), (-1.43, 0.612), frame = K4)]
#[torque(load: K1 = 0.028)]
#[spring(spring: K3 @ (-0.005, 0.0062), K7 @ (0.0032, 0.0084), stiffness = 92.4, free_length = 0.0362, damping = 2.27)]
#[torsion_spring(torsion: K2, K3, stiffness = 0.0264, free_angle = -0.86, damping = 0.0012)]
pub struct AndrewsCartesian {
    /// E from F on K2
    #[param(0.028)]
    pub d: f64,
    /// Mass centre of K2 from F
    #[param(0.0115)]
    pub da: f64,
    /// G from E on K4
    #[param(0.02)]
    pub e: f64,
    /// Mass centre of K4 from E
    #[param(0.01421)]
    pub ea: f64,
    /// F from O on K1
    #[param(0.007)]
    pub rr: f64,
    /// Mass centre of K1 from O
    #[param(0.00092)]
    pub ra: f64,
    /// E from B on K3
    #[param(0.035)]
    pub ss: f64,
    /// Mass centre of K3 from B, along
    #[param(0.01874)]
    pub sa: f64,
    /// Mass centre of K3 from B, across
    #[param(0.01043)]
    pub sb: f64,
    /// D from B on K3, along
    #[param(0.018)]
    pub sc: f64,
    /// D from B on K3, across
    #[param(0.02)]
    pub sd: f64,
    /// Mass centre of K5 from A, along
    #[param(0.02308)]
    pub ta: f64,
    /// Mass centre of K5 from A, across
    #[param(0.00916)]
    pub tb: f64,
    /// H from A on K7
    #[param(0.04)]
    pub u: f64,
    /// Mass centre of K7 from A, along
    #[param(0.01228)]
    pub ua: f64,
    /// Mass centre of K7 from A, across
    #[param(0.00449)]
    pub ub: f64,
    /// H from E on K6
    #[param(0.02)]
    pub zf: f64,
    /// Mass centre of K6 from E
    #[param(0.01421)]
    pub fa: f64,
    /// G from A on K5
    #[param(0.04)]
    pub zt: f64,
    /// Ground pin A, x
    #[param(-0.06934)]
    pub xa: f64,
    /// Ground pin A, y
    #[param(-0.00227)]
    pub ya: f64,
    /// Ground pin B, x
    #[param(-0.03635)]
    pub xb: f64,
    /// Ground pin B, y
    #[param(0.03273)]
    pub yb: f64,
    /// Crank angle at t = 0
    #[param(-0.06171389001427645)]
    pub beta0: f64,
    /// Speed of the drive
    #[param(40)]
    pub w: f64,
}
