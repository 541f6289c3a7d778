//! Sets of parameters on their way from instant to instant.

use super::poses::{Limits, Poses, Question, copy_lane};
use super::sweep::{End, Outcome};
use crate::lanes::{Lanes, Octet, Pack};
use crate::mechanism::Mechanism;
use crate::plan::Depth;
use crate::planned::predict::is_wild;
use crate::planned::{Limit, Step};
use crate::scalar::Scalar;
use crate::signal::Instant;
use crate::workspace::Array;

/// Eight sets on their way.
pub(super) struct Motion<M: Mechanism> {
    pub(super) parameters: M::Parameters<Octet>,
    pub(super) modes: M::Coordinates<Octet>,
    pub(super) predicted: M::Coordinates<Octet>,
    margins: M::Rows<Octet>,
    pub(super) poses: Poses<M::Coordinates<Octet>, Octet>,
}

impl<M: Mechanism> Motion<M> {
    /// Room for them.
    pub(super) fn nothing() -> Self {
        let nothing = |_| Octet::default();
        Self {
            parameters: Array::generate(nothing),
            modes: Array::generate(nothing),
            predicted: Array::generate(nothing),
            margins: Array::generate(nothing),
            poses: Poses::nothing(),
        }
    }

    /// q + h q̇ + ½ h² q̈; in lanes where the bend of a coordinate means nothing, beside a limit, q itself, as
    /// [`Planned`](crate::Planned) does.
    #[inline(always)]
    pub(super) fn predict(&mut self, h: f64) {
        let Poses { q, q_dot, q_ddot, .. } = &self.poses;
        let (step, half) = (Octet::from_f64(h), Octet::from_f64(0.5 * h));
        // A quick look, as there.
        let mut tame = true;
        let rates = q_dot.as_ref().iter().zip(q_ddot.as_ref());
        for ((to, q), (v, a)) in self.predicted.as_mut().iter_mut().zip(q.as_ref()).zip(rates) {
            let bend = half * *a;
            tame &= (step * bend).is_within(1.0);
            *to = *q + step * (*v + bend);
        }
        if !tame {
            self.tame(h);
        }
    }

    #[cold]
    #[inline(never)]
    fn tame(&mut self, h: f64) {
        let Poses { q, q_dot, q_ddot, .. } = &self.poses;
        for lane in 0..Octet::COUNT {
            let of = |numbers: &[Octet]| -> M::Coordinates<f64> { Array::generate(|k| numbers[k].lane(lane)) };
            let (v, a) = (of(q_dot.as_ref()), of(q_ddot.as_ref()));
            if is_wild(M::model(), h, [v.as_ref(), a.as_ref()]) {
                copy_lane(self.predicted.as_mut(), q.as_ref(), lane, lane);
            }
        }
    }

    #[inline(never)]
    pub(super) fn solve(&mut self, mechanism: &M, at: &Instant<'_, Octet>) -> Option<Limits<Octet>> {
        let modes = &self.modes.as_ref()[..M::model().plan.modes.len()];
        let (parameters, start) = (self.parameters.as_ref(), self.predicted.as_ref());
        let question = Question { parameters, at, modes, start, depth: Depth::Acceleration };
        self.poses.solve(mechanism, &question, &mut self.margins)
    }

    /// Goes on in the lanes that have passed limits that only the kept rows have.
    #[cold]
    #[inline(never)]
    pub(super) fn pass(&mut self, mechanism: &M, at: &Instant<'_, Octet>, limits: &mut Limits<Octet>) {
        let (mut modes, count) = (self.modes, M::model().plan.modes.len());
        let (parameters, start) = (self.parameters.as_ref(), self.predicted.as_ref());
        let kept = &self.modes.as_ref()[..count];
        let question = Question { parameters, at, modes: kept, start, depth: Depth::Acceleration };
        self.poses.pass(mechanism, &question, &mut modes.as_mut()[..count], limits);
        self.modes = modes;
    }

    /// Ends the lanes that are not good, and lets them repeat one that is; false where there is none.
    #[cold]
    #[inline(never)]
    pub(super) fn mask<S>(&mut self, instant: usize, limits: &Limits<Octet>, out: &mut [Outcome<S>]) -> bool {
        let margins = self.poses.margin;
        // Groups of lanes behind the last set have no place of their own, and are nobody's example.
        let mut ended = [true; Octet::COUNT];
        let ends = out.iter_mut().flat_map(|(_, ends)| ends);
        for (lane, (end, ended)) in ends.zip(&mut ended).enumerate() {
            if !self.poses.is_good(lane) {
                let limit = |(place, margin)| Step::of_margin(M::model(), place).map(|step| Limit { step, margin });
                let limit = limits[lane].and_then(limit);
                end.get_or_insert(End { instant, margin: margins.lane(lane), limit });
            }
            *ended = end.is_some();
        }
        let Some(first) = ended.iter().position(|ended| !ended) else { return false };
        let (parameters, modes, poses) = (self.parameters, self.modes, self.poses);
        for lane in (0..Octet::COUNT).filter(|lane| ended[*lane]) {
            // One of its own group, where there is one: nobody sees the others.
            let group = lane - lane % Lanes::COUNT;
            let other = (group..group + Lanes::COUNT).find(|other| !ended[*other]).unwrap_or(first);
            copy_lane(self.parameters.as_mut(), parameters.as_ref(), other, lane);
            copy_lane(self.modes.as_mut(), modes.as_ref(), other, lane);
            self.poses.copy_lane(&poses, other, lane);
            self.poses.margin.set(lane, margins.lane(other));
        }
        true
    }
}
