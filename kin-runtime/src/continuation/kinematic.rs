//! Kinematic analysis: position, velocity and acceleration over a time grid.

use super::branch::Orientation;
use super::follow::Follower;
use super::step::Node;
use crate::analysis;
use crate::equations::{Equations, finite};
use crate::error::{SolveError, SweepError};
use crate::solver::Position;
use crate::state::State;
use crate::trajectory::Trajectory;

/// The states at `times`, on the branch of `first`, which is the position at the first of them.
pub(crate) fn kinematic(
    equations: &mut Equations<'_>,
    first: Position,
    times: &[f64],
) -> Result<Trajectory, SweepError> {
    let mut trajectory = Trajectory { model: equations.model, states: Vec::with_capacity(times.len()) };
    match follow(equations, first, times, &mut trajectory.states) {
        Ok(()) => Ok(trajectory),
        Err(source) => Err(SweepError { trajectory, source }),
    }
}

/// Appends one state per instant until one fails.
fn follow(
    equations: &mut Equations<'_>,
    first: Position,
    times: &[f64],
    states: &mut Vec<State>,
) -> Result<(), SolveError> {
    let state = analysis::state(equations, first, None)?;
    states.push(state.clone());
    let rank = equations.coordinates() - state.degrees_of_freedom_left;
    let t = state.t;
    let singular = || SolveError::Singular {
        t,
        rank: rank.saturating_sub(1),
        expected_rank: rank,
        rows: Vec::new(),
        condition: f64::INFINITY,
    };
    let orientation = Orientation::here(equations, rank).ok_or_else(singular)?;
    let mut follower = Follower::new(equations, Node { state, orientation, rank });
    for (index, &t) in times.iter().enumerate().skip(1) {
        finite("times", index, "", t)?;
        states.push(follower.advance(t)?);
    }
    Ok(())
}
