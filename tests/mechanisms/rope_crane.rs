//! Source: constructed for the laws; there are no published numbers.

use kin_runtime::mechanism;

/// A trolley on a rail from which a hook hangs on two strands of a rope; a winch in the ground pulls the rope in.
#[mechanism]
#[bodies(trolley, hook)]
#[point(eye = hook @ (0.03, 0.1))]
#[translational(rail: ground @ (0, 2), trolley @ (0, 0.02), axis = (1, 0))]
#[translational(mast: trolley @ (0, 0), hook @ (0, 0), axis = (0, 1), angle = 0.1)]
#[rope(tackle: trolley @ (-0.1, 0), eye, trolley @ (0.12, 0), ground @ (winch, 2.1), length = 4 + 0.2 * sin(2 * t))]
#[driver(drive: trolley.x = 0.3 * t + 0.05 * t * t)]
#[guess(hook.y = 1.3)]
pub struct RopeCrane {
    /// Place of the winch
    #[param(3, unit = "m")]
    pub winch: f64,
}
