//! The watch over all conditions of a sweep.

use super::sample::{Sample, samples};
use super::shape::{CurveShape, doubt, is_known, shape};
use crate::analysis::poses::poses;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::nonlinear::root::{Value, bracket, tolerance};
use crate::planned::interior::FRACTIONS;
use crate::results::event::{Crossing, Event, Unwatched};
use crate::state::State;
use std::collections::HashMap;

/// Largest number of times that an interval is halved; a shorter one counts as an instant.
const HALVINGS: usize = 30;
/// Largest number of successive halvings in which the samples predict one another: a course that is still unclear then
/// is zero within rounding.
const HALVINGS_OF_KNOWN: usize = 9;
/// Largest number of samples by halving for one condition in one step of the sweep.
const MOST_SAMPLES: usize = 1 << 14;
/// The lower bound of that number, which is reduced after every step in which it did not suffice.
const FEWEST_SAMPLES: usize = 1 << 6;

/// A function that gives the state of a motion at a time between two states; `None` where it cannot be solved.
pub(crate) type Between<'f> = dyn FnMut(&mut Equations<'_>, f64) -> Option<State> + 'f;

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
        let samples = samples(equations, state)?;
        let known = |s: &Sample| (s.value.abs() > s.noise).then_some(s.value > 0.0);
        let satisfied: Vec<Option<bool>> = samples.iter().map(known).collect();
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
        let mut known = HashMap::new();
        for (condition, &end) in ends.iter().enumerate() {
            let start = self.samples[condition];
            let side = self.satisfied[condition].unwrap_or_else(|| {
                let side = start.side_after(h);
                if !side {
                    self.violated_at_start.push(condition);
                }
                side
            });
            let (equations, between) = (&mut *equations, &mut *between);
            // The previous step serves as the third sample, unless the direction is reversed or the lengths of the
            // steps differ much.
            let doubt = self.earlier.get(condition).map_or(f64::INFINITY, |earlier| doubt(earlier, &start, &end));
            let patience = self.patience[condition];
            let (known, found, lost) = (&mut known, Vec::new(), Vec::new());
            let mut search = EventSearch { equations, between, known, condition, step: h, side, patience, found, lost };
            search.step(&start, &end, doubt);
            self.satisfied[condition] = Some(search.side);
            self.patience[condition] =
                if search.patience > 0 { MOST_SAMPLES } else { (patience / 4).max(FEWEST_SAMPLES) };
            let EventSearch { found, lost, .. } = search;
            let name = equations.model.conditions[condition].name;
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
        let t = if a.f.abs() <= b.f.abs() { a.t } else { b.t };
        let name = equations.model.conditions[condition].name;
        let open = (b.t - a.t).abs();
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
            self.unwatched.iter_mut().filter(|unwatched| !is_before(unwatched.to)).for_each(|it| it.to = first);
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

/// A located event and the interval that contains it.
struct LocatedEvent {
    crossing: Crossing,
    ends: [Value; 2],
}

/// The number of halvings of an interval.
#[derive(Clone, Copy, Default)]
struct Depth {
    halved: usize,
    /// The number of successive halvings in which the samples predicted one another.
    known: usize,
}

/// The search for the events of one condition between two states.
struct EventSearch<'s, 'e, 'a, 'b> {
    equations: &'e mut Equations<'a>,
    between: &'b mut Between<'s>,
    /// The samples of all conditions at the times computed in this step, shared by all conditions.
    known: &'b mut HashMap<u64, Option<Vec<Sample>>>,
    condition: usize,
    /// Time from the first state to the second, with its sign.
    step: f64,
    /// Whether the condition is satisfied at the time that the search has reached.
    side: bool,
    /// The number of samples that halving may still take.
    patience: usize,
    found: Vec<LocatedEvent>,
    /// The intervals, from and to, in which the condition was not watched.
    lost: Vec<[f64; 2]>,
}

impl EventSearch<'_, '_, '_, '_> {
    /// The condition at a time in between; `None` where the motion cannot be solved there.
    fn sample(&mut self, t: f64) -> Option<Sample> {
        let Self { equations, between, known, .. } = self;
        let all = known.entry(t.to_bits()).or_insert_with(|| {
            let state = between(equations, t)?;
            samples(equations, &state).ok()
        });
        all.as_ref()?.get(self.condition).copied()
    }

    /// Searches a step. Where the condition rests at both ends, which show nothing of a rise and return between them, it is
    /// sampled at places within the step.
    fn step(&mut self, a: &Sample, b: &Sample, doubt: f64) {
        if !(a.rests() && b.rests()) {
            return self.between(a, b, doubt, Depth::default());
        }
        let within: Vec<Sample> =
            FRACTIONS.iter().filter_map(|fraction| self.sample(a.t + fraction * (b.t - a.t))).collect();
        if within.iter().all(|m| m.rests() && (m.value - a.value).abs() <= m.noise.max(a.noise)) {
            return self.between(a, b, doubt, Depth::default());
        }
        let mut from = a;
        for to in within.iter().chain([b]) {
            self.between(from, to, f64::INFINITY, Depth::default());
            from = to;
        }
    }

    /// Searches between two samples, whose interpolation is accurate to `doubt`.
    fn between(&mut self, a: &Sample, b: &Sample, doubt: f64, depth: Depth) {
        match shape(a, b, doubt) {
            CurveShape::Unclear if depth.halved == HALVINGS || depth.known == HALVINGS_OF_KNOWN => self.monotone(a, b),
            CurveShape::Unclear => match self.middle(a, b) {
                Some(middle) => self.halve([a, &middle, b], doubt, depth),
                None => self.without_middle(a, b),
            },
            known => self.take(known, a, b),
        }
    }

    /// Searches an interval with a sample in its middle: the whole interval at once if that sample makes its shape
    /// clear, its halves otherwise.
    fn halve(&mut self, [a, middle, b]: [&Sample; 3], before: f64, depth: Depth) {
        let doubt = self::doubt(a, middle, b);
        let whole = if doubt < before { shape(a, b, doubt) } else { CurveShape::Unclear };
        if whole != CurveShape::Unclear {
            return self.take(whole, a, b);
        }
        let known = if is_known(a, b, doubt) { depth.known + 1 } else { 0 };
        let depth = Depth { halved: depth.halved + 1, known };
        self.between(a, middle, doubt, depth);
        self.between(middle, b, doubt, depth);
    }

    /// Searches an interval whose shape is known.
    fn take(&mut self, shape: CurveShape, a: &Sample, b: &Sample) {
        match shape {
            CurveShape::Clear | CurveShape::Still => {}
            CurveShape::Turning => self.turning(a, b),
            CurveShape::Monotone | CurveShape::Unclear => self.monotone(a, b),
        }
    }

    /// The sample in the middle, if the number of samples allows another one.
    fn middle(&mut self, a: &Sample, b: &Sample) -> Option<Sample> {
        self.patience = self.patience.checked_sub(1)?;
        self.sample(a.t + 0.5 * (b.t - a.t))
    }

    /// Searches without a sample in between: uses the shape that both ends suggest, and records the interval as
    /// unwatched where they suggest none.
    fn without_middle(&mut self, a: &Sample, b: &Sample) {
        let alone = if self.patience > 0 { shape(a, b, 0.0) } else { CurveShape::Unclear };
        if alone == CurveShape::Unclear {
            match self.lost.last_mut() {
                Some([_, to]) if *to == a.t => *to = b.t,
                _ => self.lost.push([a.t, b.t]),
            }
        }
        self.take(alone, a, b);
    }

    /// Locates one crossing where the ends lie on different sides of zero.
    fn monotone(&mut self, a: &Sample, b: &Sample) {
        if b.side_after(self.step) == self.side {
            return;
        }
        let sign = if self.side { 1.0 } else { -1.0 };
        let value = |s: &Sample| Value { t: s.t, f: sign * s.value, rate: sign * s.rate };
        let narrow = tolerance(a.t.abs().max(b.t.abs()));
        let ends = bracket(value(a), value(b), narrow, |t| self.sample(t).as_ref().map(value));
        self.found
            .push(LocatedEvent { crossing: if self.side { Crossing::Violated } else { Crossing::Restored }, ends });
        self.side = !self.side;
    }

    /// Locates the extremum first, where the course approaches the limit, and then the crossings beside it.
    fn turning(&mut self, a: &Sample, b: &Sample) {
        let sign = if self.side { 1.0 } else { -1.0 };
        let slope = |s: &Sample| sign * self.step.signum() * s.rate;
        if slope(a) >= 0.0 {
            return self.monotone(a, b);
        }
        let towards = self.step.signum();
        // g falls towards the limit and then rises: −ġ changes from positive to negative.
        let value = |s: &Sample| Value { t: s.t, f: -sign * towards * s.rate, rate: -sign * towards * s.acceleration };
        let narrow = tolerance(a.t.abs().max(b.t.abs()));
        let mut beyond = None;
        let ends = bracket(value(a), value(b), narrow, |t| {
            let sample = self.sample(t)?;
            if sign * sample.value < -sample.noise {
                // This sample lies beyond the limit, so the search for the extremum can stop.
                beyond = Some(sample);
                return Some(Value { t, f: 0.0, rate: 0.0 });
            }
            Some(value(&sample))
        });
        if let Some(beyond) = beyond {
            self.monotone(a, &beyond);
            return self.monotone(&beyond, b);
        }
        let t = if ends[0].f.abs() <= ends[1].f.abs() { ends[0].t } else { ends[1].t };
        let Some(extremum) = self.sample(t) else { return self.monotone(a, b) };
        if extremum.touches(narrow) {
            self.found.push(LocatedEvent { crossing: Crossing::Touched, ends });
        }
        self.monotone(&extremum, b);
    }
}
