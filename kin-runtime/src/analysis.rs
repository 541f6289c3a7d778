//! Position, velocity and acceleration together: a state.

use crate::acceleration::acceleration;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::scale::Scale;
use crate::solver::Position;
use crate::state::State;
use crate::velocity::velocity;

/// The state at an assembled position.
///
/// `usual_rank` is the rank that an earlier configuration of the same motion showed.
pub(crate) fn state(
    equations: &mut Equations<'_>,
    position: Position,
    usual_rank: Option<usize>,
) -> Result<State, SolveError> {
    let Position { q, iterations, residual } = position;
    equations.scale = Scale::around(equations, &q);
    let (q_dot, factor) = velocity(equations, &q, usual_rank)?;
    let q_ddot = acceleration(equations, &q, &q_dot, &factor)?;
    Ok(State {
        t: equations.t,
        inputs: equations.inputs.clone(),
        degrees_of_freedom_left: q.len() - factor.rank,
        condition: factor.condition,
        q,
        q_dot,
        q_ddot,
        residual,
        iterations,
    })
}
