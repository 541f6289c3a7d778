//! A belt between pulleys on the ground, and one on a moving arm.

use kin_runtime::mechanism;

/// A motor swings an arm by a belt; a second belt along the arm, from a pulley of the ground to an equal one that
/// carries the gripper, keeps the gripper's direction.
#[mechanism]
#[bodies(motor, arm, gripper)]
#[point(tip = gripper @ (0.2, 0))]
#[revolute(M: ground @ (-0.4, 0.1), motor @ (0, 0))]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[revolute(G: arm @ (l, 0), gripper @ (0, 0))]
#[belt(primary: motor, arm, radii = (r1, r2), offset = -0.01)]
#[belt(parallel: ground, gripper, radii = (r3, r3), carrier = arm)]
#[driver(drive: motor.phi = 2 * sin(w * t))]
pub struct BeltDrive {
    /// Radius of the motor's pulley
    #[param(0.03, unit = "m")]
    pub r1: f64,
    /// Radius of the arm's pulley
    #[param(0.12, unit = "m")]
    pub r2: f64,
    /// Radius of both pulleys along the arm
    #[param(0.05, unit = "m")]
    pub r3: f64,
    /// Length of the arm
    #[param(0.7, unit = "m")]
    pub l: f64,
    /// Frequency of the drive
    #[param(1.7, unit = "rad/s")]
    pub w: f64,
}
