//! Globalised Newton iteration for r(q) = 0 with any number of rows, independent of time and mechanisms.
//!
//! Each iteration takes the full Newton step (the step of least norm where there are fewer rows than coordinates) if it
//! stays within the trust region and reduces the residual as the linear model predicts. Otherwise it takes the
//! Levenberg–Marquardt step
//!
//! ```text
//! (DᵀJᵀJD + λ) y = −DᵀJᵀr,   δq = D y,
//! ```
//!
//! with λ such that the largest scaled displacement is about the radius. The iteration has converged when r is within
//! tolerance *and* no longer decreases, so that a double root at the end of a range of motion is as accurate as
//! rounding allows.

use crate::linear::{Factorization, scale_columns};
use nalgebra::{Cholesky, DMatrix, DVector};

/// Residual rows r with their Jacobian J; rows are on a common scale, columns in their own units.
pub(crate) trait Residual {
    /// Evaluates r and J at q; false when a result is not finite.
    fn evaluate(&mut self, q: &[f64]) -> bool;
    /// r of the last evaluation.
    fn residual(&self) -> DVector<f64>;
    /// J of the last evaluation.
    fn jacobian(&self) -> DMatrix<f64>;
    /// J x, with J of the last evaluation.
    fn times(&self, x: &DVector<f64>) -> DVector<f64> {
        self.jacobian() * x
    }
    /// The factorisation of J D of the last evaluation, for solutions; pivots below `tolerance` times the largest count
    /// as zero.
    fn factorise(&mut self, tolerance: f64) -> Factorization {
        Factorization::quick(&self.jacobian(), self.columns(), tolerance)
    }
    /// The diagonal of D: the scale of every column.
    fn columns(&self) -> &[f64];
}

/// Parameters of the iteration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NewtonSettings {
    pub(crate) max_iterations: usize,
    /// Largest |r| that counts as zero.
    pub(crate) tolerance: f64,
    /// Initial radius of the trust region.
    pub(crate) trust_radius: f64,
    /// Pivots below this multiple of the largest count as zero.
    pub(crate) rank_tolerance: f64,
}

/// The result of the iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Iteration {
    /// True if r is zero within tolerance.
    pub(crate) converged: bool,
    pub(crate) iterations: usize,
    /// Largest |r| at the end.
    pub(crate) gap: f64,
    /// The row with the largest |r|.
    pub(crate) worst: usize,
}

/// Length of a step after which the error is below machine precision, if convergence is quadratic, or cannot be reduced
/// further.
const LAST_STEP: f64 = 1e-9;
/// Relative reduction of the residual over [`SLOW_ITERATIONS`] iterations below which the point counts as a local
/// minimum.
const MIN_PROGRESS: f64 = 1e-3;
const SLOW_ITERATIONS: usize = 12;
const LARGEST_RADIUS: f64 = 2.0;
/// Reduction of the residual by one full step that only steps near a root bring about.
const CONTRACTION: f64 = 1e-3;
/// Residuals above this never count as zero, however large the coordinates are.
const LARGEST_ROUNDING: f64 = 1e-6;

