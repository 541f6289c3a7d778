//! Designs in words.

use super::task::Task;
use super::{Design, Direction, Search, Shortest, Slack};
use crate::mechanism::Mechanism;
use core::fmt;

/// The numbers of free parameters, objectives and conditions.
impl<M: Mechanism> fmt::Display for Design<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Task { model, free, objectives, conditions, .. } = &self.task;
        let (name, [free, objectives, conditions]) = (model.name, [free.len(), objectives.len(), conditions.len()]);
        write!(f, "design of {name}: {free} free parameters, {objectives} objectives, {conditions} conditions")
    }
}

/// `forward`, `backward` or `either`, as the command line takes it.
impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
            Self::Either => "either",
        })
    }
}

/// The name of the link.
impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ground => "ground",
            Self::Crank => "crank",
            Self::Coupler => "coupler",
            Self::Rocker => "rocker",
        })
    }
}

impl fmt::Display for Search<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "search from {} starts, seed {}", self.starts, self.seed)
    }
}

/// `P.x in -4..4: slack 2.500e-1 at t = 1.2`.
impl fmt::Display for Slack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: slack {:.3e}", self.condition, self.slack)?;
        self.at.map_or(Ok(()), |t| write!(f, " at t = {t:.6}"))
    }
}
