//! The watch over all conditions of a sweep.

use super::event::{Crossing, Event};
use super::root::{Value, bracket, tolerance};
use super::sample::{Sample, samples};
use super::shape::{Shape, shape};
use crate::equations::Equations;
use crate::error::SolveError;
use crate::motion::poses;
use crate::state::State;

/// How often an unclear interval is halved.
const HALVINGS: usize = 9;

/// The state of a motion at a time between two states that it passed; none where it cannot be solved.
pub(crate) type Between<'f> = dyn FnMut(&mut Equations<'_>, f64) -> Option<State> + 'f;

/// What was seen of the conditions of a sweep so far.
#[derive(Clone, Debug)]
pub(crate) struct Watch {
    /// The last state, and its samples.
    state: State,
    samples: Vec<Sample>,
    /// Whether each condition is satisfied; unknown where the sweep begins at the limit, until it moves.
    satisfied: Vec<Option<bool>>,
    /// Conditions violated at the first instant.
    violated_at_start: Vec<usize>,
    events: Vec<Event>,
}

impl Watch {
    /// Begins at a state; none where there is nothing to watch.
    pub(crate) fn start(equations: &mut Equations<'_>, state: &State) -> Result<Option<Self>, SolveError> {
        if equations.model.conditions.is_empty() {
            return Ok(None);
        }
        let samples = samples(equations, state)?;
        let known = |s: &Sample| (s.value.abs() > s.noise).then_some(s.value > 0.0);
        let satisfied: Vec<Option<bool>> = samples.iter().map(known).collect();
        let violated_at_start = (0..satisfied.len()).filter(|&k| satisfied[k] == Some(false)).collect();
        Ok(Some(Self { state: state.clone(), samples, satisfied, violated_at_start, events: Vec::new() }))
    }

    /// Looks at the motion from the last state to `to`; `between` gives its states in between, `to` included.
    ///
    /// What happened is noted in [`events`](Self::events), in the order in which the motion meets it.
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
            // A step on the way need not be closed to the last digit.
            for (end, better) in ends.iter_mut().zip(samples(equations, &closed)?) {
                *end = better;
            }
        }
        let before = self.events.len();
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
            let mut search = Search { equations, between, condition, step: h, side, found: Vec::new() };
            search.between(&start, &end, HALVINGS);
            self.satisfied[condition] = Some(search.side);
            for Found { crossing, ends } in search.found {
                let event = self.event(equations, between, to, condition, crossing, ends)?;
                self.events.push(event);
            }
        }
        self.violated_at_start.sort_unstable();
        self.events[before..].sort_by(|a, b| (a.t * h.signum()).total_cmp(&(b.t * h.signum())));
        self.state = to.clone();
        self.samples = ends;
        Ok(())
    }

    /// The state at a located event.
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
                // The nearer end is known.
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

    /// Keeps the first event, with those at the same instant.
    pub(crate) fn keep_first(&mut self) {
        if let Some(first) = self.events.first().map(|event| event.t) {
            self.events.retain(|event| (event.t - first).abs() <= 2.0 * tolerance(first.abs()));
        }
    }

    /// Everything that was seen: the events, and the conditions that were violated at the first instant.
    pub(crate) fn finish(mut self) -> (Vec<Event>, Vec<usize>) {
        let at_limit = |k: &usize| self.satisfied[*k].is_none() && self.samples[*k].value <= 0.0;
        let still: Vec<usize> = (0..self.satisfied.len()).filter(at_limit).collect();
        self.violated_at_start.extend(still);
        self.violated_at_start.sort_unstable();
        (self.events, self.violated_at_start)
    }
}

/// A limit that was met, and the interval in which.
struct Found {
    crossing: Crossing,
    ends: [Value; 2],
}

/// The search for one condition between two states.
struct Search<'s, 'e, 'a, 'b> {
    equations: &'e mut Equations<'a>,
    between: &'b mut Between<'s>,
    condition: usize,
    /// Time from one state to the other, with its sign.
    step: f64,
    /// Whether the condition is satisfied where the search has come to.
    side: bool,
    found: Vec<Found>,
}

impl Search<'_, '_, '_, '_> {
    /// The condition at a time in between; none where the motion cannot be solved there.
    fn sample(&mut self, t: f64) -> Option<Sample> {
        let state = (self.between)(self.equations, t)?;
        samples(self.equations, &state).ok()?.get(self.condition).copied()
    }

    fn between(&mut self, a: &Sample, b: &Sample, halvings: usize) {
        match shape(a, b) {
            Shape::Clear | Shape::Still => {}
            Shape::Monotone => self.monotone(a, b),
            Shape::Turning => self.turning(a, b),
            Shape::Unclear => {
                let middle = if halvings > 0 { self.sample(a.t + 0.5 * (b.t - a.t)) } else { None };
                match middle {
                    Some(middle) => {
                        self.between(a, &middle, halvings - 1);
                        self.between(&middle, b, halvings - 1);
                    }
                    None => self.monotone(a, b),
                }
            }
        }
    }

    /// One crossing where the ends lie on different sides.
    fn monotone(&mut self, a: &Sample, b: &Sample) {
        if b.side_after(self.step) == self.side {
            return;
        }
        let sign = if self.side { 1.0 } else { -1.0 };
        let value = |s: &Sample| Value { t: s.t, f: sign * s.value, rate: sign * s.rate };
        let narrow = tolerance(a.t.abs().max(b.t.abs()));
        let ends = bracket(value(a), value(b), narrow, |t| self.sample(t).as_ref().map(value));
        self.found.push(Found { crossing: if self.side { Crossing::Violated } else { Crossing::Restored }, ends });
        self.side = !self.side;
    }

    /// The extremum first, where it is on the way to the limit.
    fn turning(&mut self, a: &Sample, b: &Sample) {
        let sign = if self.side { 1.0 } else { -1.0 };
        let slope = |s: &Sample| sign * self.step.signum() * s.rate;
        if slope(a) >= 0.0 {
            return self.monotone(a, b);
        }
        let towards = self.step.signum();
        // Falling towards the limit, then rising: −ḟ changes from positive to negative.
        let value = |s: &Sample| Value { t: s.t, f: -sign * towards * s.rate, rate: -sign * towards * s.acceleration };
        let narrow = tolerance(a.t.abs().max(b.t.abs()));
        let mut beyond = None;
        let ends = bracket(value(a), value(b), narrow, |t| {
            let sample = self.sample(t)?;
            if sign * sample.value < -sample.noise {
                // Already beyond the limit: how far it goes does not matter.
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
            self.found.push(Found { crossing: Crossing::Touched, ends });
        }
        self.monotone(&extremum, b);
    }
}
