//! Position analysis: q with Φ(q, t) = 0 near a start.
//!
//! All rows of position level are closed at once by the globalised iteration of [`newton`](crate::nonlinear::newton).
//! With fewer rows than coordinates each correction has the least Euclidean norm; with more rows than coordinates, the
//! redundant ones must agree.

use crate::analysis::by_plan;
use crate::analysis::singular::is_rank_special;
use crate::analysis::subsystem_residual::close;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::nonlinear::newton::Iteration;
use crate::text::numbers;
use crate::workspace::Subset;
use core::fmt;

/// Largest residual, on the scale of the start, from which rows of small distances are closed again. Newton's iteration
/// may not find the last digits of these on that scale, because their part of Φ_q is within its rounding errors.
const NEARLY_CLOSED: f64 = 1e-6;

/// Ratio of the scales of a row after and before the assembly from which on it is closed again.
const SMALL_DISTANCE: f64 = 10.0;

/// An assembled position.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Position {
    /// q, n numbers.
    pub q: Vec<f64>,
    /// Number of iterations.
    pub iterations: usize,
    /// Largest |Φ_i|, in the rows' own units.
    pub residual: f64,
}

/// The assembled configuration near `start`.
pub(crate) fn position(equations: &mut Equations<'_>, start: &[f64]) -> Result<Position, SolveError> {
    equations.check("q", start)?;
    equations.scale = Scale::before_assembly(equations, start);
    let mut q = start.to_vec();
    let mut outcome = close_all(equations, &mut q);
    let origins = origins(equations);
    if !outcome.converged && !origins.is_empty() {
        // Angles determine the mode more reliably than origins: try once more with origins that fit the angles.
        let mut other = start.to_vec();
        let rows = equations.rows_where(Equations::holonomic);
        let before = close(equations, &rows, &origins, &mut other);
        let second = close_all(equations, &mut other);
        if second.converged || second.gap < outcome.gap {
            let iterations = outcome.iterations + before.iterations + second.iterations;
            (q, outcome) = (other, Iteration { iterations, ..second });
        }
    }
    finish(equations, q, outcome)
}

/// The coordinates that are x or y of a body.
fn origins(equations: &Equations<'_>) -> Vec<usize> {
    (0..equations.coordinates()).filter(|&k| equations.model.coordinates[k].kind.is_length()).collect()
}

/// Closes all rows of position level.
pub(crate) fn close_all(equations: &mut Equations<'_>, q: &mut [f64]) -> Iteration {
    let rows = equations.rows_where(Equations::holonomic);
    let columns: Vec<usize> = (0..equations.coordinates()).collect();
    close(equations, &rows, &columns, q)
}

/// Closes all rows again with the scale of the (nearly) assembled configuration q, where some rows count much more on that
/// scale: those of distances that are small compared with the rest of the mechanism.
fn close_small_distances(equations: &mut Equations<'_>, q: &mut [f64], outcome: Iteration) -> Iteration {
    let scale_at_q = Scale::around(equations, q);
    let counts_more = |(now, before): (&f64, &f64)| *now > SMALL_DISTANCE * before;
    if !scale_at_q.rows.iter().zip(&equations.scale.rows).any(counts_more) {
        return outcome;
    }
    equations.scale = scale_at_q;
    let second = close_all(equations, q);
    Iteration { iterations: outcome.iterations + second.iterations, ..second }
}

/// The outcome as a result: residuals in the rows' own units, or a typed error.
pub(crate) fn finish(
    equations: &mut Equations<'_>,
    mut q: Vec<f64>,
    mut outcome: Iteration,
) -> Result<Position, SolveError> {
    if outcome.gap <= NEARLY_CLOSED && equations.keeps_lengths() {
        outcome = close_small_distances(equations, &mut q, outcome);
    }
    // This evaluation fails with an error if a number is not finite at the best configuration found.
    equations.evaluate(Subset::POSITION, &q, None)?;
    if outcome.converged {
        let residual = largest_residual(equations);
        let still = vec![0.0; q.len()];
        equations.check_slopes([&q, &still, &still])?;
        return Ok(Position { q, iterations: outcome.iterations, residual });
    }
    if let Some(conflict) = given_conflict(equations) {
        // For a value out of reach the iteration ends where the coordinate cannot grow or shrink further. There its row
        // adds no rank, but it does nearby; the row of a coordinate that others determine adds none anywhere.
        if !is_rank_special(equations, &q) {
            return Err(conflict);
        }
        equations.evaluate(Subset::POSITION, &q, None)?;
    }
    let (residual, limit) = (equations.phi.get(outcome.worst).copied().unwrap_or(0.0), by_plan::limit(equations, &q));
    if let Some(undefined) = by_plan::undefined(equations, &q) {
        return Err(undefined);
    }
    Err(SolveError::NotAssembled {
        t: equations.t,
        gap: outcome.gap,
        residual,
        row: outcome.worst,
        row_name: equations.row_name(outcome.worst),
        joint: equations.joint_name(outcome.worst),
        iterations: outcome.iterations as u32,
        all_guessed: false,
        limit,
    })
}

/// The largest |Φ_i| of the rows of position level, where they were evaluated last.
pub(crate) fn largest_residual(equations: &Equations<'_>) -> f64 {
    let rows = equations.rows_where(Equations::holonomic);
    rows.iter().map(|&row| equations.phi[row].abs()).fold(0.0, f64::max)
}

/// The first prescribed coordinate whose row adds no rank, at the Jacobian evaluated last.
pub(crate) fn given_conflict(equations: &Equations<'_>) -> Option<SolveError> {
    let given = equations.given();
    if given == 0 {
        return None;
    }
    let declared = equations.rows() - given;
    let rank = |count: usize| {
        let rows: Vec<usize> = (0..count).collect();
        let columns = &equations.scale.columns;
        Factorization::revealing(&equations.scaled_rows(&rows), columns, equations.options.rank_tolerance).rank
    };
    let without = rank(declared);
    let k = (0..given).find(|k| rank(declared + k + 1) < without + k + 1)?;
    let (coordinate, value) = equations.given_value(k);
    let open = equations.coordinates() - without;
    Some(SolveError::GivenConflict { t: equations.t, coordinate, value, open, given })
}

/// q, the residual and the iterations.
impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("q = ")?;
        numbers(f, &self.q)?;
        write!(f, ", largest |Φ| {:.1e} after {} iterations", self.residual, self.iterations)
    }
}