/// Iterates from `q` and leaves the best point found there.
pub(crate) fn solve(problem: &mut dyn Residual, q: &mut [f64], settings: &NewtonSettings) -> Iteration {
    let mut outcome = Iteration { converged: false, iterations: 0, gap: f64::INFINITY, worst: 0 };
    if !problem.evaluate(q) {
        return outcome;
    }
    let mut residual = problem.residual();
    (outcome.worst, outcome.gap) = largest(&residual);
    let mut radius = settings.trust_radius;
    let mut history = vec![residual.norm()];
    let mut contracts = false;
    let mut trial = q.to_vec();
    while outcome.iterations < settings.max_iterations {
        outcome.converged = is_closed(problem, settings, q, &residual, contracts);
        if outcome.gap == 0.0 {
            return outcome;
        }
        let newton = -problem.factorise(settings.rank_tolerance).solve(&residual);
        let newton_change = problem.times(&newton);
        let mut levenberg: Option<(DMatrix<f64>, Levenberg)> = None;
        loop {
            outcome.iterations += 1;
            let newton_fits = size(&newton, problem.columns()) <= radius;
            let (step, change) = if newton_fits {
                (newton.clone(), newton_change.clone())
            } else {
                let (jacobian, levenberg) = levenberg.get_or_insert_with(|| {
                    // The last evaluation may have been at a rejected trial point.
                    problem.evaluate(q);
                    let jacobian = problem.jacobian();
                    let levenberg = Levenberg::new(&jacobian, &residual, problem.columns());
                    (jacobian, levenberg)
                });
                let step = levenberg.step(radius, problem.columns());
                let change = &*jacobian * &step;
                (step, change)
            };
            let length = size(&step, problem.columns());
            trial.iter_mut().zip(q.iter()).zip(step.iter()).for_each(|((t, q), s)| *t = q + s);
            let predicted = 0.5 * (residual.norm_squared() - (&residual + change).norm_squared());
            let finite = length.is_finite() && problem.evaluate(&trial);
            let new = if finite { problem.residual() } else { residual.clone() };
            let (worst, gap) = largest(&new);
            let ratio = if finite {
                0.5 * (residual.norm_squared() - new.norm_squared()) / predicted.max(f64::MIN_POSITIVE)
            } else {
                -1.0
            };
            if outcome.converged && (ratio < 1e-4 || gap >= outcome.gap) {
                return outcome;
            }
            if ratio >= 1e-4 {
                q.copy_from_slice(&trial);
                let improved = gap <= 0.5 * outcome.gap;
                contracts |= newton_fits && gap <= CONTRACTION * outcome.gap;
                (outcome.worst, outcome.gap) = (worst, gap);
                residual = new;
                let closed = is_closed(problem, settings, q, &residual, contracts);
                if closed && newton_fits && (length <= LAST_STEP || (outcome.converged && !improved)) {
                    outcome.converged = true;
                    return outcome;
                }
                if ratio > 0.75 && length > 0.5 * radius {
                    radius = (2.0 * radius).min(LARGEST_RADIUS);
                } else if ratio < 0.25 {
                    radius = 0.5 * length;
                }
                break;
            }
            radius = 0.25 * length.min(radius);
            if radius < 1e-15 || !radius.is_finite() || outcome.iterations >= settings.max_iterations {
                outcome.converged |= is_rounding(problem, q, &residual);
                return outcome;
            }
        }
        history.push(residual.norm());
        let before = history.len().checked_sub(SLOW_ITERATIONS + 1).map(|k| history[k]);
        let closed = is_closed(problem, settings, q, &residual, contracts);
        if !closed && before.is_some_and(|before| residual.norm() > (1.0 - MIN_PROGRESS) * before) {
            return Iteration { converged: false, ..outcome };
        }
    }
    outcome.converged = is_closed(problem, settings, q, &residual, contracts);
    outcome
}

/// True if every r is zero within tolerance. A row that is steeper here than on the common scale may be open by as much
/// more once a full step has reduced the residual as only steps near a root do: beside a pole of a row they halve it.
fn is_closed(
    problem: &dyn Residual,
    settings: &NewtonSettings,
    q: &[f64],
    residual: &DVector<f64>,
    contracts: bool,
) -> bool {
    let allowed = tolerance(settings, q, problem.columns());
    largest(residual).1 <= allowed || contracts && are_within(problem, residual, allowed)
}

/// True if every r at q, where no step reduces it any more, is as small as rounding of q makes it.
fn is_rounding(problem: &mut dyn Residual, q: &[f64], residual: &DVector<f64>) -> bool {
    // The last evaluation may have been at a rejected trial point.
    problem.evaluate(q) && are_within(problem, residual, rounding(farthest(q, problem.columns()).max(1.0)))
}

/// True if every r is at most `allowed` times the smallest entry of its row that is not 0, or times 1 where that is
/// larger.
fn are_within(problem: &dyn Residual, residual: &DVector<f64>, allowed: f64) -> bool {
    let jacobian = scale_columns(problem.jacobian(), problem.columns());
    let smallest = |row: usize| {
        let entries =
            jacobian.row(row).iter().map(|entry| entry.abs()).filter(|entry| *entry > 0.0).fold(f64::MAX, f64::min);
        if entries < f64::MAX { entries.max(1.0) } else { 1.0 }
    };
    residual.iter().enumerate().all(|(row, r)| r.abs() <= allowed * smallest(row))
}

