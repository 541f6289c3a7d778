//! The watch over all conditions of a sweep.

use super::sample::{Sample, samples};
use super::search::{Between, EventSearch, LocatedEvent};
use super::shape::doubt;
use crate::analysis::poses::poses;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::nonlinear::root::{Value, tolerance};
use crate::results::event::{Crossing, Event, Unwatched};
use crate::state::State;
use std::collections::HashMap;

/// Largest number of samples by halving for one condition in one step of the sweep.
const MOST_SAMPLES: usize = 1 << 14;
/// The lower bound of that number, which is reduced after every step in which it did not suffice.
const FEWEST_SAMPLES: usize = 1 << 6;

/// Watches the conditions of a sweep and collects its events.
#[derive(Clone, Debug)]
pub(crate) struct EventWatch {
    /// The last state and the samples of its conditions.
    state: State,
    samples: Vec<Sample>,
    /// The samples of the state before the last; empty at the start.
    earlier: Vec<Sample>,
    /// The number of samples that each condition may take in the next step.
    patience: Vec<usize>,
    /// Whether each condition is satisfied; `None` for one that begins at its limit, until it moves.
    satisfied: Vec<Option<bool>>,
    /// Conditions violated at the first instant.
    violated_at_start: Vec<usize>,
    events: Vec<Event>,
    unwatched: Vec<Unwatched>,
}

/// The result of the watch over a sweep.
pub(crate) struct WatchResult {
    pub(crate) events: Vec<Event>,
    pub(crate) violated_at_start: Vec<usize>,
    pub(crate) unwatched: Vec<Unwatched>,
}

impl EventWatch {
    /// Starts the watch at a state; `None` where there are no conditions.
    pub(crate) fn start(equations: &mut Equations<'_>, state: &State) -> Result<Option<Self>, SolveError> {
        if equations.model.conditions.is_empty() {
            return Ok(None);
        }
        let mut samples = samples(equations, state)?;
        samples.iter_mut().for_each(|sample| sample.start_at_event(tolerance(state.t.abs())));
        let known = |s: &Sample| (s.value.abs() > s.noise).then_some(s.value > 0.0);
        let satisfied: Vec<Option<bool>> = samples.iter().take(equations.model.conditions.len()).map(known).collect();
        let violated_at_start = (0..satisfied.len()).filter(|&k| satisfied[k] == Some(false)).collect();
        Ok(Some(Self {
            state: state.clone(),
            earlier: Vec::new(),
            patience: vec![MOST_SAMPLES; samples.len()],
            samples,
            satisfied,
            violated_at_start,
            events: Vec::new(),
            unwatched: Vec::new(),
        }))
    }

    /// Examines the motion from the last state to `to`. `between` gives the states in between, including `to`.
    ///
    /// Events are appended to [`events`](Self::events) in the order in which the motion meets them.
    pub(crate) fn pass(
        &mut self,
        equations: &mut Equations<'_>,
        to: &State,
        between: &mut Between<'_>,
    ) -> Result<(), SolveError> {
        let h = to.t - self.state.t;
        if h == 0.0 {
            return Ok(());
        }
        let mut ends = samples(equations, to)?;
        if ends.iter().any(Sample::is_near)
            && let Some(closed) = between(equations, to.t)
        {
            // An internal step need not have converged to the last digit.
            for (end, better) in ends.iter_mut().zip(samples(equations, &closed)?) {
                *end = better;
            }
        }
        let (before, unwatched_before) = (self.events.len(), self.unwatched.len());
        let (mut known, mut first_corner) = (HashMap::new(), equations.model.conditions.len());
        for (condition, info) in equations.model.conditions.iter().enumerate() {
            let side = self.satisfied[condition].unwrap_or_else(|| {
                let side = self.samples[condition].side_after(h);
                if !side {
                    self.violated_at_start.push(condition);
                }
                side
            });
            let corners = first_corner..first_corner + info.corners;
            first_corner = corners.end;
            // The intervals that contain the corners of g, in the order of the motion. Those of expressions inside of others
            // come first, because these have corners there, too.
            let mut places: Vec<[f64; 2]> = Vec::new();
            let (mut found, mut lost) = (Vec::new(), Vec::new());
            for watched in corners.chain([condition]) {
                let (start, end) = (&self.samples[watched], &ends[watched]);
                let side = if watched == condition { side } else { start.side_after(h) };
                // The previous step serves as the third sample, unless the direction is reversed or the lengths of the
                // steps differ much.
                let doubt = self.earlier.get(watched).map_or(f64::INFINITY, |earlier| doubt(earlier, start, end));
                let patience = self.patience[watched];
                let (equations, between, known) = (&mut *equations, &mut *between, &mut known);
                let mut search = EventSearch {
                    equations,
                    between,
                    known,
                    watched,
                    step: h,
                    side,
                    patience,
                    found: Vec::new(),
                    lost: Vec::new(),
                };
                search.step(start, end, doubt, &places);
                self.patience[watched] =
                    if search.patience > 0 { MOST_SAMPLES } else { (patience / 4).max(FEWEST_SAMPLES) };
                lost.append(&mut search.lost);
                if watched == condition {
                    self.satisfied[condition] = Some(search.side);
                    found = search.found;
                } else {
                    let crossed = search.found.iter().filter(|place| place.crossing != Crossing::Touched);
                    places.extend(crossed.map(|place| place.ends.map(|end| end.t)));
                    places.sort_by(|a, b| (a[0] * h.signum()).total_cmp(&(b[0] * h.signum())));
                }
            }
            let name = info.name;
            self.unwatched.extend(lost.into_iter().map(|[from, to]| Unwatched { name, condition, from, to }));
            for LocatedEvent { crossing, ends } in found {
                let event = self.event(equations, between, to, condition, crossing, ends)?;
                self.events.push(event);
            }
        }
        self.violated_at_start.sort_unstable();
        self.events[before..].sort_by(|a, b| (a.t * h.signum()).total_cmp(&(b.t * h.signum())));
        self.join_unwatched(unwatched_before);
        self.state = to.clone();
        self.earlier = core::mem::replace(&mut self.samples, ends);
        Ok(())
    }

