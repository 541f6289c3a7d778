//! Velocity analysis: Φ_q q̇ = −Φ_t.
//!
//! q̇ has least norm if degrees of freedom are open. Redundant rows must agree; a configuration in which Φ_q loses rank
//! is an error, see [`singular`](crate::analysis::singular).

use crate::analysis::position::given_conflict;
use crate::analysis::singular;
use crate::equations::Equations;
use crate::equations::contact;
use crate::equations::factorisation::Purpose;
use crate::equations::residual::UNDERFLOW;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::workspace::Subset;
use nalgebra::DVector;

/// q̇ at an assembled configuration, with the factorisation of Φ_q that acceleration analysis uses again.
///
/// `usual_rank` is the rank of this mechanism's Φ_q, if an earlier configuration showed it.
pub(crate) fn velocity(
    equations: &mut Equations<'_>,
    q: &[f64],
    usual_rank: Option<usize>,
) -> Result<(Vec<f64>, Factorization), SolveError> {
    let factor = factorize(equations, q, usual_rank)?;
    let solution = solve(equations, &factor).map_err(|error| singular::explain(equations, q, &factor, error))?;
    Ok((solution.as_slice().to_vec(), factor))
}

/// q̇ where Φ_q and Φ_t were evaluated last, with the factorisation of that Φ_q.
pub(crate) fn solve(equations: &Equations<'_>, factor: &Factorization) -> Result<DVector<f64>, SolveError> {
    let right = -scaled(equations, &equations.phi_t);
    let solution = factor.solve(&right);
    if let Some((row, residual)) = inconsistency(equations, &solution, &right, 0.0) {
        let (row_name, joint) = (equations.row_name(row), equations.joint_name(row));
        return Err(SolveError::InconsistentVelocity { t: equations.t, residual, row_name, joint, rank: factor.rank });
    }
    equations.check("q_dot", solution.as_slice())?;
    Ok(solution)
}

/// Evaluates Φ_q and Φ_t and factorises Φ_q with its rank; an error if it loses rank in this configuration alone.
pub(crate) fn factorize(
    equations: &mut Equations<'_>,
    q: &[f64],
    usual_rank: Option<usize>,
) -> Result<Factorization, SolveError> {
    equations.evaluate(Subset::VELOCITY, q, None)?;
    let (s, n) = (equations.rows(), equations.coordinates());
    let factor = equations.factorise(Purpose::AbsoluteRank, None);
    if let Some(error) = contact::at_a_standstill(equations, q).or_else(|| contact::without_angle(equations, q)) {
        return Err(error);
    }
    let conflict = if factor.rank < s { given_conflict(equations) } else { None };
    if factor.rank < s.min(n) && usual_rank.is_none_or(|usual| factor.rank < usual) {
        if let Some(error) = contact::without_gradient(equations, equations.options.rank_tolerance) {
            return Err(error);
        }
        if let Some(error) = singular::diagnose(equations, q, &factor) {
            return Err(error);
        }
        equations.evaluate(Subset::VELOCITY, q, None)?;
    }
    conflict.map_or(Ok(factor), Err)
}

/// Right-hand sides on the common scale.
pub(crate) fn scaled(equations: &Equations<'_>, right: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(right.len(), right.iter().zip(&equations.scale.rows).map(|(r, s)| r * s))
}

/// The row with the largest residual of Φ_q x = b, if that is more than rounding; b is a sum of terms of size `parts`
/// on the common scale.
pub(crate) fn inconsistency(
    equations: &Equations<'_>,
    x: &DVector<f64>,
    right: &DVector<f64>,
    parts: f64,
) -> Option<(usize, f64)> {
    let product = scaled(equations, &equations.times(x.as_slice()));
    let size = right.amax().max(equations.scale.size(x.as_slice())).max(parts);
    let (row, worst) = (product - right)
        .iter()
        .enumerate()
        .fold((0, 0.0), |best: (usize, f64), (k, r)| if r.abs() > best.1 { (k, r.abs()) } else { best });
    (worst > (equations.options.consistency_tolerance * size).max(UNDERFLOW)).then(|| (row, worst / size))
}
