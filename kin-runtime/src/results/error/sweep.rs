//! A sweep that did not reach its end.

use super::SolveError;
use crate::trajectory::Trajectory;
use core::fmt;

/// A sweep that ended early: what went well, and why it ended.
#[derive(Clone, PartialEq)]
pub struct SweepError {
    /// The states of all instants before the one that failed, and the events until then.
    pub trajectory: Box<Trajectory>,
    /// Why there is no next one.
    pub source: SolveError,
}

impl SweepError {
    /// q at the limit itself, n numbers, where the motion ended at one that was located; its t and its kind are in
    /// [`SolveError::limit`].
    pub fn q_at_limit(&self) -> Option<&[f64]> {
        self.trajectory.q_at_limit.as_deref()
    }
}

/// Without the states, which would drown the reason.
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
