//! Curves on moving bodies, repeated over families.

use kin_runtime::mechanism;

/// A carriage that climbs while two cams turn in it; each lifts a roller follower and a flat one that slide in it.
#[mechanism]
#[bodies(carriage, cam[2], tappet[2], plate[2])]
#[coordinates(u[2])]
#[translational(way: ground @ (0, 0), carriage @ (0, -0.02), axis = (2, 1), angle = 0.2)]
#[revolute(shaft[i in 0..2]: carriage @ (x[i], 0), cam[i] @ (0, 0))]
#[translational(lift[i in 0..2]: carriage @ (x[i], 0), tappet[i] @ (0, 0), axis = (0, 1))]
#[translational(drop[i in 0..2]: carriage @ (x[i], 0), plate[i] @ (0, 0), axis = (0, 1), angle = 0.1)]
#[on_curve(roll[i in 0..2]: cam[i] @ (0, 0), tappet[i] @ (0, 0), parametric(u[i]) = (e[i] + r*cos(u[i]), r*sin(u[i])), roller = -0.01)]
#[flat_follower(face[i in 0..2]: cam[i] @ (0, 0), plate[i] @ (0.01, 0), axis = (-1, 0), support(theta) = r + e[i]*cos(theta))]
#[relative_angle(turn[i in 0..2]: carriage, cam[i] = 0.4 + w*t + e[i])]
#[driver(drive: carriage.x = 0.1 * t)]
#[guess(carriage.phi = 0.2, u[0] = 1.2, u[1] = 1.2, tappet[0].y = 0.05, tappet[1].y = 0.05, plate[0].y = -0.04, plate[1].y = -0.04)]
pub struct CamsOnCarriage {
    /// Places of the shafts
    #[param([-0.1, 0.15], unit = "m")]
    pub x: [f64; 2],
    /// Eccentricities, without a unit because formulas combine them with angles, too
    #[param([0.012, 0.02])]
    pub e: [f64; 2],
    /// Radius of the cams
    #[param(0.04, unit = "m")]
    pub r: f64,
    /// Speed of the cams
    #[param(2.0, unit = "rad/s")]
    pub w: f64,
}
