//! The search for the events of one condition, or for the corners of one, between two states.

use super::sample::{Sample, samples};
use super::shape::{CurveShape, doubt, is_known, shape};
use crate::equations::Equations;
use crate::nonlinear::root::{Value, bracket, tolerance};
use crate::planned::interior::IRREGULAR_FRACTIONS;
use crate::results::event::Crossing;
use crate::state::State;
use std::collections::HashMap;

/// Largest number of times that an interval is halved; a shorter one counts as an instant.
const HALVINGS: usize = 30;
/// Largest number of successive halvings in which the samples predict one another: a course that is still unclear then
/// is zero within rounding.
const HALVINGS_OF_KNOWN: usize = 9;
/// Largest number of times that an interval around instants at which the motion cannot be solved is made narrower.
const NARROWINGS: usize = 12;

/// A function that gives the state of a motion at a time between two states; `None` where it cannot be solved.
pub(crate) type Between<'f> = dyn FnMut(&mut Equations<'_>, f64) -> Option<State> + 'f;

/// A located event and the interval that contains it.
pub(super) struct LocatedEvent {
    pub(super) crossing: Crossing,
    pub(super) ends: [Value; 2],
}

/// The number of halvings of an interval.
#[derive(Clone, Copy, Default)]
struct Depth {
    halved: usize,
    /// The number of successive halvings in which the samples predicted one another.
    known: usize,
}

/// The search for the events of one condition between two states.
pub(super) struct EventSearch<'s, 'e, 'a, 'b> {
    pub(super) equations: &'e mut Equations<'a>,
    pub(super) between: &'b mut Between<'s>,
    /// All samples at the times computed in this step, shared by all conditions.
    pub(super) known: &'b mut HashMap<u64, Option<Vec<Sample>>>,
    /// The index of the sample that is watched: that of a condition, or of an expression at whose zeros one has a corner.
    pub(super) watched: usize,
    /// Time from the first state to the second, with its sign.
    pub(super) step: f64,
    /// Whether the condition is satisfied at the time that the search has reached.
    pub(super) side: bool,
    /// The number of samples that halving may still take.
    pub(super) patience: usize,
    pub(super) found: Vec<LocatedEvent>,
    /// The intervals, from and to, in which the condition was not watched.
    pub(super) lost: Vec<[f64; 2]>,
}

impl EventSearch<'_, '_, '_, '_> {
    /// The condition at a time in between; `None` where the motion cannot be solved there.
    fn sample(&mut self, t: f64) -> Option<Sample> {
        let Self { equations, between, known, .. } = self;
        let all = known.entry(t.to_bits()).or_insert_with(|| {
            let state = between(equations, t)?;
            samples(equations, &state).ok()
        });
        all.as_ref()?.get(self.watched).copied()
    }

    /// Searches a step between the corners of the condition. Where the condition rests at both ends, which show nothing of a
    /// rise and return between them, it is sampled at places within the step.
    pub(super) fn step(&mut self, a: &Sample, b: &Sample, doubt: f64, corners: &[[f64; 2]]) {
        if !corners.is_empty() {
            return self.between_corners(a, b, corners);
        }
        if !(a.rests() && b.rests()) {
            return self.between(a, b, doubt, Depth::default());
        }
        let within: Vec<Sample> =
            IRREGULAR_FRACTIONS.iter().filter_map(|fraction| self.sample(a.t + fraction * (b.t - a.t))).collect();
        if within.iter().all(|m| m.rests() && (m.value - a.value).abs() <= m.noise.max(a.noise)) {
            return self.between(a, b, doubt, Depth::default());
        }
        let mut from = a;
        for to in within.iter().chain([b]) {
            self.between(from, to, f64::INFINITY, Depth::default());
            from = to;
        }
    }

    /// Searches a step from corner to corner.
    fn between_corners(&mut self, a: &Sample, b: &Sample, corners: &[[f64; 2]]) {
        let mut from = *a;
        for [before, after] in corners {
            let (Some(before), Some(after)) = (self.sample(*before), self.sample(*after)) else { continue };
            if before.t != from.t {
                self.between(&from, &before, f64::INFINITY, Depth::default());
            }
            self.monotone(&before, &after);
            from = after;
        }
        if from.t != b.t {
            self.between(&from, b, f64::INFINITY, Depth::default());
        }
    }

