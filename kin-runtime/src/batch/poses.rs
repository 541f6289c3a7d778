//! q, q̇ and q̈ of a block, each lane judged for itself.

use crate::lanes::Lanes;
use crate::mechanism::Mechanism;
use crate::plan::{Depth, Plan, Solved, StepKind};
use crate::planned::passed::{self, Passed};
use crate::scalar::Scalar;
use crate::signal::Instant;
use crate::workspace::Array;

/// A state of every lane.
pub(super) struct Poses<M: Mechanism> {
    pub(super) q: M::Coordinates<Lanes>,
    pub(super) q_dot: M::Coordinates<Lanes>,
    pub(super) q_ddot: M::Coordinates<Lanes>,
    /// The smallest margin.
    pub(super) margin: Lanes,
    /// Which lanes are good.
    pub(super) good: [bool; Lanes::COUNT],
}

/// For every lane the first margin that is not good, its place and its value.
pub(super) type Limits = [Option<(usize, f64)>; Lanes::COUNT];

/// What a block is solved at.
#[derive(Clone, Copy)]
pub(super) struct Question<'b> {
    pub(super) parameters: &'b [Lanes],
    pub(super) at: Instant<'b, Lanes>,
    /// A sign for every mode.
    pub(super) modes: &'b [Lanes],
    pub(super) start: &'b [Lanes],
    pub(super) depth: Depth,
}

impl<M: Mechanism> Clone for Poses<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Poses<M> {}

impl<M: Mechanism> Poses<M> {
    /// Zeros, none of them good.
    pub(super) fn nothing() -> Self {
        let zeros = M::Coordinates::<Lanes>::generate(|_| Lanes::default());
        Self { q: zeros, q_dot: zeros, q_ddot: zeros, margin: Lanes::default(), good: [false; Lanes::COUNT] }
    }

    /// Solves the block. Lanes that are not good mean nothing afterwards, and their margin is a number.
    #[inline(always)]
    pub(super) fn solve(&mut self, mechanism: &M, question: &Question<'_>) -> Limits {
        let mut margins = M::Rows::<Lanes>::generate(|_| Lanes::default());
        let margins = &mut margins.as_mut()[..M::model().plan.margins];
        let sum = self.ask(mechanism, question, margins);
        self.margin = margins.iter().fold(1.0.into(), |least: Lanes, margin| least.least(*margin));
        // A quick look that may see trouble where there is none: far from a limit the margin is near 1, and the sum of all
        // sizes is finite where they are.
        let far = (self.margin - 1.0.into()).is_within(1.0 - 2.0 * Plan::SMALLEST_MARGIN);
        self.good = [true; Lanes::COUNT];
        if far & sum.is_within(f64::MAX) {
            return [None; Lanes::COUNT];
        }
        self.judge(mechanism, question, margins)
    }

