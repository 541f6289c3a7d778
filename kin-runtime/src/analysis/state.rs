//! Position, velocity and acceleration together: a state.

use crate::analysis::acceleration::acceleration;
use crate::analysis::poses::poses;
use crate::analysis::position::{Position, largest_residual};
use crate::analysis::refinement::correct;
use crate::analysis::rounding::settle_rates;
use crate::analysis::velocity::velocity;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::nonlinear::newton::rounding;
use crate::state::State;
use crate::workspace::Subset;

/// The state at an assembled position, and the factorised Φ_q there.
pub(crate) fn state(equations: &mut Equations<'_>, position: Position) -> Result<(State, Factorization), SolveError> {
    let Position { mut q, iterations, mut residual } = position;
    equations.scale = Scale::around(equations, &q);
    if let Some(closer) = corrected(equations, &q, residual)? {
        (q, residual) = closer;
    }
    let (mut q_dot, factor) = velocity(equations, &q, None)?;
    let mut q_ddot = acceleration(equations, &q, &q_dot, &factor)?;
    equations.check_slopes([&q, &q_dot, &q_ddot])?;
    settle_rates(equations, [&mut q, &mut q_dot, &mut q_ddot], &factor)?;
    let mut state = State {
        model: equations.model,
        t: equations.t,
        inputs: equations.inputs.clone(),
        degrees_of_freedom_left: q.len() - factor.rank,
        condition: Some(factor.condition),
        q,
        q_dot,
        q_ddot,
        bodies: Vec::new(),
        points: Vec::new(),
        residual,
        iterations,
    };
    poses(equations, &mut state)?;
    Ok((state, factor))
}

/// q after one more correction by all rows and its largest |Φ_i|, if q leaves larger residuals than rounding does and the
/// correction makes them smaller. Where a row has no derivative at the solution, an iteration stops beside it, at a
/// distance that is small for q and not for rates that become infinite there.
///
/// # Errors
/// [`NonFinite`](SolveError::NonFinite) if a row or its derivatives are not defined where the correction leads.
fn corrected(equations: &mut Equations<'_>, q: &[f64], residual: f64) -> Result<Option<(Vec<f64>, f64)>, SolveError> {
    let steepest = equations.scale.rows.iter().fold(0.0, |most: f64, scale| most.max(*scale));
    if residual * steepest <= rounding(equations.scale.size(q).max(1.0)) {
        return Ok(None);
    }
    let mut closer = q.to_vec();
    correct(equations, &mut closer)?;
    equations.evaluate(Subset::POSITION, &closer, None)?;
    let residual_after = largest_residual(equations);
    Ok((residual_after < 0.5 * residual).then_some((closer, residual_after)))
}
