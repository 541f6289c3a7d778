//! Kinematic analysis: position, velocity and acceleration over a time grid.

use super::follow::Continuation;
use crate::equations::scale::Scale;
use crate::equations::{Equations, finite};
use crate::error::{SolveError, SweepError};
use crate::events::{EventWatch, WatchResult};
use crate::linear::Factorization;
use crate::state::State;
use crate::trajectory::Trajectory;
use core::ops::ControlFlow;

/// A function that is called with every state of a sweep and says whether to continue.
pub(crate) type Visit<'v> = dyn FnMut(&State) -> ControlFlow<()> + 'v;

/// The motion at `times` on the branch of `first`, the state at the first of these times. The factorisation of Φ_q is given if
/// it was evaluated at that state last. States are passed to `visit`; without it, they are kept in the trajectory.
pub(crate) fn kinematic(
    equations: &mut Equations<'_>,
    first: (State, Option<Factorization>),
    times: &[f64],
    visit: Option<&mut Visit<'_>>,
) -> Result<Trajectory, SweepError> {
    let mut trajectory = Trajectory::new(equations.model);
    let visited = match visit {
        Some(visit) => visit_instants(equations, first, times, visit, &mut trajectory),
        None => {
            let mut states = Vec::with_capacity(times.len());
            let mut keep = |state: &State| {
                states.push(state.clone());
                ControlFlow::Continue(())
            };
            let visited = visit_instants(equations, first, times, &mut keep, &mut trajectory);
            trajectory.states = states;
            visited
        }
    };
    let Err(source) = visited else { return Ok(trajectory) };
    let is_located = source.limit().is_some_and(|limit| limit.at().is_some());
    trajectory.q_at_limit = equations.system.q_at_limit().filter(|_| is_located).map(<[f64]>::to_vec);
    Err(SweepError { trajectory: Box::new(trajectory), source })
}

/// Passes one state per instant to `visit` until one fails or the sweep stops at an event.
fn visit_instants(
    equations: &mut Equations<'_>,
    (state, factor): (State, Option<Factorization>),
    times: &[f64],
    visit: &mut Visit<'_>,
    trajectory: &mut Trajectory,
) -> Result<(), SolveError> {
    let total = times.len();
    let reached = &mut trajectory.reached;
    // True if the sweep goes on. A stop at the last instant is no error, because all states have been computed.
    let mut show = |equations: &mut Equations<'_>, state: &State, done: usize| {
        *reached = done;
        let goes_on = equations.observed.finish(state.t, Some(state)).is_ok();
        (visit(state).is_continue() || done == total) && goes_on
    };
    let stopped_at = |t: f64, done: usize| Err(SolveError::Stopped { t, done, total });
    let (start, goes_on) = (state.t, show(equations, &state, 1));
    if !equations.model.conditions.is_empty() && !equations.scale.is_known {
        equations.scale = Scale::around(equations, &state.q);
    }
    let mut motion = Continuation::new(equations, state, factor)?;
    motion.watch = EventWatch::start(equations, motion.state())?;
    let mut instants = times.iter().enumerate().skip(1);
    let first = if goes_on { Ok(()) } else { stopped_at(start, 1) };
    let result = first.and_then(|()| {
        instants.try_for_each(|(index, &t)| {
            if trajectory.stopped {
                return Ok(());
            }
            finite("times", index, "", t)?;
            motion.advance(equations, t, true)?;
            let event = motion.stopped(equations);
            trajectory.stopped = event.is_some();
            let state = event.unwrap_or(motion.state());
            // A sweep that stops at its first event is complete.
            if show(equations, state, index + 1) || trajectory.stopped {
                Ok(())
            } else {
                stopped_at(state.t, index + 1)
            }
        })
    });
    trajectory.fallbacks = motion.fallbacks;
    if let Some(watch) = motion.watch {
        let WatchResult { events, violated_at_start, unwatched } = watch.finish();
        (trajectory.events, trajectory.violated_at_start, trajectory.unwatched) =
            (events, violated_at_start, unwatched);
    }
    result
}
