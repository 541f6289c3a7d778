//! Source: constructed for the laws; there are no published numbers.

use kin_runtime::mechanism;

/// A beam that swings carries a carriage on a screw, and a motor on the beam turns the nut.
#[mechanism]
#[bodies(beam, carriage, nut)]
#[revolute(O: ground @ (0.1, 0), beam @ (0, -0.05))]
#[translational(guide: beam @ (0, 0.1), carriage @ (0.02, 0), axis = (2, 0.5), angle = 0.1)]
#[screw(thread: beam @ (0, 0.1), carriage @ (0.02, 0), axis = (2, 0.5), lead = lead, nut = nut, offset = 0.2)]
#[revolute(N: beam @ (0.6, 0.1), nut @ (0.01, 0))]
#[driver(swing: beam.phi = 0.3 * sin(1.3 * t))]
#[relative_angle(turn: beam, nut = 4 * t + sin(2 * t))]
pub struct ScrewBeam {
    /// Travel of the carriage per turn
    #[param(0.04, unit = "m")]
    pub lead: f64,
}