    /// Asks the plan, and gives the sum of the sizes of all numbers.
    #[inline(always)]
    fn ask(&mut self, mechanism: &M, question: &Question<'_>, margins: &mut [Lanes]) -> Lanes {
        let Question { parameters, at, modes, start, depth } = question;
        let Self { q, q_dot, q_ddot, .. } = self;
        let solved = Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins };
        let lengths = mechanism.solve_with(parameters, at, modes, start, *depth, solved);
        debug_assert!(lengths.is_ok(), "the columns have been counted");
        let sizes = |numbers: &[Lanes]| numbers.iter().fold(Lanes::default(), |sum, x| sum + x.abs());
        let numbers = sizes(self.q.as_ref()) + sizes(self.q_dot.as_ref()) + sizes(self.q_ddot.as_ref());
        numbers + sizes(margins) + at.t.abs()
    }

    /// Lane by lane, where one of them may be bad.
    #[cold]
    #[inline(never)]
    fn judge(&mut self, mechanism: &M, question: &Question<'_>, margins: &mut [Lanes]) -> Limits {
        let mut limits = [None; Lanes::COUNT];
        for (lane, limit) in limits.iter_mut().enumerate() {
            *limit = self.judge_lane(question, margins, lane);
        }
        // An iteration goes on until all lanes have converged: one that does not makes all of them fail.
        let iterates = M::model().plan.steps.iter().any(|step| matches!(step.kind, StepKind::Newton(_)));
        if iterates {
            for (lane, limit) in limits.iter_mut().enumerate() {
                if !self.good[lane] {
                    *limit = self.alone(mechanism, question, margins, lane);
                }
            }
        }
        limits
    }

    fn judge_lane(&mut self, question: &Question<'_>, margins: &[Lanes], lane: usize) -> Option<(usize, f64)> {
        let of = |x: &Lanes| x.to_array()[lane];
        let finite = |numbers: &[Lanes]| numbers.iter().all(|x| of(x).is_finite());
        let margin = margins.iter().map(of).fold(1.0, f64::min);
        let numbers = finite(self.q.as_ref()) && finite(self.q_dot.as_ref()) && finite(self.q_ddot.as_ref());
        let known = margins.iter().all(|margin| !of(margin).is_nan()) && of(&question.at.t).is_finite();
        self.good[lane] = numbers && known && margin > Plan::SMALLEST_MARGIN;
        let margin = if known && margin.is_finite() { margin } else { 0.0 };
        set(&mut self.margin, lane, margin);
        margins.iter().map(of).enumerate().find(|(_, margin)| *margin <= Plan::SMALLEST_MARGIN)
    }

    /// One lane in all lanes, so that no other stands in its way.
    fn alone(
        &mut self,
        mechanism: &M,
        question: &Question<'_>,
        margins: &mut [Lanes],
        lane: usize,
    ) -> Option<(usize, f64)> {
        let spread = |x: &Lanes| Lanes::from(x.to_array()[lane]);
        let mut parameters = M::Parameters::<Lanes>::generate(|_| Lanes::default());
        let [mut modes, mut start] = [M::Coordinates::<Lanes>::generate(|_| Lanes::default()); 2];
        let copy = |to: &mut [Lanes], from: &[Lanes]| to.iter_mut().zip(from).for_each(|(to, x)| *to = spread(x));
        copy(parameters.as_mut(), question.parameters);
        copy(modes.as_mut(), question.modes);
        copy(start.as_mut(), question.start);
        let inputs: alloc::vec::Vec<_> = question.at.inputs.iter().map(|u| u.map(|x| spread(&x))).collect();
        let own = Question {
            parameters: parameters.as_ref(),
            at: Instant { t: spread(&question.at.t), inputs: &inputs },
            modes: &modes.as_ref()[..question.modes.len()],
            start: start.as_ref(),
            depth: question.depth,
        };
        let mut poses = Self::nothing();
        poses.ask(mechanism, &own, margins);
        let limit = poses.judge_lane(&own, margins, lane);
        if poses.good[lane] {
            self.copy_lane(&poses, lane, lane);
        }
        set(&mut self.margin, lane, poses.margin.to_array()[lane]);
        self.good[lane] = poses.good[lane];
        limit
    }

    /// Lane by lane what [`Planned`](crate::Planned) does where redundant rows contradict: the signs that closures have
    /// behind limits that only the kept rows have, in `modes`, which the question has, too.
    #[cold]
    #[inline(never)]
    pub(super) fn pass(&mut self, mechanism: &M, question: &Question<'_>, modes: &mut [Lanes], limits: &mut Limits) {
        let plan = &M::model().plan;
        if plan.watched().next().is_none() {
            return;
        }
        let mut margins = M::Rows::<Lanes>::generate(|_| Lanes::default());
        let margins = &mut margins.as_mut()[..plan.margins];
        let mut closures = M::Coordinates::<Lanes>::generate(|_| Lanes::default());
        let closures = &mut closures.as_mut()[..modes.len()];
        let lengths = mechanism.closures_with(question.parameters, &question.at, question.start, closures);
        debug_assert!(lengths.is_ok(), "the columns have been counted");
        for (lane, limit) in limits.iter_mut().enumerate().filter(|(_, limit)| limit.is_some()) {
            // Once more, for all its margins.
            self.alone(mechanism, question, margins, lane);
            if !passed::is_missed(plan, |place| margins[place].to_array()[lane]) {
                continue;
            }
            let of = |numbers: &[Lanes]| {
                let mut own = M::Coordinates::<f64>::generate(|_| 0.0);
                own.as_mut().iter_mut().zip(numbers).for_each(|(own, x)| *own = x.to_array()[lane]);
                own
            };
            let (kept, closures, mut signs) = (of(question.modes), of(closures), of(question.modes));
            let (count, margin) = (modes.len(), self.margin);
            let passed = Passed::new(&kept.as_ref()[..count], &closures.as_ref()[..count], &[]);
            for attempt in passed.attempts() {
                passed.signs(attempt, &mut signs.as_mut()[..count]);
                let spread = |place: usize| signs.as_ref().get(place).map_or(Lanes::default(), |sign| (*sign).into());
                let own = M::Coordinates::<Lanes>::generate(spread);
                self.alone(mechanism, &Question { modes: &own.as_ref()[..count], ..*question }, margins, lane);
                if self.good[lane] {
                    modes.iter_mut().zip(signs.as_ref()).for_each(|(mode, sign)| set(mode, lane, *sign));
                    *limit = None;
                    break;
                }
                self.margin = margin;
            }
        }
    }

    /// What is in lane `from` of `other` into lane `to`.
    pub(super) fn copy_lane(&mut self, other: &Self, from: usize, to: usize) {
        copy_lane(self.q.as_mut(), other.q.as_ref(), from, to);
        copy_lane(self.q_dot.as_mut(), other.q_dot.as_ref(), from, to);
        copy_lane(self.q_ddot.as_mut(), other.q_ddot.as_ref(), from, to);
    }

    /// Zeros in the lanes that are not good.
    #[inline(always)]
    pub(super) fn clear_bad(&mut self) {
        if self.good != [true; Lanes::COUNT] {
            let nothing = Self::nothing();
            for lane in 0..Lanes::COUNT {
                if !self.good[lane] {
                    self.copy_lane(&nothing, lane, lane);
                }
            }
        }
    }
}

/// A number into a lane.
pub(super) fn set(to: &mut Lanes, lane: usize, value: f64) {
    let mut lanes = to.to_array();
    lanes[lane] = value;
    *to = Lanes::new(lanes);
}

/// Lane `from` of every number into lane `to`.
pub(super) fn copy_lane(numbers: &mut [Lanes], others: &[Lanes], from: usize, to: usize) {
    for (number, other) in numbers.iter_mut().zip(others) {
        set(number, to, other.to_array()[from]);
    }
}
