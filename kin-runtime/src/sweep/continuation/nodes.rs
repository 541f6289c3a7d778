//! Data that full Newton needs at a node besides its state: the factorisation of Φ_q, its orientation, and rates.

use super::groups;
use super::orientation::Orientation;
use super::step::{Basis, Node};
use crate::analysis::acceleration::acceleration;
use crate::analysis::by_plan;
use crate::analysis::velocity;
use crate::equations::Equations;
use crate::equations::factorisation::Purpose;
use crate::equations::scale::{Scale, largest_product};
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::planned::follower::{Control, most_turn};
use crate::signal::Instant;
use crate::state::State;
use crate::workspace::Subset;

/// Computes the basis for full Newton at a node that the plan has solved.
pub(super) fn complete_basis(equations: &mut Equations<'_>, node: &mut Node) -> Result<(), SolveError> {
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
    let factor = equations.factorise(Purpose::Rank, None);
    if factor.rank + node.state.degrees_of_freedom_left < equations.coordinates() {
        // The node is so near to a singular configuration that Φ_q is singular within rounding, although the plan still
        // solved it.
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
    // The instant may be one that has no state, as where a length is negative.
    equations.set_checked_instant(&Instant { t, inputs: &inputs });
    Ok(())
}

/// The basis for full Newton at a state, from a factorisation of Φ_q, which was evaluated there last.
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
    equations.write_branch_values(&state.q, &mut groups);
    let turns = equations.turns(&state.instant(), &state.q);
    Ok(Basis { orientation, factor, groups, turns })
}

/// Writes the rates of a state at an instant; the q of the state already belongs to that instant.
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

/// Writes q̇ and q̈ at q. Φ_q and Φ_t were evaluated there last, and `factor` is the factorisation of Φ_q.
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

/// The longest step from q in which no body turns by more than the options allow. `nearest` is the distance of the group
/// that is nearest to its limit; `turns` are those of [`Equations::turns`].
pub(super) fn natural_step(
    equations: &Equations<'_>,
    [q, q_dot, q_ddot]: [&[f64]; 3],
    nearest: f64,
    turns: &[f64],
) -> f64 {
    let control = Control::of(&equations.options);
    let step = |most: f64, turn: &dyn Fn(&[f64]) -> f64| {
        let by_velocity = most / turn(q_dot);
        by_velocity.min((2.0 * most / turn(q_ddot)).sqrt())
    };
    let of_bodies = step(most_turn(&control, nearest), &|rates| groups::turn_of_bodies(equations, q, rates));
    of_bodies.min(step(control.rotation, &|rates| largest_product(rates, turns)))
}