    /// Joins the unwatched intervals of this step, from the index `new` on, with those of the previous step that end
    /// where they begin.
    fn join_unwatched(&mut self, new: usize) {
        for next in self.unwatched.split_off(new) {
            let known = self.unwatched.iter_mut().rev();
            match known.take(2 * self.samples.len()).find(|k| k.condition == next.condition && k.to == next.from) {
                Some(before) => before.to = next.to,
                None => self.unwatched.push(next),
            }
        }
    }

    /// The event with the state at which it was located.
    fn event(
        &self,
        equations: &mut Equations<'_>,
        between: &mut Between<'_>,
        to: &State,
        condition: usize,
        crossing: Crossing,
        [a, b]: [Value; 2],
    ) -> Result<Event, SolveError> {
        let name = equations.model.conditions[condition].name;
        let open = (b.t - a.t).abs();
        let t = if a.f.abs() <= b.f.abs() { a.t } else { b.t };
        let (t, within, mut state) = match between(equations, t) {
            Some(state) => (t, open, state),
            None => {
                // The state cannot be solved there, so the nearer end of the step is reported.
                let nearer = (t - self.state.t).abs() <= (to.t - t).abs();
                let state = if nearer { self.state.clone() } else { to.clone() };
                (state.t, open.max((t - state.t).abs()), state)
            }
        };
        poses(equations, &mut state)?;
        Ok(Event { name, condition, t, crossing, within, state })
    }

    /// The events so far.
    pub(crate) fn events(&self) -> &[Event] {
        &self.events
    }

    /// Keeps the first event and others at the same instant.
    pub(crate) fn keep_first(&mut self) {
        if let Some(first) = self.events.first().map(|event| event.t) {
            self.events.retain(|event| (event.t - first).abs() <= 2.0 * tolerance(first.abs()));
            // The motion ends at the first event, so later unwatched intervals are dropped or cut.
            let forwards = self.unwatched.first().is_none_or(|unwatched| unwatched.from < unwatched.to);
            let is_before = |t: f64| if forwards { t < first } else { t > first };
            self.unwatched.retain(|unwatched| is_before(unwatched.from));
            self.unwatched
                .iter_mut()
                .filter(|unwatched| !is_before(unwatched.to))
                .for_each(|interval| interval.to = first);
        }
    }

    /// Ends the watch and returns its results.
    pub(crate) fn finish(mut self) -> WatchResult {
        let at_limit = |k: &usize| self.satisfied[*k].is_none() && self.samples[*k].value <= 0.0;
        let still: Vec<usize> = (0..self.satisfied.len()).filter(at_limit).collect();
        self.violated_at_start.extend(still);
        self.violated_at_start.sort_unstable();
        let Self { events, violated_at_start, unwatched, .. } = self;
        WatchResult { events, violated_at_start, unwatched }
    }
}
