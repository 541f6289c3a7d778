//! Kinematic analysis: position, velocity and acceleration over a time grid.

use super::follow::Follower;
use crate::equations::{Equations, finite};
use crate::error::{SolveError, SweepError};
use crate::events::{Seen, Watch};
use crate::linear::Factorization;
use crate::scale::Scale;
use crate::state::State;
use crate::trajectory::Trajectory;

/// The states at `times`, on the branch of `first`, which is the one at the first of them; with the factorisation of Φ_q
/// where that was evaluated there last.
pub(crate) fn kinematic(
    equations: &mut Equations<'_>,
    first: (State, Option<Factorization>),
    times: &[f64],
) -> Result<Trajectory, SweepError> {
    let mut trajectory = Trajectory::new(equations.model);
    trajectory.states.reserve_exact(times.len());
    match follow(equations, first, times, &mut trajectory) {
        Ok(()) => Ok(trajectory),
        Err(source) => Err(SweepError { trajectory: Box::new(trajectory), source }),
    }
}

/// Appends one state per instant until one fails or the sweep is to stop at an event.
fn follow(
    equations: &mut Equations<'_>,
    (state, factor): (State, Option<Factorization>),
    times: &[f64],
    trajectory: &mut Trajectory,
) -> Result<(), SolveError> {
    trajectory.states.push(state.clone());
    if !equations.model.conditions.is_empty() && !equations.scale.is_known {
        equations.scale = Scale::around(equations, &state.q);
    }
    let told = equations.observed.finish(state.t, Some(&state));
    let mut follower = Follower::new(equations, state, factor)?;
    follower.watch = Watch::start(equations, follower.state())?;
    let mut instants = times.iter().enumerate().skip(1);
    let result = told.and_then(|()| {
        instants.try_for_each(|(index, &t)| {
            if trajectory.stopped {
                return Ok(());
            }
            finite("times", index, "", t)?;
            follower.advance(equations, t, true)?;
            let event = follower.stopped(equations);
            trajectory.stopped = event.is_some();
            let state = event.unwrap_or(follower.state()).clone();
            let told = equations.observed.finish(state.t, Some(&state));
            trajectory.states.push(state);
            // A sweep that its first event ended is whole.
            if trajectory.stopped { Ok(()) } else { told }
        })
    });
    trajectory.fallbacks = follower.fallbacks;
    if let Some(watch) = follower.watch {
        let Seen { events, violated_at_start, unwatched } = watch.finish();
        (trajectory.events, trajectory.violated_at_start, trajectory.unwatched) =
            (events, violated_at_start, unwatched);
    }
    result
}