/// The tolerance of the settings, but not below the effect of rounding in q.
fn tolerance(settings: &NewtonSettings, q: &[f64], columns: &[f64]) -> f64 {
    settings.tolerance.max(rounding(farthest(q, columns)))
}

/// The largest scaled coordinate.
fn farthest(q: &[f64], columns: &[f64]) -> f64 {
    q.iter().zip(columns).map(|(x, d)| (x / d).abs()).fold(0.0, f64::max)
}

/// The residual that rounding of coordinates of scaled size `far` causes, at most [`LARGEST_ROUNDING`].
pub(crate) fn rounding(far: f64) -> f64 {
    (16.0 * f64::EPSILON * far).min(LARGEST_ROUNDING)
}

/// The row and the size of the largest entry.
pub(crate) fn largest(residual: &DVector<f64>) -> (usize, f64) {
    residual.iter().enumerate().fold((0, 0.0), |best, (k, r)| if r.abs() > best.1 { (k, r.abs()) } else { best })
}

/// The largest scaled entry of a step.
fn size(step: &DVector<f64>, columns: &[f64]) -> f64 {
    let mut size = 0.0;
    for (x, d) in step.iter().zip(columns) {
        let scaled = (x / d).abs();
        if !scaled.is_finite() {
            return f64::INFINITY;
        }
        size = f64::max(size, scaled);
    }
    size
}

/// The damped normal equations at one iterate.
struct Levenberg {
    normal: DMatrix<f64>,
    gradient: DVector<f64>,
    damping: f64,
}

impl Levenberg {
    fn new(jacobian: &DMatrix<f64>, residual: &DVector<f64>, columns: &[f64]) -> Self {
        let scaled = scale_columns(jacobian.clone(), columns);
        let normal = scaled.tr_mul(&scaled);
        let gradient = scaled.tr_mul(residual);
        let damping = 1e-6 * normal.diagonal().amax().max(f64::MIN_POSITIVE);
        Self { normal, gradient, damping }
    }

    /// The damped step whose size is at most `radius`, and not much less where the damping limits it.
    fn step(&mut self, radius: f64, columns: &[f64]) -> DVector<f64> {
        let mut step = DVector::zeros(self.gradient.len());
        for _ in 0..60 {
            let mut damped = self.normal.clone();
            for k in 0..damped.nrows() {
                damped[(k, k)] += self.damping;
            }
            if let Some(factor) = Cholesky::new(damped) {
                step = -factor.solve(&self.gradient);
                step.iter_mut().zip(columns).for_each(|(s, d)| *s *= d);
                let length = size(&step, columns);
                if length <= radius {
                    return step;
                }
                self.damping *= (length / radius).clamp(1.5, 100.0);
            } else {
                self.damping *= 10.0;
            }
        }
        step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// tan x = 2.
    struct Tangent {
        x: f64,
    }

    impl Residual for Tangent {
        fn evaluate(&mut self, q: &[f64]) -> bool {
            self.x = q[0];
            self.x.tan().is_finite()
        }
        fn residual(&self) -> DVector<f64> {
            DVector::from_element(1, self.x.tan() - 2.0)
        }
        fn jacobian(&self) -> DMatrix<f64> {
            DMatrix::from_element(1, 1, 1.0 + self.x.tan() * self.x.tan())
        }
        fn columns(&self) -> &[f64] {
            &[1.0]
        }
    }

    /// Beside the pole the residual is small relative to the slope, which is no reason to stop.
    #[test]
    fn a_pole_is_no_root() {
        let settings =
            NewtonSettings { max_iterations: 200, tolerance: 1e-12, trust_radius: 1.0, rank_tolerance: 1e-12 };
        let start = std::f64::consts::FRAC_PI_2;
        for near in [1e-3, 1e-9, 1e-12, 1e-13, 1e-15] {
            let mut q = [start - near];
            let outcome = solve(&mut Tangent { x: 0.0 }, &mut q, &settings);
            assert!(!outcome.converged || (q[0].tan() - 2.0).abs() < 1e-11, "{near}: {q:?}");
            assert!(outcome.converged, "{near}: {outcome:?}");
        }
    }
}
