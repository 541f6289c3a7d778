//! Where segments meet.

use core::fmt;

/// A place where two segments of a [`Sequence`](super::Sequence) meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Junction {
    /// Where: the end of one segment and the start of the next.
    pub x: f64,
    /// Position, velocity and acceleration at the end of the one before.
    pub before: [f64; 3],
    /// Position, velocity and acceleration at the start of the next.
    pub after: [f64; 3],
}

impl Junction {
    pub(super) fn new(x: f64, before: [f64; 3], after: [f64; 3]) -> Self {
        Self { x, before, after }
    }

    /// By how much the velocity jumps.
    pub fn velocity_jump(&self) -> f64 {
        self.after[1] - self.before[1]
    }

    /// By how much the acceleration jumps.
    pub fn acceleration_jump(&self) -> f64 {
        self.after[2] - self.before[2]
    }
}

/// Where, and what jumps.
impl fmt::Display for Junction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at x = {}: velocity jumps by {}, ", self.x, self.velocity_jump())?;
        write!(f, "acceleration by {}", self.acceleration_jump())
    }
}
