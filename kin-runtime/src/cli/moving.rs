//! Motions, which all commands follow in the same way: from instant to instant, with the values of the requested
//! quantities.

use std::ops::ControlFlow;

use super::engine::{Arc, Engine};
use super::failure::Failure;
use super::force_notes::{contact, missing_force};
use super::instants::Instants;
use super::limit_search::Stop;
use super::options::FreedomArgs;
use super::session::Session;
use super::setup::Setup;
use super::solved::{analysis, driven_state, fully_driven, misfit, other_modes};
use super::watch::ProgressWatch;
use crate::arc::{ArcEnd, ArcPlace, SolutionArc};
use crate::error::SolveError;
use crate::forces::ContactChange;
use crate::measure::Measure;
use crate::model::ForceModel;
use crate::motion::Motion;
use crate::observer::Reached;
use crate::present::condition;
use crate::present::number::rounded;
use crate::present::record::InstantRow;
use crate::present::text::count;
use crate::solver::ContactWatch;
use crate::state::State;
use crate::trajectory::Trajectory;

/// A motion up to its end.
pub(super) struct Moved {
    /// Its states, if they were kept.
    pub(super) trajectory: Trajectory,
    /// Points, defines and joint quantities of the states, if they were kept.
    pub(super) motions: Vec<Motion>,
    /// The values of every requested quantity, if they were kept.
    pub(super) columns: Vec<Vec<f64>>,
    /// Why it ended early.
    pub(super) ended: Option<Failure>,
    /// Notes about its ends.
    pub(super) notes: Vec<String>,
    /// True if it ended at or near a limit before its last instant and this is no failure.
    pub(super) at_its_end: bool,
    /// Degrees of freedom that the drivers leave open at the first instant.
    pub(super) open: usize,
    /// Contacts that lift off or press again during the motion.
    pub(super) contacts: Vec<ContactChange>,
}

/// How a motion is followed.
#[derive(Clone, Copy)]
pub(super) struct FollowedMotion<'a> {
    pub(super) engine: &'a dyn Engine,
    pub(super) setup: &'a Setup,
    pub(super) instants: &'a Instants,
    pub(super) stop_at_events: bool,
    /// No end is given: a motion that ends at a limit is complete.
    pub(super) open_end: bool,
    pub(super) freedom: FreedomArgs,
    /// Whether points, defines and joint quantities are computed as well.
    pub(super) reported: bool,
    /// Whether a note says why forces among the quantities are not determined.
    pub(super) tells_missing: bool,
    /// The requested quantities.
    pub(super) measures: &'a [Measure],
    /// Whether angles among their values are in degrees.
    pub(super) degrees: bool,
    pub(super) watch: &'a ProgressWatch,
}

