//! One descent: bounded nonlinear least squares by `basin`, with a term for every condition.
//!
//! The first descents use a bounded Levenberg–Marquardt method, which solves normal equations and is fast; the last
//! ones the trust-region-reflective method, which uses the singular value decomposition of the Jacobian and converges
//! in flat valleys and at bounds, too, where the other method stalls. With many variables the decomposition takes a
//! hundred times as long, and all descents use the first method.
//!
//! A slack c adds the residual √τ/c: it keeps c positive at every step and vanishes with τ. Where a slack is not
//! positive or the mechanism does not assemble, residuals are NaN, and the trust region shrinks.

use super::follow::DescentBranch;
use super::motion::Evaluated;
use super::problem::Problem;
use basin::{
    BoundedLevenbergMarquardt, BoxBounds, ConstraintDescription, ConstraintSet, Constraints, CostFunction, DenseMatrix,
    Executor, Jacobian, Residual, TrustRegionReflective,
};
use core::convert::Infallible;

/// An error below this share of the sum of squares of the wanted values counts as 0.
pub(crate) const NOTHING: f64 = 1e-24;

/// How far a descent goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DescentLimits {
    /// The terms of conditions at the start of a descent, as shares of the sum of squares, one descent after the other;
    /// 0 leaves the terms out.
    pub(crate) shares: &'static [f64],
    /// Largest number of steps for each of them.
    pub(crate) steps: u64,
    /// The relative change of the sum of squares that ends it.
    pub(crate) change: f64,
    /// Largest number of variables for which the trust-region-reflective method is used.
    pub(crate) reflective: usize,
    /// For an objective that is no sum of squares: how far around the start designs are tried at first.
    pub(crate) spread: f64,
}

/// To select the random designs that are worth a descent.
pub(crate) const SELECTION: DescentLimits =
    DescentLimits { shares: &[1e-2], steps: 12, change: 1e-3, reflective: 0, spread: 0.1 };
/// To select the starts that are worth further descents.
pub(crate) const FIRST: DescentLimits =
    DescentLimits { shares: &[1e-2, 1e-6], steps: 60, change: 1e-4, reflective: 0, spread: 0.1 };
/// To select the best of these.
pub(crate) const REFINEMENT: DescentLimits =
    DescentLimits { shares: &[1e-6, 1e-10], steps: 120, change: 1e-8, reflective: 0, spread: 0.03 };
/// To convergence.
pub(crate) const CONVERGENCE: DescentLimits =
    DescentLimits { shares: &[1e-6, 1e-10, 0.0], steps: 480, change: 1e-12, reflective: 12, spread: 0.003 };

/// The least squares problem of one branch.
struct Fit<'d> {
    design: Problem<'d>,
    branch: &'d DescentBranch,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// √τ.
    weight: f64,
    rows: usize,
}

/// The result of a descent.
#[derive(Clone, Debug)]
pub(crate) struct DescentEnd {
    pub(crate) variables: Vec<f64>,
    /// The sum of squared misses, plus the values that are to be least.
    pub(crate) error: f64,
    pub(crate) branch: DescentBranch,
}

/// The sum of squared misses of a design that keeps all conditions, plus the values that are to be least.
pub(crate) fn error(design: Problem<'_>, variables: &[f64], branch: &DescentBranch) -> Option<f64> {
    let evaluated = design.evaluate(variables, branch, false).ok()?;
    let conditions_hold = evaluated.slacks.iter().all(|slack| slack.value > 0.0);
    let error = evaluated.misses.iter().map(|row| row.value * row.value).sum::<f64>() + evaluated.least;
    (conditions_hold && error.is_finite()).then_some(error)
}

