//! Events of unilateral conditions.

use crate::state::State;
use crate::text::number;
use core::fmt;

/// How a motion meets the limit of a unilateral condition, in the direction of the sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Crossing {
    /// Satisfied before, violated after.
    Violated,
    /// Violated before, satisfied after.
    Restored,
    /// The limit is reached within rounding but not passed: ġ = 0 there, and the sign of g is the same before and
    /// after.
    Touched,
}

impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Violated => "violated",
            Self::Restored => "satisfied again",
            Self::Touched => "touched",
        })
    }
}

/// A unilateral condition whose limit the motion meets, and when.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Event {
    /// Name of the condition.
    pub name: &'static str,
    /// Its index in [`Model::conditions`](crate::model::Model::conditions).
    pub condition: usize,
    /// Time.
    pub t: f64,
    /// How the limit is met.
    pub crossing: Crossing,
    /// Width of the interval of time around t in which the limit is met: at most 1e-10 for |t| up to 10⁴, relative to
    /// |t| beyond. Larger only where the motion cannot be solved closer to it.
    pub within: f64,
    /// The configuration at t.
    pub state: State,
}

/// A stretch of a sweep in which a unilateral condition changes too fast to be watched, or the motion could not be solved
/// between two instants: there the condition may have met its limit more often than the events say.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Unwatched {
    /// Name of the condition.
    pub name: &'static str,
    /// Its index in [`Model::conditions`](crate::model::Model::conditions).
    pub condition: usize,
    /// Time at which the stretch begins, in the direction of the sweep.
    pub from: f64,
    /// Time at which it ends.
    pub to: f64,
}

/// `limit was not watched from t = 0.3 to t = 0.4`.
impl fmt::Display for Unwatched {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} was not watched from t = ", self.name)?;
        number(f, &self.from)?;
        f.write_str(" to t = ")?;
        number(f, &self.to)
    }
}

/// `limit violated at t = 0.3`.
impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} at t = ", self.name, self.crossing)?;
        number(f, &self.t)
    }
}
