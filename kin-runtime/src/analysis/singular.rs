//! Distinguishes singular configurations from permanent redundancy.
//!
//! If the rank of Φ_q is lower than its size allows, either rows are redundant in every configuration, or this
//! configuration is special. To decide, the mechanism is moved a little along null vectors of the rows of position
//! level that do not drive, closed again on these rows alone, and the rank of all rows there is compared. A Φ_q of full
//! row rank or full column rank is never singular.
//!
//! Rows of velocity level may also lose rank because of inputs or time, in every configuration. If no velocity
//! satisfies them, the rank at other inputs and times shows whether this instant is special.

use crate::analysis::by_plan;
use crate::analysis::subsystem_residual::close;
use crate::equations::Equations;
use crate::equations::geometry::without_length;
use crate::error::SolveError;
use crate::linear::{Factorization, null_space};
use crate::random::Random;
use crate::workspace::Subset;
use nalgebra::DVector;

/// Distances of the probes, on the common scale.
const DISTANCES: [f64; 2] = [1e-2, 5e-2];
/// Changes of inputs and time, relative to their values or to 1, whichever is larger.
const INPUT_CHANGES: [f64; 4] = [1e-2, -1e-2, 0.1, -0.1];
/// Largest number of null vectors that are tried one by one.
const DIRECTIONS: usize = 6;

/// The error if `q`, whose Φ_q was evaluated last and has the factorisation `factor`, is singular.
pub(crate) fn diagnose(equations: &mut Equations<'_>, q: &[f64], factor: &Factorization) -> Option<SolveError> {
    if let Some(error) = without_length(equations) {
        return Some(error);
    }
    let all: Vec<usize> = (0..equations.rows()).collect();
    let scaled = equations.scaled(&all);
    let expected_rank = rank_nearby(equations, q, factor.rank, &all);
    if expected_rank <= factor.rank {
        return None;
    }
    let tolerance = equations.options.rank_tolerance;
    let rows = dependent_rows(equations, &null_space(&scaled.transpose(), tolerance));
    let (t, rank, condition) = (equations.t, factor.rank, factor.full_condition);
    let limit = by_plan::limit(equations, q);
    Some(SolveError::Singular { t, rank, expected_rank, rows, condition, limit })
}

/// Replaces an inconsistency at `q` by [`SolveError::Singular`] if the driving rows have a higher rank at other inputs
/// or times.
pub(crate) fn explain(
    equations: &mut Equations<'_>,
    q: &[f64],
    factor: &Factorization,
    error: SolveError,
) -> SolveError {
    let inconsistent =
        matches!(error, SolveError::InconsistentVelocity { .. } | SolveError::InconsistentAcceleration { .. });
    if !inconsistent || factor.rank >= equations.rows().min(equations.coordinates()) {
        return error;
    }
    let rows: Vec<usize> = (0..equations.rows()).collect();
    if equations.evaluate(Subset::JACOBIAN, q, None).is_err() {
        return error;
    }
    let null_vectors = null_space(&equations.scaled(&rows).transpose(), equations.options.rank_tolerance);
    let expected_rank = rank_at_other_instants(equations, q, &rows);
    if expected_rank <= factor.rank {
        return error;
    }
    let rows = dependent_rows(equations, &null_vectors);
    let (t, rank, condition) = (equations.t, factor.rank, factor.full_condition);
    SolveError::Singular { t, rank, expected_rank, rows, condition, limit: by_plan::limit(equations, q) }
}

/// Largest rank of `rows` at q with other inputs and times. The rows that do not drive depend on neither.
fn rank_at_other_instants(equations: &mut Equations<'_>, q: &[f64], rows: &[usize]) -> usize {
    let (t, inputs) = (equations.t, equations.inputs.clone());
    let mut random = Random::new(0x0001_4b07);
    let mut best = 0;
    for change in INPUT_CHANGES {
        let mut moved = |value: f64| value + change * value.abs().max(1.0) * (1.5 + random.symmetric());
        equations.t = moved(t);
        equations.inputs.iter_mut().zip(&inputs).for_each(|(input, now)| input.value = moved(now.value));
        best = best.max(rank_at(equations, q, rows).unwrap_or(0));
    }
    (equations.t, equations.inputs) = (t, inputs);
    best
}