/// Descends from a design that keeps all conditions.
pub(crate) fn descend(design: Problem<'_>, start: DescentEnd, effort: DescentLimits) -> DescentEnd {
    let mut end = start;
    let nothing = NOTHING * design.wanted();
    for share in effort.shares {
        if end.error <= nothing {
            break;
        }
        let Ok(evaluated) = design.evaluate(&end.variables, &end.branch, false) else { return end };
        let terms: f64 = evaluated.slacks.iter().map(|slack| slack.value.powi(-2)).sum();
        let weight = if terms > 0.0 { (share * end.error / terms).sqrt() } else { 0.0 };
        let rows = evaluated.misses.len() + evaluated.slacks.len();
        let count = end.variables.len();
        let (lower, upper) = (vec![0.0; count], vec![1.0; count]);
        let fit = Fit { design, branch: &end.branch, lower, upper, weight, rows };
        let start = end.variables.clone();
        // Bounds of 0 and 1 are always consistent; with an error of the solver the design stays as it is.
        let reached = if count <= effort.reflective {
            let solver = TrustRegionReflective::new()
                .with_absolute_scaled_gradient_tolerance(0.0)
                .with_relative_cost_change_tolerance(effort.change);
            let run = Executor::from_start(fit, solver, start).max_iter(effort.steps);
            run.target_objective(0.5 * nothing).run().map(|result| result.param().clone()).ok()
        } else {
            let solver = BoundedLevenbergMarquardt::new()
                .with_absolute_scaled_gradient_tolerance(0.0)
                .with_relative_cost_change_tolerance(effort.change);
            let run = Executor::from_start(fit, solver, start).max_iter(effort.steps);
            run.target_objective(0.5 * nothing).run().map(|result| result.param().clone()).ok()
        };
        let Some(variables) = reached else { return end };
        match error(design, &variables, &end.branch) {
            Some(error) if error <= end.error || *share > 0.0 => {
                end = DescentEnd { variables, error, branch: end.branch }
            }
            _ => {}
        }
    }
    end
}

impl Fit<'_> {
    /// Misses, then the terms of the conditions; none where a slack is not positive.
    fn evaluated(&self, variables: &[f64], slopes: bool) -> Option<Evaluated> {
        let evaluated = self.design.evaluate(variables, self.branch, slopes).ok()?;
        let complete = evaluated.misses.len() + evaluated.slacks.len() == self.rows;
        (complete && evaluated.slacks.iter().all(|slack| slack.value > 0.0)).then_some(evaluated)
    }

    fn residuals(&self, evaluated: Option<&Evaluated>) -> Vec<f64> {
        let Some(evaluated) = evaluated else { return vec![f64::NAN; self.rows] };
        let misses = evaluated.misses.iter().map(|row| row.value);
        misses.chain(evaluated.slacks.iter().map(|slack| self.weight / slack.value)).collect()
    }

    fn matrix(&self, evaluated: Option<&Evaluated>) -> DenseMatrix {
        let columns = self.lower.len();
        let Some(evaluated) = evaluated else {
            return DenseMatrix::from_row_slice(self.rows, columns, &vec![f64::NAN; self.rows * columns]);
        };
        let misses = evaluated.misses.iter().flat_map(|row| row.by.iter().copied());
        let slacks = evaluated.slacks.iter().flat_map(|slack| {
            let slope = -self.weight / (slack.value * slack.value);
            slack.by.iter().map(move |by| slope * by)
        });
        let entries: Vec<f64> = misses.chain(slacks).collect();
        DenseMatrix::from_row_slice(self.rows, columns, &entries)
    }
}

impl Constraints for Fit<'_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl CostFunction for Fit<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, variables: &Vec<f64>) -> Result<f64, Infallible> {
        let residuals = self.residuals(self.evaluated(variables, false).as_ref());
        Ok(0.5 * residuals.iter().map(|residual| residual * residual).sum::<f64>())
    }
}

impl Residual for Fit<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Error = Infallible;

    fn residual(&self, variables: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        Ok(self.residuals(self.evaluated(variables, false).as_ref()))
    }
}

impl Jacobian for Fit<'_> {
    type Jacobian = DenseMatrix;

    fn jacobian(&self, variables: &Vec<f64>) -> Result<DenseMatrix, Infallible> {
        Ok(self.matrix(self.evaluated(variables, true).as_ref()))
    }

    fn residual_and_jacobian(&self, variables: &Vec<f64>) -> Result<(Vec<f64>, DenseMatrix), Infallible> {
        let evaluated = self.evaluated(variables, true);
        Ok((self.residuals(evaluated.as_ref()), self.matrix(evaluated.as_ref())))
    }
}
