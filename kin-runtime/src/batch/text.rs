//! Display of batches.

#[cfg(feature = "std")]
use super::SensitivitySolutions;
use super::{
    Column, Configurations, End, Evaluations, ForceSolutions, Modes, Moment, Motions, Problems, Progress, Solutions,
    Sweeps,
};
use crate::mechanism::Mechanism;
use crate::text::{counted, number, numbers};
use core::fmt;

/// The shared number, or the number of entries.
impl fmt::Display for Column<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shared(value) => number(f, value),
            Self::Each(values) => counted(f, values.len(), "number"),
        }
    }
}

impl fmt::Display for Configurations<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "configurations of {} coordinates at t = {}", self.q.len(), self.t)
    }
}

impl fmt::Display for Problems<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "problems of {} coordinates at t = {}, modes {}", self.start.len(), self.t, self.modes)
    }
}

impl fmt::Display for Modes<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Signs(columns) => write!(f, "by {} columns of signs", columns.len()),
            Self::OfStart => f.write_str("of the start"),
        }
    }
}

impl fmt::Display for Sweeps<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("sweeps over ").and_then(|()| counted(f, self.times.len(), "instant"))?;
        write!(f, ", modes {}", self.modes)
    }
}

/// `12 of 100 configurations`.
impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} configurations", self.done, self.total)
    }
}

/// The instant and the reason.
impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ended at instant {}: ", self.instant)?;
        match &self.limit {
            Some(limit) => limit.fmt(f),
            None => f.write_str(
                "a number is not finite, a length is negative, the motion jumps, or an iteration leads away from its start",
            ),
        }
    }
}

/// The instant and q, q̇, q̈ in lanes.
impl fmt::Display for Moment<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "sets from {} on at t = {}, q = ", self.first, self.t)?;
        numbers(f, self.q)?;
        f.write_str(", q̇ = ")?;
        numbers(f, self.q_dot)?;
        f.write_str(", q̈ = ")?;
        numbers(f, self.q_ddot)
    }
}

/// The number of motions that reached the last instant.
impl<S> fmt::Display for Motions<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let whole = self.ends().filter(Option::is_none).count();
        write!(f, "{whole} of {} motions complete", self.count())
    }
}

/// The number of solved configurations.
impl<M: Mechanism> fmt::Display for Solutions<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let solved = self.solved().filter(|solved| *solved).count();
        write!(f, "{}: {solved} of {} configurations solved", M::model().name, self.count())
    }
}

/// The number of evaluations.
impl<M: Mechanism> fmt::Display for Evaluations<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", M::model().name)?;
        counted(f, self.count(), "evaluation")
    }
}

impl<M: Mechanism> fmt::Display for ForceSolutions<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("forces of ").and_then(|()| counted(f, self.count(), "configuration"))
    }
}

#[cfg(feature = "std")]
impl fmt::Display for SensitivitySolutions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("sensitivities of ").and_then(|()| counted(f, self.count(), "configuration"))
    }
}
