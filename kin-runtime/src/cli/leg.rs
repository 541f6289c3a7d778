//! A part of a motion, in one direction of time, and the same part in the other direction.

use super::failure::Failure;
use super::followed::{FollowedMotion, Moved, Visit};
use super::force_notes::missing_force;
use super::limit_search::{Stop, is_limit};
use super::solved::{analysis, driven_state, fully_driven};
use crate::error::SolveError;
use crate::events::{Crossing, Event};
use crate::forces::ContactChange;
use crate::motion::Motion;
use crate::nonlinear::root::tolerance;
use crate::observer::Reached;
use crate::present::number::rounded;
use crate::present::record::InstantRow;
use crate::present::text::count;
use crate::solver::ContactWatch;
use crate::state::State;
use crate::trajectory::Trajectory;
use std::collections::BTreeSet;
use std::ops::ControlFlow;

/// A part of a motion, in one direction of time.
pub(super) struct MotionLeg {
    pub(super) trajectory: Trajectory,
    /// The note on the first force that is not determined.
    pub(super) missing: Option<String>,
    pub(super) ended: Option<Failure>,
    pub(super) limit: Option<String>,
    pub(super) open: usize,
    pub(super) contacts: Vec<ContactChange>,
}

impl MotionLeg {
    /// Whether it reached its last instant, or an instant as close to its limit as can be solved.
    pub(super) const fn is_whole(&self) -> bool {
        self.ended.is_none() && self.limit.is_none() && !self.trajectory.stopped
    }

    /// A motion that consists of this part alone.
    pub(super) fn moved(self, notes: Vec<String>, at_its_end: bool) -> Moved {
        let Self { trajectory, ended, open, contacts, .. } = self;
        Moved { trajectory, motions: Vec::new(), columns: Vec::new(), ended, notes, at_its_end, open, contacts }
    }

    /// Ends the motion at its first event.
    pub(super) fn stop_at_first_event(&mut self) {
        let Self { trajectory, contacts, .. } = self;
        let Some(end) = trajectory.events.first().map(|event| event.t) else { return };
        trajectory.stopped = true;
        trajectory.events.retain(|event| event.t - end <= 2.0 * tolerance(end.abs()));
        trajectory.unwatched.retain(|unwatched| unwatched.from < end);
        trajectory.unwatched.iter_mut().for_each(|unwatched| unwatched.to = unwatched.to.min(end));
        trajectory.fallbacks.retain(|fallback| fallback.t <= end);
        contacts.retain(|change| change.t <= end);
    }

    /// The same part of the motion in the other direction of time, which ended at the instant `end`: events in the
    /// opposite order and with the opposite sense, and what is violated and lifted off there.
    fn turned_round(mut self, end: f64) -> Self {
        let trajectory = &mut self.trajectory;
        let mut violated: BTreeSet<usize> = std::mem::take(&mut trajectory.violated_at_start).into_iter().collect();
        for event in &mut trajectory.events {
            event.crossing = match event.crossing {
                Crossing::Violated => {
                    violated.insert(event.condition);
                    Crossing::Restored
                }
                Crossing::Restored => {
                    violated.remove(&event.condition);
                    Crossing::Violated
                }
                Crossing::Touched => Crossing::Touched,
            };
        }
        trajectory.violated_at_start = violated.into_iter().collect();
        trajectory.events.reverse();
        trajectory.unwatched.iter_mut().for_each(|unwatched| std::mem::swap(&mut unwatched.from, &mut unwatched.to));
        trajectory.unwatched.reverse();
        trajectory.fallbacks.reverse();
        let mut lifted = BTreeSet::new();
        for change in &self.contacts {
            let key = (change.name, change.rope);
            let _ = if change.lifts_off { lifted.insert(key) } else { lifted.remove(&key) };
        }
        self.contacts.retain(|change| !is_lifted_at_start(change));
        self.contacts.iter_mut().for_each(|change| change.lifts_off = !change.lifts_off);
        self.contacts.reverse();
        let lifted = lifted.into_iter();
        let at_end = lifted.map(|(name, rope)| ContactChange { name, t: end, lifts_off: true, within: 0.0, rope });
        self.contacts.splice(0..0, at_end);
        self
    }
}

/// Whether this is a contact that is lifted off at the first instant, or a rope that is slack there, and not one that
/// lifts off or goes slack later.
fn is_lifted_at_start(change: &ContactChange) -> bool {
    change.lifts_off && change.within == 0.0
}

/// One motion of a part before its start, in the direction of time, and a part after it.
pub(super) fn joined(before: MotionLeg, mut after: MotionLeg) -> MotionLeg {
    let (MotionLeg { trajectory: first, ended, mut contacts, .. }, on) = (before, &mut after.trajectory);
    on.violated_at_start = first.violated_at_start;
    on.events.splice(0..0, first.events);
    on.unwatched.splice(0..0, first.unwatched);
    on.fallbacks.splice(0..0, first.fallbacks);
    on.q_at_limit = first.q_at_limit.or(on.q_at_limit.take());
    after.contacts.retain(|change| !is_lifted_at_start(change));
    contacts.append(&mut after.contacts);
    MotionLeg { ended: ended.or(after.ended), contacts, ..after }
}

/// A row of a part of a motion.
pub(super) struct LegRow {
    pub(super) state: State,
    pub(super) motion: Option<Motion>,
    pub(super) values: Vec<f64>,
}

/// Instants that are nearer to a limit than this, relative to the length of the motion, may have no solution: close to
/// a crossing of branches, rounding errors decide whether they have one.
const UNSOLVED_BESIDE_LIMIT: f64 = 0.01;

