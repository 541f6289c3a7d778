//! A closed-loop leg: two motors at the hip and two shanks that meet in the foot.

use kin_runtime::{Signal, mechanism};

/// A five-bar leg driven by the angles of its two motors.
#[mechanism]
#[bodies(thigh[2], shank[2])]
#[input(motor[2])]
#[point(foot = shank[0] @ (shank_length, 0))]
#[define(reach = distance(foot, ground @ (0, 0)))]
#[define(opening = motor[1] - motor[0])]
#[revolute(hip[i in 0..2]: ground @ (hip_x[i], 0), thigh[i] @ (0, 0))]
#[revolute(knee[i in 0..2]: thigh[i] @ (thigh_length, 0), shank[i] @ (0, 0))]
#[revolute(ankle: shank[0] @ (shank_length, 0), shank[1] @ (shank_length, 0))]
#[driver(drive[i in 0..2]: thigh[i].phi = motor[i])]
#[guess(shank[0].phi = -2.2, shank[1].phi = -0.9)]
pub struct FiveBarLeg {
    /// Where the motors sit.
    #[param([0.04, -0.04], unit = "m")]
    pub hip_x: [f64; 2],
    /// Length of both thighs.
    #[param(0.12, unit = "m")]
    pub thigh_length: f64,
    /// Length of both shanks.
    #[param(0.22, unit = "m")]
    pub shank_length: f64,
}

/// The same leg, its motors prescribed as its inputs move in the tests.
#[mechanism]
#[bodies(thigh[2], shank[2])]
#[point(foot = shank[0] @ (0.22, 0))]
#[revolute(front: ground @ (0.04, 0), thigh[0] @ (0, 0))]
#[revolute(rear: ground @ (-0.04, 0), thigh[1] @ (0, 0))]
#[revolute(knee[i in 0..2]: thigh[i] @ (0.12, 0), shank[i] @ (0, 0))]
#[revolute(ankle: shank[0] @ (0.22, 0), shank[1] @ (0.22, 0))]
#[driver(drive_front: thigh[0].phi = -0.5 + 0.4 * sin(2 * t))]
#[driver(drive_rear: thigh[1].phi = -2.6 + 0.3 * cos(3 * t))]
#[guess(shank[0].phi = -2.2, shank[1].phi = -0.9)]
pub struct DrivenLeg;

/// The angles of the motors during a closed motion of the foot.
pub(super) fn signals(t: f64) -> [Signal; 2] {
    let ((s2, c2), (s3, c3)) = ((2.0 * t).sin_cos(), (3.0 * t).sin_cos());
    [Signal::new(-0.5 + 0.4 * s2, 0.8 * c2, -1.6 * s2), Signal::new(-2.6 + 0.3 * c3, -0.9 * s3, -2.7 * c3)]
}
