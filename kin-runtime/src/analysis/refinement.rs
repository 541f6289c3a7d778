//! Refinement of a solution of the plan near a limit of its formulas.
//!
//! There the plan may lose digits that the mechanism does not lose. A dyad whose rod is 1/c times as long as its crank
//! is solved for the rod first: the crank's angle is found with an error of ε/c², where the rows determine it to ε/c.
//! With redundant rows the plan has limits at which the mechanism is far from singular. One correction of Newton's
//! iteration by all rows, and the rates that all rows determine, are as accurate as the mechanism allows.

use crate::analysis::acceleration::acceleration;
use crate::analysis::velocity;
use crate::equations::Equations;
use crate::equations::factorisation::Purpose;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::workspace::Subset;
use nalgebra::DVector;

/// Above this margin the plan loses no more than four digits.
pub(crate) const ACCURATE_MARGIN: f64 = 1e-4;

/// The largest correction, in radians or in units of the scale of lengths, that can be an effect of rounding.
const MAX_CORRECTION: f64 = 1e-6;

/// Replaces the rates of a solution by those that all rows determine, and corrects q if `is_inaccurate`, where the rows
/// have full rank.
pub(crate) fn refine(
    equations: &mut Equations<'_>,
    is_inaccurate: bool,
    [q, q_dot, q_ddot]: [&mut [f64]; 3],
) -> Result<(), SolveError> {
    scaled_here(equations, q, |equations, q| {
        if is_inaccurate {
            correct_scaled(equations, q)?;
        }
        equations.evaluate(Subset::VELOCITY, q, None)?;
        let factor = equations.factorise(Purpose::Rank, None);
        if factor.rank < q.len() {
            return Ok(());
        }
        let Ok(velocity) = velocity::solve(equations, &factor) else { return Ok(()) };
        let velocity = velocity.as_slice();
        let Ok(acceleration) = acceleration(equations, q, velocity, &factor) else { return Ok(()) };
        q_dot.copy_from_slice(velocity);
        q_ddot.copy_from_slice(&acceleration);
        Ok(())
    })
}

/// One correction q − Φ_q⁺ Φ by the rows of position level, if these have full rank and the correction is an effect of
/// rounding.
pub(crate) fn correct(equations: &mut Equations<'_>, q: &mut [f64]) -> Result<(), SolveError> {
    scaled_here(equations, q, correct_scaled)
}

/// Calls a function with the scale at q. A motion that goes on to another size of the mechanism keeps its own scale.
fn scaled_here<R>(
    equations: &mut Equations<'_>,
    q: &mut [f64],
    function: impl FnOnce(&mut Equations<'_>, &mut [f64]) -> R,
) -> R {
    let scale_at_q = Scale::around(equations, q);
    let previous_scale = std::mem::replace(&mut equations.scale, scale_at_q);
    let result = function(equations, q);
    equations.scale = previous_scale;
    result
}

fn correct_scaled(equations: &mut Equations<'_>, q: &mut [f64]) -> Result<(), SolveError> {
    equations.evaluate(Subset::POSITION, q, None)?;
    let factor = equations.factorise(Purpose::Rank, None);
    if factor.rank < q.len() {
        return Ok(());
    }
    let residual = |row: usize| match equations.holonomic(row) {
        true => -equations.phi[row] * equations.scale.rows[row],
        false => 0.0,
    };
    let right = DVector::from_iterator(equations.rows(), (0..equations.rows()).map(residual));
    let correction = factor.solve(&right);
    let is_rounding = |(change, size): (&f64, &f64)| (change / size).abs() <= MAX_CORRECTION;
    if correction.iter().zip(&equations.scale.columns).all(is_rounding) {
        q.iter_mut().zip(correction.iter()).for_each(|(q, change)| *q += change);
    }
    Ok(())
}