    /// Searches between two samples, whose interpolation is accurate to `doubt`.
    fn between(&mut self, a: &Sample, b: &Sample, doubt: f64, depth: Depth) {
        match shape(a, b, doubt) {
            CurveShape::Unclear if depth.halved == HALVINGS || depth.known == HALVINGS_OF_KNOWN => self.monotone(a, b),
            CurveShape::Unclear => match self.middle(a, b) {
                Some(middle) => self.halve([a, &middle, b], doubt, depth),
                None => self.without_middle(a, b, depth),
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

    /// Searches an interval in whose middle the motion cannot be solved: the parts beside its middle half by themselves,
    /// if it can be solved at their ends; the rest by the shape that both ends suggest. It is recorded as unwatched where
    /// they suggest none.
    fn without_middle(&mut self, a: &Sample, b: &Sample, depth: Depth) {
        if self.patience > 1 && depth.halved < NARROWINGS {
            let [before, after] = [0.25, 0.75].map(|x| self.sample(a.t + x * (b.t - a.t)));
            self.patience -= 2;
            if before.is_some() || after.is_some() {
                let depth = Depth { halved: depth.halved + 1, known: 0 };
                let places = [Some(*a), before, after, Some(*b)];
                let solved: Vec<Sample> = places.into_iter().flatten().collect();
                solved.windows(2).for_each(|pair| self.between(&pair[0], &pair[1], f64::INFINITY, depth));
                return;
            }
        }
        let alone = if self.patience > 0 { shape(a, b, 0.0) } else { CurveShape::Unclear };
        if alone == CurveShape::Unclear {
            self.lose(a.t, b.t);
        }
        self.take(alone, a, b);
    }

    /// Records an interval in which the condition was not watched.
    fn lose(&mut self, from: f64, to: f64) {
        match self.lost.last_mut() {
            Some([_, end]) if *end == from => *end = to,
            _ => self.lost.push([from, to]),
        }
    }

    /// Locates one crossing where the ends lie on different sides of zero.
    fn monotone(&mut self, a: &Sample, b: &Sample) {
        if b.side_after(self.step) == self.side {
            return;
        }
        let sign = if self.side { 1.0 } else { -1.0 };
        let value = |s: &Sample| Value { t: s.t, f: sign * s.value, rate: sign * s.rate };
        let narrow = tolerance(a.t.abs().max(b.t.abs()));
        let mut is_solved = true;
        let ends = bracket(value(a), value(b), narrow, |t| {
            let sample = self.sample(t);
            is_solved &= sample.is_some();
            sample.as_ref().map(value)
        });
        if !is_solved && (ends[1].t - ends[0].t).abs() > narrow {
            // The instant of the event is known to lie in this interval only, in which there may be further ones.
            self.lose(ends[0].t, ends[1].t);
        }
        self.found
            .push(LocatedEvent { crossing: if self.side { Crossing::Violated } else { Crossing::Restored }, ends });
        self.side = !self.side;
    }

    /// Locates the extremum first, where the course approaches the limit, and then the crossings beside it.
    fn turning(&mut self, a: &Sample, b: &Sample) {
        let sign = if self.side { 1.0 } else { -1.0 };
        let slope = |s: &Sample| sign * self.step.signum() * s.rate;
        // g falls towards the limit and then rises, or the other way around: −ġ or ġ changes from positive to negative.
        let falls = slope(a) < 0.0;
        // At the limit, the value at the first end does not bracket the return.
        let leaves = slope(a) > 0.0 && a.value.abs() <= a.noise && b.side_after(self.step) != self.side;
        if !falls && !leaves {
            return self.monotone(a, b);
        }
        let towards = if falls { -sign * self.step.signum() } else { sign * self.step.signum() };
        let value = |s: &Sample| Value { t: s.t, f: towards * s.rate, rate: towards * s.acceleration };
        let narrow = tolerance(a.t.abs().max(b.t.abs()));
        let (mut beyond, mut is_solved) = (None, true);
        let ends = bracket(value(a), value(b), narrow, |t| {
            let sample = self.sample(t);
            is_solved &= sample.is_some();
            let sample = sample?;
            if falls && sign * sample.value < -sample.noise {
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
        let is_located = is_solved || (ends[1].t - ends[0].t).abs() <= narrow;
        let Some(extremum) = self.sample(t).filter(|_| is_located) else {
            // The extremum was not seen, and the condition may have passed its limit there.
            self.lose(ends[0].t, ends[1].t);
            return self.monotone(a, b);
        };
        if falls && extremum.touches(narrow) {
            self.found.push(LocatedEvent { crossing: Crossing::Touched, ends });
        }
        self.monotone(&extremum, b);
    }
}
