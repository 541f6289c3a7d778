//! Position, velocity and acceleration together: a state.

use crate::analysis::acceleration::acceleration;
use crate::analysis::poses::poses;
use crate::analysis::position::Position;
use crate::analysis::rounding::settle_rates;
use crate::analysis::velocity::velocity;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::state::State;

/// The state at an assembled position, and the factorised Φ_q there.
pub(crate) fn state(equations: &mut Equations<'_>, position: Position) -> Result<(State, Factorization), SolveError> {
    let Position { mut q, iterations, residual } = position;
    equations.scale = Scale::around(equations, &q);
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