/// Called with every row; may end the motion.
type Visit<'v> = &'v mut dyn FnMut(&InstantRow<'_>) -> ControlFlow<()>;

/// A part of a motion, in one direction of time.
struct MotionLeg {
    trajectory: Trajectory,
    /// The note on the first force that is not determined.
    missing: Option<String>,
    ended: Option<Failure>,
    limit: Option<String>,
    open: usize,
    contacts: Vec<ContactChange>,
}

impl MotionLeg {
    /// Whether it reached its last instant, or an instant as close to its limit as can be solved.
    const fn is_whole(&self) -> bool {
        self.ended.is_none() && self.limit.is_none()
    }
}

/// Instants that are nearer to a limit than this, relative to the length of the motion, may have no solution: close to
/// a crossing of branches, rounding errors decide whether they have one.
const UNSOLVED_BESIDE_LIMIT: f64 = 0.01;

impl FollowedMotion<'_> {
    /// Follows the motion up to its first failure, to Ctrl-C or until `visit` ends it, and calls `visit` with every
    /// row. The result has no states. A motion in both directions from its start is followed backwards first.
    pub(super) fn each(&self, visit: Visit<'_>) -> Result<Moved, Failure> {
        let Instants { times, start, limits, notes, arc } = self.instants;
        if let Some(arc) = *arc {
            return self.along_arc(arc, visit);
        }
        let mut notes = notes.clone();
        notes.extend(times.get(*start).and_then(|first| other_modes(self.engine, self.setup, *first)));
        let (mut before, mut done) = (None, 0);
        if *start > 0 {
            let back: Vec<f64> = times[..=*start].iter().rev().copied().collect();
            let mut rows: Vec<(State, Option<Motion>, Vec<f64>)> = Vec::new();
            let leg = self.leg(&back, (0, limits[0].as_ref()), &mut |row| {
                rows.push((row.state.clone(), row.motion.cloned(), row.values.to_vec()));
                ControlFlow::Continue(())
            })?;
            done = rows.len().saturating_sub(1);
            if let (Some(stop), Some((last, ..)), true) = (&limits[0], rows.last(), leg.is_whole()) {
                notes.push(format!("note: it begins at t = {}: {}", rounded(stop.t), stop.text));
                self.at_limit(stop, last, visit)?;
            }
            // The start itself is the first row of what follows.
            for (state, motion, values) in rows.iter().skip(1).rev() {
                if visit(&InstantRow { state, motion: motion.as_ref(), values }).is_break() {
                    break;
                }
            }
            before = Some(leg);
        }
        let mut last = None;
        let keeps = limits[1].is_some();
        let mut leg = self.leg(&times[*start..], (done, limits[1].as_ref()), &mut |row| {
            if keeps {
                last = Some(row.state.clone());
            }
            visit(row)
        })?;
        if let (Some(stop), Some(last), true) = (&limits[1], &last, leg.is_whole()) {
            notes.push(format!("note: it ends at t = {}: {}", rounded(stop.t), stop.text));
            self.at_limit(stop, last, visit)?;
        }
        let at_its_end = leg.limit.is_some();
        notes.extend(leg.limit.take());
        notes.extend(before.as_mut().and_then(|first| first.missing.take()).or(leg.missing.take()));
        if let Some(first) = before {
            notes.extend(first.limit);
            leg.ended = first.ended.or(leg.ended);
            leg.trajectory = joined(first.trajectory, leg.trajectory);
            leg.contacts.splice(0..0, first.contacts.into_iter().rev());
        }
        let MotionLeg { trajectory, ended, open, contacts, .. } = leg;
        Ok(Moved { trajectory, motions: Vec::new(), columns: Vec::new(), ended, notes, at_its_end, open, contacts })
    }

    /// Calls `visit` with the configuration at a limit, if it was found. Quantities that depend on rates are NaN there.
    fn at_limit(&self, stop: &Stop, neighbour: &State, visit: Visit<'_>) -> Result<(), Failure> {
        let Some(q) = &stop.q else { return Ok(()) };
        let mut state = State { t: stop.t, q: q.clone(), ..neighbour.clone() };
        let elapsed = stop.t - neighbour.t;
        state.inputs.iter_mut().for_each(|input| *input = input.after(elapsed));
        self.without_rates(state, visit).map(|_| ())
    }

    /// Calls `visit` with a configuration and all quantities that depend on it alone; rates and accelerations are NaN.
    fn without_rates(&self, mut state: State, visit: Visit<'_>) -> Result<ControlFlow<()>, Failure> {
        let Self { engine, setup, .. } = *self;
        let say = |error| analysis(engine, &error);
        state.q_dot.fill(0.0);
        state.q_ddot.fill(0.0);
        let motion = engine.motion(setup, &state).map_err(say)?.without_rates();
        state.bodies.clone_from(&motion.bodies);
        state.points.clone_from(&motion.points);
        let values = self.values(&state).map_err(say)?;
        let known = |(value, measure): (f64, &Measure)| if measure.is_place() { value } else { f64::NAN };
        let values: Vec<f64> = values.into_iter().zip(self.measures).map(known).collect();
        state.q_dot.fill(f64::NAN);
        state.q_ddot.fill(f64::NAN);
        Ok(visit(&InstantRow { state: &state, motion: self.reported.then_some(&motion), values: &values }))
    }

    /// The motion along the arc of the solution curve; `visit` is called after the whole arc is solved.
    fn along_arc(&self, arc: Arc, visit: Visit<'_>) -> Result<Moved, Failure> {
        let Self { engine, setup, watch, .. } = *self;
        let say = |error| analysis(engine, &error);
        let mut trajectory = match engine.sweep_along_arc(setup, arc, &|reached| watch.observe(reached)) {
            Ok(trajectory) => trajectory,
            Err(SolveError::Stopped { .. }) if watch.interrupted() => {
                return Err(Failure::Interrupted("no state of the arc is finished".to_owned()));
            }
            Err(error) => return Err(misfit(engine, setup, arc.from, &error)),
        };
        for state in std::mem::take(&mut trajectory.states) {
            let flow = if state.q_dot.iter().any(|rate| rate.is_nan()) {
                self.without_rates(state, visit)?
            } else {
                let motion = self.reported.then(|| engine.motion(setup, &state)).transpose().map_err(say)?;
                let values = self.values(&state).map_err(say)?;
                visit(&InstantRow { state: &state, motion: motion.as_ref(), values: &values })
            };
            if flow.is_break() {
                break;
            }
        }
        let found = trajectory.arc.as_ref();
        let notes = found.map_or_else(Vec::new, arc_notes);
        let at_its_end =
            found.is_some_and(|arc| arc.ends.iter().any(|end| !matches!(end, ArcEnd::Closed | ArcEnd::Bound)));
        let (motions, columns, contacts) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Moved { trajectory, motions, columns, ended: None, notes, at_its_end, open: 0, contacts })
    }

    /// The values of the requested quantities, with angles in degrees if that is requested.
    fn values(&self, state: &State) -> Result<Vec<f64>, SolveError> {
        self.values_of(state, self.measures)
    }

    /// The values of some quantities, with angles in degrees if that is requested.
    pub(super) fn values_of(&self, state: &State, measures: &[Measure]) -> Result<Vec<f64>, SolveError> {
        let mut values = self.engine.measure(self.setup, state, measures)?;
        if self.degrees {
            values.iter_mut().zip(measures).for_each(|(value, measure)| *value *= measure.in_degrees());
        }
        Ok(values)
    }

    /// The motion in one direction of time, towards the limit `stop` if it is given; `done` instants were finished
    /// before.
    fn leg(&self, times: &[f64], (done, stop): (usize, Option<&Stop>), visit: Visit<'_>) -> Result<MotionLeg, Failure> {
        let &Self { engine, setup, watch, .. } = self;
        // Checked at the first instant, so that a mechanism that is not fully driven fails before a long sweep.
        let first = times.first().copied().unwrap_or(0.0);
        let (start, _) = driven_state(engine, setup, first, self.freedom.least_norm)?;
        let (mut finished, mut last, mut why) = (0, None, None);
        let (mut contacts, touches) =
            (ContactWatch::default(), engine.model().forces.is_some_and(ForceModel::has_contacts));
        let mut missing = None;
        let mut step = |state: &State| {
            // A sweep may also reach a position at which the drivers leave degrees of freedom open.
            if state.degrees_of_freedom_left > 0 && !self.freedom.least_norm {
                why = Some((state.t, self.open(state)));
                return ControlFlow::Break(());
            }
            let motion = self.reported.then(|| engine.motion(setup, state)).transpose();
            let row = motion.and_then(|motion| Ok((motion, self.values(state)?)));
            let row = row.map_err(|error| why = Some((state.t, Some(analysis(engine, &error)))));
            let Ok((motion, values)) = row else { return ControlFlow::Break(()) };
            if self.tells_missing && missing.is_none() {
                missing = missing_force((engine, self.setup), state, self.measures, &values);
            }
            visit(&InstantRow { state, motion: motion.as_ref(), values: &values })?;
            if touches {
                // Contacts are not watched where forces do not exist.
                let _ = engine.watch_contacts(setup, first, &mut contacts, state);
            }
            (finished, last) = (finished + 1, Some(state.t));
            watch.step(done + finished)
        };
        let observe = |reached: Reached<'_>| watch.observe(Reached { done: done + reached.done, ..reached });
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
            (Some(Failure::Analysis(_)), Some(t))
                if at_limit
                    && stop
                        .is_some_and(|stop| (stop.t - t).abs() <= UNSOLVED_BESIDE_LIMIT * (stop.t - first).abs()) =>
            {
                (None, None)
            }
            (Some(Failure::Analysis(why)), Some(t))
                if (self.open_end || stop.is_some()) && finished > 1 && at_limit =>
            {
                let why = why.lines().next().unwrap_or_default().to_owned();
                (None, Some(format!("note: it goes as far as t = {}: {why}", rounded(t))))
            }
            (ended, _) => (ended, None),
        };
        let open = start.degrees_of_freedom_left;
        Ok(MotionLeg { trajectory, missing, ended, limit, open, contacts: contacts.changes })
    }

    /// The motion with its states, with the values of the quantities as columns, and with motions if `reported`.
    pub(super) fn with_states(&self) -> Result<Moved, Failure> {
        let (mut states, mut motions) = (Vec::new(), Vec::new());
        let mut columns: Vec<Vec<f64>> = vec![Vec::with_capacity(self.instants.len()); self.measures.len()];
        let mut moved = self.each(&mut |row| {
            states.push(row.state.clone());
            motions.extend(row.motion.cloned());
            columns.iter_mut().zip(row.values).for_each(|(column, value)| column.push(*value));
            ControlFlow::Continue(())
        })?;
        moved.trajectory.states = states;
        Ok(Moved { motions, columns, ..moved })
    }

    /// The error for a state that the drivers do not determine.
    fn open(&self, state: &State) -> Option<Failure> {
        match self.engine.mobility(self.setup, &state.instant(), &state.q) {
            Ok(mobility) => fully_driven(self.engine, &mobility, state.t).err(),
            Err(error) => Some(analysis(self.engine, &error)),
        }
    }
}

