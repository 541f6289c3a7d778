//! Motions, for every command that shows one: their instants, and how far they come.

use std::f64::consts::TAU;

use super::engine::{Engine, Setup};
use super::failure::Failure;
use super::options::FreedomArgs;
use super::session::Session;
use super::solved::{analysis, driven_state, fully_driven};
use super::values;
use crate::model::{Component, CoordinateKind};
use crate::motion::Motion;
use crate::present::condition;
use crate::present::text::count;
use crate::state::State;
use crate::trajectory::Trajectory;

/// The instants of a motion.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct GridArgs {
    /// The first instant [default: 0]
    #[arg(long, value_name = "A")]
    from: Option<String>,
    /// The last instant
    #[arg(long, value_name = "B")]
    to: Option<String>,
    /// Number of steps; N steps are N + 1 instants
    #[arg(long, value_name = "N")]
    steps: Option<String>,
    /// The instants one by one, in place of --from, --to and --steps
    #[arg(long, value_name = "T1,T2,…")]
    times: Option<String>,
}

impl GridArgs {
    /// The instants; `end` may know the last one from the first, where --to is not there.
    pub(super) fn times(&self, end: impl FnOnce(f64) -> Option<f64>, steps: usize) -> Result<Vec<f64>, Failure> {
        let number =
            |option: &str, text: &Option<String>| text.as_deref().map(|t| values::number(option, t)).transpose();
        if let Some(times) = &self.times {
            let beside = [("--from", &self.from), ("--to", &self.to), ("--steps", &self.steps)];
            if let Some((name, _)) = beside.into_iter().find(|(_, value)| value.is_some()) {
                return Err(Failure::option("--times", format!("cannot stand beside {name}; use one or the other")));
            }
            return values::times("--times", times);
        }
        let from = number("--from", &self.from)?.unwrap_or(0.0);
        let steps = self.steps.as_deref().map(values::steps).transpose()?.unwrap_or(steps);
        match number("--to", &self.to)?.or_else(|| end(from)) {
            Some(to) => values::grid(from, to, steps),
            None => Err(Failure::Usage("no instants: write --from A --to B --steps N, or --times T1,T2,…".to_owned())),
        }
    }
}

/// A motion as far as it came.
pub(super) struct Moved {
    pub(super) trajectory: Trajectory,
    /// Why it ended early.
    pub(super) ended: Option<Failure>,
    /// Degrees of freedom that the drivers leave at the first instant.
    pub(super) left: usize,
}

/// The motion over `times`, up to its first failure.
pub(super) fn moved(
    engine: &dyn Engine,
    setup: &Setup,
    times: &[f64],
    stop_at_events: bool,
    freedom: FreedomArgs,
) -> Result<Moved, Failure> {
    // A long sweep fails at its start, when the drivers leave the motion open there.
    let first = times.first().copied().unwrap_or(0.0);
    let (start, _) = driven_state(engine, setup, first, freedom.least_norm)?;
    let (mut trajectory, mut ended) = engine.sweep(setup, times, stop_at_events);
    let ended = ended.take().map(|error| analysis(engine, &error)).or_else(|| {
        // A sweep may also pass through a position where the drivers lose their grip.
        let states = &mut trajectory.states;
        let open = states.iter().position(|s| s.degrees_of_freedom_left > 0).filter(|_| !freedom.least_norm)?;
        let at = states.get(open).map_or(f64::NAN, |s| s.t);
        let failure = states.get(open).map(|s| engine.mobility(setup, &s.instant(), &s.q));
        states.truncate(open);
        trajectory.events.retain(|event| (event.t - first).abs() < (at - first).abs());
        match failure {
            Some(Ok(mobility)) => fully_driven(engine, &mobility, at).err(),
            Some(Err(error)) => Some(analysis(engine, &error)),
            None => None,
        }
    });
    Ok(Moved { trajectory, ended, left: start.degrees_of_freedom_left })
}

/// What there is to say of a motion beside its numbers.
pub(super) fn note_motion(session: &mut Session<'_>, trajectory: &Trajectory) {
    note_events(session, trajectory);
    note_fallbacks(session, trajectory);
}

/// Where unilateral conditions met their limits.
fn note_events(session: &mut Session<'_>, trajectory: &Trajectory) {
    let violated: Vec<&str> = trajectory.violated_at_start().map(|condition| condition.name).collect();
    if !violated.is_empty() {
        session.note(&format!("note: violated at the first instant: {}", violated.join(", ")));
    }
    for event in &trajectory.events {
        session.note(&condition::line(trajectory.model, event));
    }
    if trajectory.stopped {
        session.note("note: the sweep stopped there; the last row is the event");
    }
}

/// Where full Newton took over from the plan.
fn note_fallbacks(session: &mut Session<'_>, trajectory: &Trajectory) {
    if let Some(first) = trajectory.fallbacks.first() {
        let steps = count(trajectory.fallbacks.len(), "internal step");
        session.note(&format!("note: full Newton took over from the plan on {steps}, first {first}"));
    }
}

/// Points, defines and joint quantities of every state.
pub(super) fn motions(engine: &dyn Engine, states: &[State]) -> Result<Vec<Motion>, Failure> {
    states.iter().map(|s| engine.motion(s).map_err(|e| analysis(engine, &e))).collect()
}

/// Where a motion from an instant on may end when nobody says: after one turn of the slowest of the cranks that are driven
/// at constant speed, or after one unit of time.
pub(super) fn natural_end(engine: &dyn Engine, setup: &Setup, from: f64) -> f64 {
    from + period(engine, setup, from).unwrap_or(1.0)
}

fn period(engine: &dyn Engine, setup: &Setup, from: f64) -> Option<f64> {
    let model = engine.model();
    let (state, _) = driven_state(engine, setup, from, true).ok()?;
    let angle = |column: usize| {
        let kind = model.coordinates.get(column).map(|coordinate| coordinate.kind);
        matches!(kind, Some(CoordinateKind::Pose { component: Component::Phi, .. } | CoordinateKind::Scalar))
    };
    let driven = model.rows.iter().enumerate().filter(|(_, row)| row.driving).filter_map(|(place, _)| {
        let mut entries = model.constraint_pattern.entries.iter().filter(|(row, _)| *row == place);
        match (entries.next(), entries.next()) {
            (Some(&(_, column)), None) if angle(column) => Some(column),
            _ => None,
        }
    });
    let speeds = driven.filter_map(|column| {
        let (speed, acceleration) = (state.q_dot.get(column)?.abs(), state.q_ddot.get(column)?.abs());
        (speed > 0.0 && acceleration <= 1e-9 * speed * speed).then_some(speed)
    });
    let slowest = speeds.fold(f64::INFINITY, f64::min);
    slowest.is_finite().then_some(TAU / slowest)
}
