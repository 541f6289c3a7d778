//! A design without its mechanism's type: what searches and descents work on, so that they are compiled once, in this crate.

use super::builder::Design;
use super::follow::Branch;
use super::motion::Evaluated;
use super::objective::{Objective, Wanted};
use super::variables::Free;
use crate::error::SolveError;
use crate::mechanism::Mechanism;

/// Misses and slacks as functions of the variables.
pub(crate) trait Problem: Sync {
    fn free(&self) -> &[Free];
    fn objectives(&self) -> &[Objective];
    /// All misses and slacks, with derivatives if `slopes`.
    ///
    /// # Errors
    /// Why the mechanism does not assemble all the way.
    fn evaluate(&self, variables: &[f64], branch: &Branch, slopes: bool) -> Result<Evaluated, SolveError>;
}

impl<M: Mechanism> Problem for Design<M> {
    fn free(&self) -> &[Free] {
        &self.free
    }

    fn objectives(&self) -> &[Objective] {
        &self.objectives
    }

    fn evaluate(&self, variables: &[f64], branch: &Branch, slopes: bool) -> Result<Evaluated, SolveError> {
        self.evaluated(variables, branch, slopes)
    }
}

impl dyn Problem + '_ {
    /// The sum of squares of the wanted values, relative to which errors are compared.
    pub(crate) fn wanted(&self) -> f64 {
        self.objectives().iter().flat_map(Objective::weighted).map(|value| value * value).sum()
    }

    /// The largest of the wanted values.
    pub(crate) fn size(&self) -> f64 {
        self.objectives().iter().flat_map(Objective::weighted).map(f64::abs).fold(0.0, f64::max)
    }

    /// Whether an objective is to be least and is no sum of squares.
    pub(crate) fn is_least(&self) -> bool {
        self.objectives().iter().any(|objective| matches!(objective.wanted, Wanted::Least(_)))
    }
}