/// Names of the rows that take part in a dependency, given the left null vectors of the scaled Φ_q.
pub(crate) fn dependent_rows(equations: &Equations<'_>, null_vectors: &nalgebra::DMatrix<f64>) -> Vec<&'static str> {
    let largest = null_vectors.amax();
    (0..null_vectors.nrows())
        .filter(|&i| null_vectors.row(i).amax() > 1e-3 * largest)
        .map(|i| equations.row_name(i))
        .collect()
}

/// True if Φ_q has a higher rank around `q` than at `q`. Leaves `equations` evaluated at another configuration.
pub(crate) fn is_rank_special(equations: &mut Equations<'_>, q: &[f64]) -> bool {
    let all: Vec<usize> = (0..equations.rows()).collect();
    rank_at(equations, q, &all).is_some_and(|rank| rank_nearby(equations, q, rank, &all) > rank)
}

/// Largest rank of `rows` at assembled configurations around `q`; stops at the first above `rank_at_q`.
pub(crate) fn rank_nearby(equations: &mut Equations<'_>, q: &[f64], rank_at_q: usize, rows: &[usize]) -> usize {
    let closing = equations.rows_where(|e, row| !e.drives(row) && e.holonomic(row));
    let columns: Vec<usize> = (0..equations.coordinates()).collect();
    // Rows of velocity level do not restrict positions.
    let free = null_space(&equations.scaled(&closing), equations.options.rank_tolerance);
    let mut random = Random::new(0x0051_4ea1);
    let mut directions: Vec<DVector<f64>> = free.column_iter().take(DIRECTIONS).map(|c| c.into_owned()).collect();
    for _ in 0..free.ncols().min(4) {
        let mix = DVector::from_fn(free.ncols(), |_, _| random.symmetric());
        directions.push((&free * mix).normalize());
    }
    let mut best = rank_at_q;
    let mut moved = false;
    for distance in DISTANCES {
        for direction in &directions {
            for sign in [distance, -distance] {
                let largest = direction.amax().max(f64::MIN_POSITIVE);
                let mut nearby = displaced(equations, q, |k| direction[k] * sign / largest);
                if !close(equations, &closing, &columns, &mut nearby).converged {
                    continue;
                }
                let travel: Vec<f64> = nearby.iter().zip(q).map(|(a, b)| a - b).collect();
                let travel = equations.scale.size(&travel);
                if travel > 0.1 * distance && travel < 10.0 * distance {
                    moved = true;
                    best = best.max(rank_at(equations, &nearby, rows).unwrap_or(0));
                }
                if best > rank_at_q {
                    return best;
                }
            }
        }
    }
    if !moved && !directions.is_empty() {
        // No null vector leads to another configuration: the structure is only infinitesimally movable. Any
        // perturbation shows its usual rank.
        for _ in 0..4 {
            let nearby = displaced(equations, q, |_| 1e-2 * random.symmetric());
            best = best.max(rank_at(equations, &nearby, rows).unwrap_or(0));
        }
    }
    best
}

/// q with a displacement added, given on the common scale.
fn displaced(equations: &Equations<'_>, q: &[f64], mut by: impl FnMut(usize) -> f64) -> Vec<f64> {
    q.iter().zip(&equations.scale.columns).enumerate().map(|(k, (x, d))| x + d * by(k)).collect()
}

/// Rank of `rows` at q.
fn rank_at(equations: &mut Equations<'_>, q: &[f64], rows: &[usize]) -> Option<usize> {
    equations.evaluate(Subset::JACOBIAN, q, None).ok()?;
    let matrix = equations.scaled_rows(rows);
    Some(Factorization::absolute(&matrix, &equations.scale.columns, equations.options.rank_tolerance).rank)
}
