//! Values of inputs that fit a guess, for a mechanism that does not close with its given inputs.
//!
//! Φ(q, u) = 0 has more unknowns than rows where inputs u are unknown, too. From the guess,
//!
//! ```text
//! [Φ_q S, Φ_u W] (S⁻¹ Δq, W⁻¹ Δu) = −Φ
//! ```
//!
//! is solved repeatedly with least norm, where S are the scales of the coordinates. W is large, so that mainly the
//! inputs move.

use crate::analysis::assemble::propagated;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::signal::Instant;
use crate::workspace::Subset;
use nalgebra::{DMatrix, DVector};

/// Largest number of iterations.
const ITERATIONS: usize = 60;
/// W: the weight of an input, relative to a coordinate and to the size of the input or of the mechanism.
const WEIGHT: f64 = 100.0;
/// Largest change of an angle in an iteration.
const MAX_TURN: f64 = 0.5;
/// Scaled residuals up to this count as closed.
const CLOSED: f64 = 1e-9;

/// Sets some inputs, given by their indices, to values with which the mechanism closes near its guess; true if it finds
/// such values. It starts at the values that the inputs have, and then at the size of the mechanism: a row may not tell
/// how to change an input that is 0, and may be satisfied by a negative length as well.
pub(crate) fn fit_inputs(
    equations: &mut Equations<'_>,
    guesses: &[Option<f64>],
    indices: &[usize],
) -> Result<bool, SolveError> {
    let q = propagated(equations, guesses);
    equations.scale = Scale::before_assembly(equations, &q);
    let size = equations.scale.columns.iter().fold(1.0, |size: f64, &column| size.max(column));
    let (t, given) = (equations.t, equations.inputs.clone());
    for start in [None, Some(size)] {
        equations.inputs.clone_from(&given);
        for &index in indices {
            equations.inputs[index].value = start.unwrap_or(given[index].value);
        }
        if fit_from(equations, q.clone(), indices, size)? {
            let inputs = equations.inputs.clone();
            if equations.set_instant(&Instant { t, inputs: &inputs }).is_ok() {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// [`fit_inputs`] from a configuration and the values that the inputs have. `size` is that of the mechanism.
fn fit_from(equations: &mut Equations<'_>, mut q: Vec<f64>, indices: &[usize], size: f64) -> Result<bool, SolveError> {
    let (n, rows) = (q.len(), equations.rows());
    let all: Vec<usize> = (0..rows).collect();
    // An input may be a length or an angle: its weight is at least 1 and the size of the mechanism.
    let weights: Vec<f64> = indices.iter().map(|&k| WEIGHT * equations.inputs[k].value.abs().max(size)).collect();
    for _ in 0..ITERATIONS {
        equations.evaluate(Subset { phi: true, ..Subset::VELOCITY }, &q, None)?;
        let right = DVector::from_fn(rows, |row, _| -equations.scale.rows[row] * equations.phi[row]);
        if right.amax() <= CLOSED {
            return Ok(true);
        }
        let by_q = equations.scaled(&all);
        let mut matrix = DMatrix::zeros(rows, n + indices.len());
        matrix.view_mut((0, 0), (rows, n)).copy_from(&by_q);
        for (k, &index) in indices.iter().enumerate() {
            let phi_u = equations.along(Some(index), |equations| {
                equations.evaluate(Subset::TIME_DERIVATIVE, &q, None)?;
                Ok(equations.phi_t.clone())
            })?;
            for row in 0..rows {
                matrix[(row, n + k)] = weights[k] * equations.scale.rows[row] * phi_u[row];
            }
        }
        let Ok(step) = matrix.svd(true, true).solve(&right, 1e-12) else { return Ok(false) };
        let most = step.rows(0, n).amax();
        let share = if most > MAX_TURN { MAX_TURN / most } else { 1.0 };
        q.iter_mut().enumerate().for_each(|(k, q)| *q += share * equations.scale.columns[k] * step[k]);
        for (k, &index) in indices.iter().enumerate() {
            equations.inputs[index].value += share * weights[k] * step[n + k];
        }
    }
    Ok(false)
}
