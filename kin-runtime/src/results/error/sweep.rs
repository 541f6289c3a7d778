//! A sweep that did not reach its end.

use super::SolveError;
use crate::trajectory::Trajectory;
use core::fmt;

/// A sweep that ended early: the states up to there, and the reason.
#[derive(Clone, PartialEq)]
pub struct SweepError {
    /// The states of all instants before the one that failed, and the events until then.
    pub trajectory: Box<Trajectory>,
    /// The reason why there is no next state.
    pub source: SolveError,
}

impl SweepError {
    /// q at the limit itself, n numbers, if the motion ended at a limit that was located; [`SolveError::limit`] has its
    /// t and its kind.
    pub fn q_at_limit(&self) -> Option<&[f64]> {
        self.trajectory.q_at_limit.as_deref()
    }
}

/// Without the states, so that the reason is easy to find.
impl fmt::Debug for SweepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SweepError")
            .field("good_instants", &self.trajectory.reached)
            .field("source", &self.source)
            .finish_non_exhaustive()
    }
}

impl fmt::Display for SweepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let good = self.trajectory.reached;
        write!(f, "{} (after {good} good {})", self.source, if good == 1 { "instant" } else { "instants" })
    }
}

impl core::error::Error for SweepError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.source)
    }
}
