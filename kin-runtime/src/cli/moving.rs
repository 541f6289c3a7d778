//! Motions, for every command that shows one: their instants, and how far they come.

use std::f64::consts::TAU;

use super::engine::{Engine, Setup};
use super::failure::{Failure, Ledger};
use super::options::FreedomArgs;
use super::session::Session;
use super::solved::{analysis, driven_state, fully_driven};
use super::values;
use super::watch::Watch;
use crate::error::SolveError;
use crate::model::{Component, CoordinateKind, Model};
use crate::motion::Motion;
use crate::present::condition;
use crate::present::number::rounded;
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
    /// What is asked for; `steps` where nobody says.
    pub(super) fn asked(&self, steps: usize) -> Result<Asked, Failure> {
        let mut ledger = Ledger::default();
        let number =
            |option: &str, text: &Option<String>| text.as_deref().map(|t| values::number(option, t)).transpose();
        if let Some(times) = &self.times {
            let beside = [("--from", &self.from), ("--to", &self.to), ("--steps", &self.steps)];
            for (name, _) in beside.into_iter().filter(|(_, value)| value.is_some()) {
                let what = format!("cannot stand beside {name}; use one or the other");
                ledger.take::<()>(Err(Failure::option("--times", what)));
            }
            let times = ledger.take(values::times("--times", times));
            return ledger.close(times.map(Asked::Times));
        }
        let from = ledger.take(number("--from", &self.from)).flatten().unwrap_or(0.0);
        let to = ledger.take(number("--to", &self.to)).flatten();
        let steps = match &self.steps {
            Some(text) => ledger.take(values::steps(text)),
            None => Some(steps),
        };
        let asked = match (to, steps) {
            (Some(to), Some(steps)) => ledger.take(values::grid(from, to, steps)).map(Asked::Times),
            (_, steps) => steps.map(|steps| Asked::Open { from, steps }),
        };
        ledger.close(asked)
    }
}

/// The instants that the options ask for.
pub(super) enum Asked {
    Times(Vec<f64>),
    /// Nobody says where it ends.
    Open {
        from: f64,
        steps: usize,
    },
}

impl Asked {
    /// The instants; `end` may know the last one from the first.
    pub(super) fn times(self, end: impl FnOnce(f64) -> Option<f64>) -> Result<Vec<f64>, Failure> {
        match self {
            Self::Times(times) => Ok(times),
            Self::Open { from, steps } => match end(from) {
                Some(to) => values::grid(from, to, steps),
                None => Err(Failure::usage("no instants: write --from A --to B --steps N, or --times T1,T2,…")),
            },
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

/// The motion over `times`, up to its first failure or to Ctrl-C.
pub(super) fn moved(
    engine: &dyn Engine,
    setup: &Setup,
    times: &[f64],
    stop_at_events: bool,
    freedom: FreedomArgs,
    watch: &Watch,
) -> Result<Moved, Failure> {
    // A long sweep fails at its start, when the drivers leave the motion open there.
    let first = times.first().copied().unwrap_or(0.0);
    let (start, _) = driven_state(engine, setup, first, freedom.least_norm)?;
    let (mut trajectory, ended) = engine.sweep(setup, times, stop_at_events, &|reached| watch.observe(reached));
    let ended = ended.map(|error| stopped(engine, &error, &trajectory)).or_else(|| {
        // A sweep may also pass through a position where the drivers lose their grip.
        let states = &mut trajectory.states;
        let open = states.iter().position(|s| s.degrees_of_freedom_left > 0).filter(|_| !freedom.least_norm)?;
        let at = states.get(open).map_or(f64::NAN, |s| s.t);
        let failure = states.get(open).map(|s| engine.mobility(setup, &s.instant(), &s.q));
        states.truncate(open);
        trajectory.events.retain(|event| (event.t - first).abs() < (at - first).abs());
        trajectory.unwatched.retain(|unwatched| (unwatched.from - first).abs() < (at - first).abs());
        match failure {
            Some(Ok(mobility)) => fully_driven(engine, &mobility, at).err(),
            Some(Err(error)) => Some(analysis(engine, &error)),
            None => None,
        }
    });
    Ok(Moved { trajectory, ended, left: start.degrees_of_freedom_left })
}

/// Why a motion ended.
fn stopped(engine: &dyn Engine, error: &SolveError, trajectory: &Trajectory) -> Failure {
    match error {
        SolveError::Stopped { total, .. } => interrupted(&trajectory.states, *total),
        other => analysis(engine, other),
    }
}

/// How far a motion came before Ctrl-C.
pub(super) fn interrupted(finished: &[State], total: usize) -> Failure {
    let until = finished.last().map_or(String::new(), |state| format!(", up to t = {}", rounded(state.t)));
    Failure::Interrupted(format!("{} of {} finished{until}", finished.len(), count(total, "instant")))
}

/// What there is to say of a motion beside its numbers.
pub(super) fn note_motion(session: &mut Session<'_>, trajectory: &Trajectory) {
    note_events(session, trajectory);
    note_unwatched(session, trajectory);
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

/// Stretches that are told one by one; of more, how many there are.
const TOLD: usize = 3;

/// Where unilateral conditions were too fast to be watched.
fn note_unwatched(session: &mut Session<'_>, trajectory: &Trajectory) {
    for unwatched in trajectory.unwatched.iter().take(TOLD) {
        session.note(&format!(
            "note: condition {unwatched}: it changes too fast there, and may have met its limit more often than is said; \
             more instants (--steps) may do"
        ));
    }
    if trajectory.unwatched.len() > TOLD {
        session.note(&format!("note: the same in {}", count(trajectory.unwatched.len() - TOLD, "more place")));
    }
}

/// Where full Newton took over from the plan. Not where the motion ended at a limit: there it always does on the last
/// steps, and the error has said why.
fn note_fallbacks(session: &mut Session<'_>, trajectory: &Trajectory) {
    if trajectory.q_at_limit.is_some() {
        return;
    }
    if let Some(first) = trajectory.fallbacks.first() {
        let steps = count(trajectory.fallbacks.len(), "internal step");
        session.note(&format!("note: full Newton took over from the plan on {steps}, first {first}"));
    }
}

/// Points, defines and joint quantities of the states. A Ctrl-C while they are computed leaves the rest out; one before
/// has decided already how many states there are.
pub(super) fn motions(engine: &dyn Engine, states: &[State], watch: &Watch) -> Result<Vec<Motion>, Failure> {
    let decided = watch.interrupted();
    let mut motions = Vec::with_capacity(states.len());
    for state in states {
        motions.push(engine.motion(state).map_err(|e| analysis(engine, &e))?);
        if watch.interrupted() && !decided {
            break;
        }
    }
    Ok(motions)
}

/// The names of the columns besides t, points and joint quantities included.
pub(super) fn column_names(model: &Model) -> Vec<String> {
    crate::present::grid::columns(model, &[], &[]).into_iter().skip(1).map(|(name, _)| name).collect()
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
    let driven =
        model.rows.iter().enumerate().filter(|(_, row)| row.driving || row.rheonomic).filter_map(|(place, _)| {
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
