//! The analyses as methods of every mechanism.

use crate::cross_check::{CrossCheck, CrossCheckOptions};
use crate::error::{SolveError, SweepError};
use crate::mechanism::{LengthError, Mechanism};
use crate::mobility::Mobility;
use crate::model::Pattern;
use crate::plan::ModeInfo;
use crate::series::Derivatives;
use crate::signal::Instant;
use crate::solver::Solver;
use crate::state::State;
use crate::trajectory::Trajectory;
use nalgebra::{DMatrix, DVector};

/// The analyses under their usual names, for every mechanism. Each calls a method of a [`Solver`] with default options,
/// which describes it and its errors.
pub trait Kinematics: Mechanism {
    /// A solver with default options and the mechanism's own guesses.
    fn solver(&self) -> Solver<'_, Self> {
        Solver::new(self)
    }

    /// The assembly modes: groups that close in two ways, distinguished by a sign. [`Solver::modes`] gives the signs of
    /// a configuration, [`Solver::with_mode`] prescribes one.
    fn modes() -> &'static [ModeInfo] {
        Self::model().plan.modes
    }

    /// q from [`Solver::position`].
    fn position_analysis(&self, at: &Instant<'_>, start: &[f64]) -> Result<Vec<f64>, SolveError> {
        Ok(self.solver().position(at, start)?.q)
    }

    /// [`Solver::velocity`].
    fn velocity_analysis(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, SolveError> {
        self.solver().velocity(at, q)
    }

    /// [`Solver::acceleration`].
    fn acceleration_analysis(&self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<Vec<f64>, SolveError> {
        self.solver().acceleration(at, q, q_dot)
    }

    /// [`Solver::state`].
    fn state_at(&self, at: &Instant<'_>) -> Result<State, SolveError> {
        self.solver().state(at)
    }

    /// [`Solver::sweep`].
    fn kinematic_analysis(&self, times: &[f64]) -> Result<Trajectory, SweepError> {
        self.solver().sweep(times)
    }

    /// [`Solver::derivatives`].
    fn derivatives(&self, state: &State, order: usize) -> Result<Derivatives, SolveError> {
        self.solver().derivatives(state, order)
    }

    /// [`Solver::mobility`].
    fn mobility(&self, at: &Instant<'_>, q: &[f64]) -> Result<Mobility, SolveError> {
        self.solver().mobility(at, q)
    }

    /// δ = n − rank of all rows but the driving ones, from [`Solver::mobility`].
    fn degrees_of_freedom(&self, at: &Instant<'_>, q: &[f64]) -> Result<usize, SolveError> {
        Ok(self.solver().mobility(at, q)?.degrees_of_freedom)
    }

    /// [`Solver::cross_check`].
    fn cross_check(&self) -> Result<CrossCheck, SolveError> {
        self.solver().cross_check(&CrossCheckOptions::default())
    }

    /// Φ(q, t) as a vector of s numbers, one per row.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn constraints_dense(&self, at: &Instant<'_>, q: &[f64]) -> Result<DVector<f64>, LengthError> {
        Ok(DVector::from_column_slice(self.constraints(at, q)?.as_ref()))
    }

    /// Φ_q(q, t) as an s×n matrix.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn jacobian_dense(&self, at: &Instant<'_>, q: &[f64]) -> Result<DMatrix<f64>, LengthError> {
        Ok(dense(&Self::model().constraint_pattern, Self::COORDINATES, self.jacobian(at, q)?.as_ref()))
    }

    /// Φ_t(q, t) as a vector of s numbers; ν = −Φ_t.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn time_derivative_dense(&self, at: &Instant<'_>, q: &[f64]) -> Result<DVector<f64>, LengthError> {
        Ok(DVector::from_column_slice(self.time_derivative(at, q)?.as_ref()))
    }

    /// γ(q, q̇, t) as a vector of s numbers.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn gamma_dense(&self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<DVector<f64>, LengthError> {
        Ok(DVector::from_column_slice(self.gamma(at, q, q_dot)?.as_ref()))
    }
}

impl<M: Mechanism> Kinematics for M {}

/// The dense form of a matrix given by its non-zeros.
fn dense(pattern: &Pattern, columns: usize, non_zeros: &[f64]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(pattern.rows, columns);
    for (&(row, column), &value) in pattern.entries.iter().zip(non_zeros) {
        matrix[(row, column)] += value;
    }
    matrix
}
