//! Transmission angles.

/// The angle at a revolute joint between the lines to the next joints of its two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TransmissionAngle {
    /// The revolute joint.
    pub joint: &'static str,
    /// The neighbouring joint on its first body, and the one on its second.
    pub between: [&'static str; 2],
    /// The angle, in [0, π]; force is transmitted best at π/2.
    pub angle: f64,
}

impl TransmissionAngle {
    /// Deviation from the best, |angle − π/2|, in [0, π/2].
    pub fn deviation(&self) -> f64 {
        (self.angle - core::f64::consts::FRAC_PI_2).abs()
    }
}
