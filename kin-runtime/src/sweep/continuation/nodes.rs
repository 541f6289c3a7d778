//! What full Newton has at a node of a motion besides its state: the factorisation of Φ_q, its orientation, rates.

use super::branch::Orientation;
use super::groups;
use super::step::{Basis, Node};
use crate::analysis::acceleration::acceleration;
use crate::analysis::by_plan;
use crate::analysis::velocity;
use crate::equations::Equations;
use crate::equations::factorisation::Wanted;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::planned::follower::{Control, most_turn};
use crate::state::State;
use crate::workspace::{Instant, Subset};

/// Finds what full Newton goes on from, where the plan has solved.
pub(super) fn found_on(equations: &mut Equations<'_>, node: &mut Node) -> Result<(), SolveError> {
    if node.basis.is_some() {
        return Ok(());
    }
    let q = &node.state.q;
    let (t, inputs) = (equations.t, equations.inputs.clone());
    equations.set_instant(&node.state.instant())?;
    if !equations.scale.is_known {
        equations.scale = Scale::around(equations, q);
    }
    equations.evaluate(Subset::VELOCITY, q, None)?;
    let factor = equations.factorise(Wanted::Rank, None);
    if factor.rank + node.state.degrees_of_freedom_left < equations.coordinates() {
        // The plan has come nearer to a singular configuration than a factorisation of Φ_q can.
        return Err(SolveError::Singular {
            t: node.state.t,
            rank: factor.rank,
            expected_rank: equations.coordinates() - node.state.degrees_of_freedom_left,
            rows: Vec::new(),
            condition: factor.full_condition,
            limit: by_plan::limit(equations, &node.state.q),
        });
    }
    node.basis = Some(basis_with(equations, &node.state, factor)?);
    equations.set_instant(&Instant { t, inputs: &inputs })
}

/// What full Newton goes on from at a state, with a factorisation of Φ_q, which was evaluated last.
pub(super) fn basis_with(equations: &Equations<'_>, state: &State, factor: Factorization) -> Result<Basis, SolveError> {
    let (t, rank) = (state.t, factor.rank);
    let singular = || SolveError::Singular {
        t,
        rank: rank.saturating_sub(1),
        expected_rank: rank,
        rows: Vec::new(),
        condition: f64::INFINITY,
        limit: None,
    };
    let orientation = Orientation::here(equations, &factor).ok_or_else(singular)?;
    let mut groups = Vec::new();
    groups::write(equations, &state.q, &mut groups);
    Ok(Basis { orientation, factor, groups })
}

/// The state's rates at an instant, its q being that of the instant.
pub(super) fn at_instant(
    equations: &mut Equations<'_>,
    at: &Instant<'_>,
    state: &mut State,
    factor: &Factorization,
) -> Result<(), SolveError> {
    equations.set_instant(at)?;
    equations.by_time(|equations| {
        equations.evaluate(Subset::VELOCITY, &state.q, None)?;
        rates(equations, &state.q, factor, &mut state.q_dot, &mut state.q_ddot)
    })?;
    state.t = at.t;
    state.inputs.clone_from(&equations.inputs);
    Ok(())
}

/// q̇ and q̈ at q, where Φ_q and Φ_t were evaluated last and Φ_q has the factorisation `factor`.
pub(super) fn rates(
    equations: &mut Equations<'_>,
    q: &[f64],
    factor: &Factorization,
    q_dot: &mut Vec<f64>,
    q_ddot: &mut Vec<f64>,
) -> Result<(), SolveError> {
    let solution = velocity::solve(equations, factor)?;
    q_dot.clear();
    q_dot.extend_from_slice(solution.as_slice());
    *q_ddot = acceleration(equations, q, q_dot, factor)?;
    Ok(())
}

/// The step within which nothing turns by more than is allowed, from a node whose nearest group has this distance from its
/// limit.
pub(super) fn natural_step(equations: &Equations<'_>, [q_dot, q_ddot]: [&[f64]; 2], nearest: f64) -> f64 {
    let scale = &equations.scale;
    let most = most_turn(&Control::of(&equations.options), nearest);
    let by_velocity = most / scale.turn(q_dot);
    let by_acceleration = (2.0 * most / scale.turn(q_ddot)).sqrt();
    by_velocity.min(by_acceleration)
}
