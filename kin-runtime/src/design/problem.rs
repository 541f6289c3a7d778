//! Misses and slacks as functions of the variables: what searches and descents work on.

use super::follow::{DescentBranch, DesignMotion, Family};
use super::objective::{Objective, Requirement};
use super::task::Task;
use crate::error::SolveError;

/// A task for the mechanisms of one type. Searches of all types are compiled once, in this crate.
#[derive(Clone, Copy)]
pub(crate) struct Problem<'p> {
    pub(crate) family: &'p dyn Family,
    pub(crate) task: &'p Task,
    /// Is asked at every evaluation whether the search has been stopped; evaluations then fail.
    pub(crate) is_stopped: Option<&'p (dyn Fn() -> bool + Sync)>,
}

impl<'p> Problem<'p> {
    /// The motion with these variables.
    pub(crate) fn motion(&self, variables: &[f64], branch: &'p DescentBranch) -> DesignMotion<'p> {
        DesignMotion::new(self.family, self.task, variables, branch)
    }

    /// An error if the search has been stopped.
    pub(super) fn go_on(&self) -> Result<(), SolveError> {
        match self.is_stopped.is_some_and(|is_stopped| is_stopped()) {
            true => Err(SolveError::Stopped { t: 0.0, done: 0, total: 0 }),
            false => Ok(()),
        }
    }

    /// The sum of squares of the wanted values, relative to which errors are compared.
    pub(crate) fn wanted(&self) -> f64 {
        self.task.objectives.iter().flat_map(Objective::weighted).map(|value| value * value).sum()
    }

    /// The largest of the wanted values.
    pub(crate) fn size(&self) -> f64 {
        self.task.objectives.iter().flat_map(Objective::weighted).map(f64::abs).fold(0.0, f64::max)
    }

    /// Whether an objective is to be least and is no sum of squares.
    pub(crate) fn is_least(&self) -> bool {
        self.task.objectives.iter().any(|objective| matches!(objective.wanted, Requirement::Least(_)))
    }
}