impl FollowedMotion<'_> {
    /// The part of a motion before its start, which is followed backwards: its rows in the order in which they are solved,
    /// from the start on, and the rest as it is in the direction of time. It does not stop at events, as the first that is
    /// solved is the last before the start.
    pub(super) fn backwards(
        &self,
        times: &[f64],
        start: usize,
        stop: Option<&Stop>,
    ) -> Result<(Vec<LegRow>, MotionLeg), Failure> {
        let back: Vec<f64> = times[..=start].iter().rev().copied().collect();
        let mut rows: Vec<LegRow> = Vec::new();
        let leg = Self { stop_at_events: false, ..*self }.leg(&back, (0, stop), &mut |row| {
            rows.push(LegRow { state: row.state.clone(), motion: row.motion.cloned(), values: row.values.to_vec() });
            ControlFlow::Continue(())
        })?;
        let before: BTreeSet<usize> = leg.trajectory.violated_at_start.iter().copied().collect();
        let mut leg = leg.turned_round(rows.last().map_or(times[start], |row| row.state.t));
        // A condition that is at its limit at the start is met there if it is violated on one side only.
        if let (Some(LegRow { state, .. }), Some(after)) = (rows.first(), self.violated_after(&times[start..])) {
            for &condition in before.symmetric_difference(&after) {
                let crossing = if after.contains(&condition) { Crossing::Violated } else { Crossing::Restored };
                let name = self.engine.model().conditions[condition].name;
                let (t, state) = (state.t, state.clone());
                leg.trajectory.events.push(Event { name, condition, t, crossing, within: 0.0, state });
            }
        }
        Ok((rows, leg))
    }

    /// The conditions that are violated just after the first of these instants; `None` without conditions or a second
    /// instant.
    fn violated_after(&self, times: &[f64]) -> Option<BTreeSet<usize>> {
        let step = times.get(..2).filter(|_| !self.engine.model().conditions.is_empty())?;
        let go_on = |_: Reached<'_>| ControlFlow::Continue(());
        let moved = self.engine.sweep_each(self.setup, step, false, &go_on, &mut |_| ControlFlow::Continue(()));
        Some(moved.0.violated_at_start.into_iter().collect())
    }

    /// The motion in one direction of time, towards the limit `stop` if it is given; `done` instants were finished
    /// before.
    pub(super) fn leg(
        &self,
        times: &[f64],
        (done, stop): (usize, Option<&Stop>),
        visit: Visit<'_>,
    ) -> Result<MotionLeg, Failure> {
        let &Self { engine, setup, watch, .. } = self;
        // Checked at the first instant, so that a mechanism that is not fully driven fails before a long sweep.
        let first = times.first().copied().unwrap_or(0.0);
        let (start, _) = driven_state(engine, setup, first, self.freedom.least_norm)?;
        let (mut finished, mut last, mut why) = (0, None, None);
        let (mut contacts, touches) = (ContactWatch::default(), engine.model().has_one_sided_forces());
        let mut missing = None;
        let mut step = |state: &State| {
            // The row of the limit is that of the search, whether a sweep solves it or not.
            if finished == times.len() && stop.is_some_and(|stop| stop.t == state.t) {
                return ControlFlow::Continue(());
            }
            // A sweep may also reach a position at which the drivers leave degrees of freedom open.
            if state.degrees_of_freedom_left > 0 && !self.freedom.least_norm {
                why = Some((state.t, self.open(state)));
                return ControlFlow::Break(());
            }
            let row = self.row(state).map_err(|error| why = Some((state.t, Some(analysis(engine, &error)))));
            let Ok((motion, values)) = row else { return ControlFlow::Break(()) };
            if self.tells_missing && missing.is_none() {
                missing = missing_force((engine, self.setup), state, self.measures, &values);
            }
            visit(&InstantRow { state, motion: motion.as_ref(), values: &values })?;
            if touches {
                // Contacts and ropes are not watched where forces do not exist.
                let _ = engine.watch_contacts(setup, first, &mut contacts, state);
            }
            (finished, last) = (finished + 1, Some(state.t));
            watch.step(done + finished)
        };
        let observe = |reached: Reached<'_>| watch.observe(Reached { done: done + reached.done, ..reached });
        // Between the last instant and the limit, which a sweep need not reach, conditions are watched as well.
        let watched = stop.filter(|_| !engine.model().conditions.is_empty());
        let until: Vec<f64> = times.iter().copied().chain(watched.map(|stop| stop.t)).collect();
        let (mut trajectory, error) = engine.sweep_each(setup, &until, self.stop_at_events, &observe, &mut step);
        let error = error.filter(|error| finished < times.len() || matches!(error, SolveError::Stopped { .. }));
        let at_limit = error.as_ref().is_some_and(is_limit);
        let ended = match (why, error) {
            (Some((at, failure)), _) => {
                trajectory.events.retain(|event| (event.t - first).abs() < (at - first).abs());
                trajectory.unwatched.retain(|unwatched| (unwatched.from - first).abs() < (at - first).abs());
                failure
            }
            (None, Some(SolveError::Stopped { .. })) => {
                let until = last.map_or(String::new(), |t| format!(", up to t = {}", rounded(t)));
                let how_far = format!("{finished} of {} finished{until}", count(times.len(), "instant"));
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

    /// The error for a state that the drivers do not determine.
    fn open(&self, state: &State) -> Option<Failure> {
        match self.engine.mobility(self.setup, &state.instant(), &state.q) {
            Ok(mobility) => fully_driven(self.engine, &mobility, state.t).err(),
            Err(error) => Some(analysis(self.engine, &error)),
        }
    }
}
