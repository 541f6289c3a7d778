//! Position, velocity and acceleration together: a state.

use crate::analysis::acceleration::acceleration;
use crate::analysis::poses::poses;
use crate::analysis::position::Position;
use crate::analysis::rounding::settle_rates;
use crate::analysis::velocity::{scaled, velocity};
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::nonlinear::newton::{LAST_STEP, rounding};
use crate::state::State;
use crate::workspace::Subset;
use nalgebra::DVector;

/// The state at an assembled position, and the factorised Φ_q there.
pub(crate) fn state(equations: &mut Equations<'_>, position: Position) -> Result<(State, Factorization), SolveError> {
    let Position { mut q, iterations, mut residual } = position;
    equations.scale = Scale::around(equations, &q);
    let (mut q_dot, mut factor) = velocity(equations, &q, None)?;
    if let Some(closer) = closer(equations, (&q, residual), &factor)? {
        (q, residual) = closer;
        (q_dot, factor) = velocity(equations, &q, None)?;
    }
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

/// q after one more Newton step and its largest |Φ_i|, if q leaves larger residuals than rounding does and the step
/// makes them smaller. Where a row has no derivative at the solution, an iteration stops beside it, at a distance that
/// is small for q and not for rates that become infinite there.
///
/// # Errors
/// [`NonFinite`](SolveError::NonFinite) if a row or its derivatives are not defined where the step leads.
fn closer(
    equations: &mut Equations<'_>,
    (q, residual): (&[f64], f64),
    factor: &Factorization,
) -> Result<Option<(Vec<f64>, f64)>, SolveError> {
    let steepest = equations.scale.rows.iter().fold(0.0, |most: f64, scale| most.max(*scale));
    let allowed = rounding(equations.scale.size(q).max(1.0));
    if residual * steepest <= allowed {
        return Ok(None);
    }
    let open = open_rows(equations, q)?;
    let step = factor.solve(&open);
    if open.amax() <= allowed || equations.scale.size(step.as_slice()) > LAST_STEP {
        return Ok(None);
    }
    let ahead: Vec<f64> = q.iter().zip(step.iter()).map(|(x, step)| x - step).collect();
    let then = open_rows(equations, &ahead)?;
    let rows = equations.rows_where(Equations::holonomic);
    let residual = rows.iter().map(|&row| equations.phi[row].abs()).fold(0.0, f64::max);
    Ok((then.amax() < 0.5 * open.amax()).then_some((ahead, residual)))
}

/// Φ on the common scale, with 0 for rows of velocity level.
fn open_rows(equations: &mut Equations<'_>, q: &[f64]) -> Result<DVector<f64>, SolveError> {
    equations.evaluate(Subset::POSITION, q, None)?;
    let mut open = scaled(equations, &equations.phi);
    (0..open.len()).filter(|row| !equations.holonomic(*row)).for_each(|row| open[row] = 0.0);
    Ok(open)
}