/// Notes about the ends of an arc and what it passes.
fn arc_notes(arc: &SolutionArc) -> Vec<String> {
    let place = |place: &ArcPlace| match place.drivers.as_slice() {
        [] => format!("note: {place}"),
        drivers => format!("note: {place}: {} turns back", drivers.join(", ")),
    };
    let mut notes: Vec<String> = arc.places.iter().map(place).collect();
    let end = |which: &str, end: ArcEnd| {
        let hint = if end == ArcEnd::TooLong { "; --to says where it ends" } else { "" };
        format!("note: {which}: {end}{hint}")
    };
    match arc.ends {
        [ArcEnd::Closed, _] => {
            notes.push("note: the curve is closed: all its dead centres and cusps are listed".to_owned())
        }
        [first, last] => notes.extend([end("at the first row", first), end("at the last row", last)]),
    }
    notes
}

/// Two legs of one motion from a common start, the first of which went backwards.
fn joined(mut back: Trajectory, on: Trajectory) -> Trajectory {
    back.events.reverse();
    back.events.extend(on.events);
    back.unwatched.reverse();
    back.unwatched.extend(on.unwatched);
    back.fallbacks.reverse();
    back.fallbacks.extend(on.fallbacks);
    Trajectory { events: back.events, unwatched: back.unwatched, fallbacks: back.fallbacks, ..on }
}

