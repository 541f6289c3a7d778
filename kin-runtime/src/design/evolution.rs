//! The descent for an objective that is to be least and is no sum of squares: the evolution strategy with covariance
//! matrix adaptation of N. Hansen (The CMA Evolution Strategy: A Tutorial, 2016), as implemented by the crate `basin`.
//!
//! It needs no derivatives, so that the objective may be the greatest of several numbers. Every generation draws
//! designs around the best of the one before, in a large region at first and in smaller and smaller ones later, so that
//! a descent can leave a local minimum. A design that breaks a condition or does not assemble counts as worse than the
//! start.

use super::fit::{DescentEnd, DescentLimits, error};
use super::follow::DescentBranch;
use super::problem::Problem;
use basin::{
    BoundedCmaEs, BoxBounds, ConstraintDescription, ConstraintSet, Constraints, CostFunction, DenseMatrix, Executor,
};
use core::convert::Infallible;

/// A descent ends when the distribution of designs is no wider than this.
const CONVERGED_WIDTH: f64 = 1e-9;

/// The objective as a function of the variables.
struct Landscape<'d> {
    design: Problem<'d>,
    branch: &'d DescentBranch,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// The value of a design that breaks a condition.
    worst: f64,
}

/// Improves a design that keeps all conditions, generation by generation; the start where none is better.
pub(super) fn evolve(design: Problem<'_>, start: DescentEnd, effort: DescentLimits) -> DescentEnd {
    let count = start.variables.len();
    let size = if start.error == 0.0 { 1.0 } else { start.error.abs() };
    let worst = start.error + 10.0 * size;
    let (lower, upper) = (vec![0.0; count], vec![1.0; count]);
    let landscape = Landscape { design, branch: &start.branch, lower, upper, worst };
    // The seed is taken from the start, so that the same start has the same descent.
    let solver = BoundedCmaEs::<Vec<f64>, DenseMatrix>::new(start.error.to_bits(), effort.spread)
        .with_absolute_distribution_size_tolerance(CONVERGED_WIDTH);
    let run = Executor::from_start(landscape, solver, start.variables.clone()).max_iter(effort.steps).run();
    let Ok(variables) = run.map(|result| result.best_param().clone()) else { return start };
    match error(design, &variables, &start.branch) {
        Some(error) if error < start.error => DescentEnd { variables, error, branch: start.branch },
        _ => start,
    }
}

impl Constraints for Landscape<'_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl CostFunction for Landscape<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, variables: &Vec<f64>) -> Result<f64, Infallible> {
        Ok(error(self.design, variables, self.branch).unwrap_or(self.worst))
    }
}
