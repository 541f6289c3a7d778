//! Motions, for every command that shows one: their instants, and how far they come.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::engine::{Engine, Setup};
use super::failure::{Failure, Ledger};
use super::options::FreedomArgs;
use super::session::Session;
use super::solved::{analysis, driven_state, fully_driven};
use super::values::{self, Moment};
use super::watch::Watch;
use crate::error::SolveError;
use crate::forces::ContactChange;
use crate::model::{Component, CoordinateKind, ForceModel, Model};
use crate::motion::Motion;
use crate::observer::Reached;
use crate::present::condition;
use crate::present::number::rounded;
use crate::present::text::count;
use crate::solver::ContactWatch;
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
    pub(super) fn asked(&self, steps: usize, model: &Model) -> Result<Asked, Failure> {
        let mut ledger = Ledger::default();
        let moment =
            |option: &str, text: &Option<String>| text.as_deref().map(|t| values::moment(option, t, model)).transpose();
        if let Some(times) = &self.times {
            let beside = [("--from", &self.from), ("--to", &self.to), ("--steps", &self.steps)];
            for (name, _) in beside.into_iter().filter(|(_, value)| value.is_some()) {
                let what = format!("cannot stand beside {name}; use one or the other");
                ledger.take::<()>(Err(Failure::option("--times", what)));
            }
            let times = ledger.take(values::times("--times", times, model));
            return ledger.close(times.map(Asked::Times));
        }
        let from = ledger.take(moment("--from", &self.from)).flatten().unwrap_or(Moment::At(0.0));
        let to = ledger.take(moment("--to", &self.to)).flatten();
        let steps = match &self.steps {
            Some(text) => ledger.take(values::steps(text)),
            None => Some(steps),
        };
        if let (Moment::At(from), Some(Moment::At(to)), Some(steps)) = (from, to, steps) {
            ledger.take(values::grid_is_possible(from, to, steps));
        }
        ledger.close(steps.map(|steps| Asked::Grid { from, to, steps }))
    }
}

/// The instants that the options ask for.
pub(super) enum Asked {
    Times(Vec<Moment>),
    Grid {
        from: Moment,
        /// Where nobody says where it ends, it is where the motion suggests.
        to: Option<Moment>,
        steps: usize,
    },
}

impl Asked {
    /// Nobody says where it ends.
    pub(super) fn is_open(&self) -> bool {
        matches!(self, Self::Grid { to: None, .. })
    }

    /// The instants. Without an end it is after one turn of the driven crank, or one unit of time.
    pub(super) fn times(self, engine: &dyn Engine, setup: &Setup) -> Result<Vec<f64>, Failure> {
        let at = |option: &str, moment| instant(option, moment, engine, setup);
        match self {
            Self::Times(times) => times.into_iter().map(|moment| at("--times", moment)).collect(),
            Self::Grid { from, to, steps } => {
                let from = at("--from", from)?;
                let to = to.map_or_else(|| Ok(natural_end(engine, setup, from)), |to| at("--to", to))?;
                values::grid(from, to, steps)
            }
        }
    }
}

/// The time at which the driven crank has turned so far.
pub(super) fn instant(option: &str, moment: Moment, engine: &dyn Engine, setup: &Setup) -> Result<f64, Failure> {
    match moment {
        Moment::At(t) => Ok(t),
        Moment::Turned(angle) => speed(engine, setup, 0.0).map(|speed| angle / speed).ok_or_else(|| {
            let what = "an angle says when only where a crank is driven at constant speed; write a time";
            Failure::option(option, what)
        }),
    }
}

/// A motion as far as it came.
pub(super) struct Moved {
    /// Its states, where they were kept.
    pub(super) trajectory: Trajectory,
    /// Points, defines and joint quantities of the states, where they were kept.
    pub(super) motions: Vec<Motion>,
    /// Why it ended early.
    pub(super) ended: Option<Failure>,
    /// The limit that a motion without an end came to.
    pub(super) limit: Option<String>,
    /// Degrees of freedom that the drivers leave at the first instant.
    pub(super) left: usize,
    /// Contacts that lift off on the way or press again.
    pub(super) contacts: Vec<ContactChange>,
}

/// How a motion is followed.
#[derive(Clone, Copy)]
pub(super) struct Walk<'a> {
    pub(super) engine: &'a dyn Engine,
    pub(super) setup: &'a Setup,
    pub(super) times: &'a [f64],
    pub(super) stop_at_events: bool,
    /// Nobody says where it ends: it goes as far as the mechanism does.
    pub(super) open_end: bool,
    pub(super) freedom: FreedomArgs,
    /// Points, defines and joint quantities as well.
    pub(super) reported: bool,
    pub(super) watch: &'a Watch,
}