/// Prints the notes about a motion.
pub(super) fn note_motion(session: &mut Session<'_>, moved: &Moved) {
    let trajectory = &moved.trajectory;
    moved.notes.iter().for_each(|note| session.note(note));
    note_events(session, trajectory);
    moved.contacts.iter().for_each(|change| session.note(&contact(change)));
    note_unwatched(session, trajectory);
    note_fallbacks(session, trajectory);
}

/// Notes where unilateral conditions met their limits.
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

/// Stretches that are listed one by one; further ones are counted.
const MAX_LISTED_STRETCHES: usize = 3;

/// Notes where unilateral conditions changed too fast to be watched, or the motion could not be solved.
fn note_unwatched(session: &mut Session<'_>, trajectory: &Trajectory) {
    for unwatched in trajectory.unwatched.iter().take(MAX_LISTED_STRETCHES) {
        session.note(&format!(
            "note: condition {unwatched}: it changes too fast there, or branches meet, and it may have met its limit more \
             often than reported; try more instants (--steps)"
        ));
    }
    if trajectory.unwatched.len() > MAX_LISTED_STRETCHES {
        session.note(&format!(
            "note: the same in {}",
            count(trajectory.unwatched.len() - MAX_LISTED_STRETCHES, "more place")
        ));
    }
}

/// Notes where full Newton took over from the plan. A motion that ended at a limit has no such note: there it always
/// takes over in the last steps, and the error has the reason.
fn note_fallbacks(session: &mut Session<'_>, trajectory: &Trajectory) {
    if trajectory.q_at_limit.is_some() {
        return;
    }
    if let Some(first) = trajectory.fallbacks.first() {
        let steps = count(trajectory.fallbacks.len(), "internal step");
        session.note(&format!("note: full Newton took over from the plan on {steps}, first {first}"));
    }
}
