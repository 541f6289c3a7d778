//! Acceleration analysis: Φ_q q̈ = γ, with the factorisation of velocity analysis.

use crate::analysis::velocity::{inconsistency, scaled};
use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::workspace::Subset;

/// q̈ at an assembled configuration with its q̇; `factor` is the factorisation of Φ_q, which was evaluated there last.
pub(crate) fn acceleration(
    equations: &mut Equations<'_>,
    q: &[f64],
    q_dot: &[f64],
    factor: &Factorization,
) -> Result<Vec<f64>, SolveError> {
    equations.evaluate(Subset::GAMMA, q, Some(q_dot))?;
    let right = scaled(equations, &equations.gamma);
    let solution = factor.solve(&right);
    // γ is a sum of terms quadratic in q̇. Where they cancel, residuals smaller than rounding of the terms are no
    // contradiction.
    let parts = equations.scale.size(q_dot).powi(2);
    if let Some((row, residual)) = inconsistency(equations, &solution, &right, parts) {
        let (row_name, joint) = (equations.row_name(row), equations.joint_name(row));
        let (t, rank) = (equations.t, factor.rank);
        return Err(SolveError::InconsistentAcceleration { t, residual, row_name, joint, rank });
    }
    equations.check("q_ddot", solution.as_slice())?;
    Ok(solution.as_slice().to_vec())
}