impl Walk<'_> {
    /// The motion up to its first failure, to Ctrl-C or to where `visit` ends it, which is lent every state in its turn.
    /// What comes back has no states.
    pub(super) fn each(
        &self,
        visit: &mut dyn FnMut(&State, Option<&Motion>) -> ControlFlow<()>,
    ) -> Result<Moved, Failure> {
        let &Self { engine, setup, times, watch, .. } = self;
        // A long sweep fails at its start, when the drivers leave the motion open there.
        let first = times.first().copied().unwrap_or(0.0);
        let (start, _) = driven_state(engine, setup, first, self.freedom.least_norm)?;
        let (mut finished, mut last, mut why) = (0, None, None);
        let (mut contacts, touches) =
            (ContactWatch::default(), engine.model().forces.is_some_and(ForceModel::has_contacts));
        let mut step = |state: &State| {
            // A sweep may also pass through a position where the drivers lose their grip.
            if state.degrees_of_freedom_left > 0 && !self.freedom.least_norm {
                why = Some((state.t, self.open(state)));
                return ControlFlow::Break(());
            }
            let motion = self.reported.then(|| engine.motion(setup, state)).transpose();
            let motion = motion.map_err(|error| why = Some((state.t, Some(analysis(engine, &error)))));
            let Ok(motion) = motion else { return ControlFlow::Break(()) };
            visit(state, motion.as_ref())?;
            if touches {
                // Where there are no forces, nothing is said of contacts.
                let _ = engine.watch_contacts(setup, first, &mut contacts, state);
            }
            (finished, last) = (finished + 1, Some(state.t));
            watch.step(finished)
        };
        let observe = |reached: Reached<'_>| watch.observe(reached);
        let (mut trajectory, error) = engine.sweep_each(setup, times, self.stop_at_events, &observe, &mut step);
        let at_limit = matches!(error, Some(SolveError::StepRefused { .. } | SolveError::Singular { .. }));
        let ended = match (why, error) {
            (Some((at, failure)), _) => {
                trajectory.events.retain(|event| (event.t - first).abs() < (at - first).abs());
                trajectory.unwatched.retain(|unwatched| (unwatched.from - first).abs() < (at - first).abs());
                failure
            }
            (None, Some(SolveError::Stopped { total, .. })) => {
                let until = last.map_or(String::new(), |t| format!(", up to t = {}", rounded(t)));
                let how_far = format!("{finished} of {} finished{until}", count(total, "instant"));
                watch.interrupted().then_some(Failure::Interrupted(how_far))
            }
            (None, error) => error.map(|error| analysis(engine, &error)),
        };
        let (ended, limit) = match (ended, last) {
            (Some(Failure::Analysis(why)), Some(t)) if self.open_end && finished > 1 && at_limit => {
                let why = why.lines().next().unwrap_or_default().to_owned();
                (None, Some(format!("note: it goes as far as t = {}: {why}", rounded(t))))
            }
            (ended, _) => (ended, None),
        };
        let left = start.degrees_of_freedom_left;
        Ok(Moved { trajectory, motions: Vec::new(), ended, limit, left, contacts: contacts.changes })
    }

    /// The motion with its states, and with what is reported of them where that is wanted.
    pub(super) fn kept(&self) -> Result<Moved, Failure> {
        let (mut states, mut motions) = (Vec::new(), Vec::new());
        let mut moved = self.each(&mut |state, motion| {
            states.push(state.clone());
            motions.extend(motion.cloned());
            ControlFlow::Continue(())
        })?;
        moved.trajectory.states = states;
        Ok(Moved { motions, ..moved })
    }

    /// Why a state is none that the drivers determine.
    fn open(&self, state: &State) -> Option<Failure> {
        match self.engine.mobility(self.setup, &state.instant(), &state.q) {
            Ok(mobility) => fully_driven(self.engine, &mobility, state.t).err(),
            Err(error) => Some(analysis(self.engine, &error)),
        }
    }
}

/// What there is to say of a motion beside its numbers.
pub(super) fn note_motion(session: &mut Session<'_>, moved: &Moved) {
    let trajectory = &moved.trajectory;
    moved.limit.iter().for_each(|note| session.note(note));
    note_events(session, trajectory);
    moved.contacts.iter().for_each(|change| session.note(&format!("event: {change}")));
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

/// The names of the columns besides t, points and joint quantities included.
pub(super) fn column_names(model: &Model) -> Vec<String> {
    crate::present::grid::names(model, true).split_off(1)
}

/// Where a motion from an instant on may end when nobody says: after one turn of the slowest of the cranks that are driven
/// at constant speed, or after one unit of time.
pub(super) fn natural_end(engine: &dyn Engine, setup: &Setup, from: f64) -> f64 {
    from + speed(engine, setup, from).map_or(1.0, |speed| TAU / speed)
}

/// The speed of the slowest of the cranks that are driven at constant speed.
fn speed(engine: &dyn Engine, setup: &Setup, from: f64) -> Option<f64> {
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
    slowest.is_finite().then_some(slowest)
}
