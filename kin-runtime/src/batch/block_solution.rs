//! q, q̇ and q̈ of a block; every lane is accepted or refused independently.

use crate::mechanism::Mechanism;
use crate::plan::{Depth, Plan, Solved};
use crate::planned::accurate_solution::solve_accurately;
use crate::planned::lists::Margins;
use crate::scalar::Scalar;
use crate::scalar::lanes::Octet;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// A state of every lane; `Q` is an array of its own or a slice of the results.
#[derive(Clone, Copy)]
pub(super) struct BlockSolution<Q> {
    pub(super) q: Q,
    pub(super) q_dot: Q,
    pub(super) q_ddot: Q,
    /// The smallest margin.
    pub(super) margin: Octet,
    /// Which lanes have a solution.
    pub(super) good: [bool; Octet::COUNT],
}

/// For every lane the index and the value of the first margin that is too small.
pub(super) type Limits = [Option<(usize, f64)>; Octet::COUNT];

/// The problem of a block.
#[derive(Clone, Copy)]
pub(super) struct Question<'b> {
    pub(super) parameters: &'b [Octet],
    /// A reference, since copying a value that has just been written in parts stalls the processor.
    pub(super) at: &'b Instant<'b, Octet>,
    /// A sign for every mode.
    pub(super) modes: &'b [Octet],
    pub(super) start: &'b [Octet],
    pub(super) depth: Depth,
}

impl<Q: Array<Octet>> BlockSolution<Q> {
    /// Zeros, marked as having no solution.
    pub(super) fn nothing() -> Self {
        let [q, q_dot, q_ddot] = [(); 3].map(|()| Q::filled(Octet::default()));
        Self { q, q_dot, q_ddot, margin: Octet::default(), good: [false; Octet::COUNT] }
    }
}

impl<Q: AsRef<[Octet]> + AsMut<[Octet]>> BlockSolution<Q> {
    /// Solves the block; `margins` is a buffer for the margins of the plan. Returns `None` if all lanes are solved. In
    /// other lanes the numbers have no meaning, but the margin is not NaN.
    #[inline(always)]
    pub(super) fn solve<M: Mechanism>(
        &mut self,
        mechanism: &M,
        question: &Question<'_>,
        margins: &mut Margins<M, Octet>,
    ) -> Option<Limits> {
        let sum = self.solve_by_plan(mechanism, question, margins.as_mut());
        self.margin = margins.least();
        // A quick test that may fail although all is well: far from a limit the margin is near 1, and the sum of all
        // numbers is finite if they are finite and not very large.
        let far = (self.margin - Octet::from_f64(1.0)).is_within(1.0 - 2.0 * Plan::SMALLEST_MARGIN);
        self.good = [true; Octet::COUNT];
        if far & sum.is_within(f64::MAX) {
            return None;
        }
        Some(self.judge(mechanism, question, margins.as_mut()))
    }

    /// Solves by the plan, and returns the sum of all numbers, which is finite only if each of them is.
    #[inline(always)]
    fn solve_by_plan<M: Mechanism>(&mut self, mechanism: &M, question: &Question<'_>, margins: &mut [Octet]) -> Octet {
        let Question { parameters, at, modes, start, depth } = question;
        let Self { q, q_dot, q_ddot, .. } = self;
        let solved = Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins };
        let lengths = solve_accurately(mechanism, parameters, (at, modes), start, *depth, solved);
        debug_assert!(lengths.is_ok(), "the columns have been counted");
        // Several independent sums, so that additions can overlap.
        let sum = |numbers: &[Octet]| numbers.iter().fold(Octet::default(), |sum, x| sum + *x);
        let (q, q_dot, q_ddot) = (sum(self.q.as_ref()), sum(self.q_dot.as_ref()), sum(self.q_ddot.as_ref()));
        (q + q_dot) + (q_ddot + (sum(margins) + at.t))
    }

    /// Checks the lanes one by one.
    #[cold]
    #[inline(never)]
    fn judge<M: Mechanism>(&mut self, mechanism: &M, question: &Question<'_>, margins: &mut [Octet]) -> Limits {
        let mut limits = core::array::from_fn(|lane| self.judge_lane(question, margins, lane));
        // An iteration runs until all lanes have converged, so that one lane that does not converge makes all of them
        // fail.
        if M::model().plan.iterates() {
            for (lane, limit) in limits.iter_mut().enumerate() {
                if !self.is_good(lane) {
                    *limit = self.solve_lane_alone(mechanism, question, margins, lane);
                }
            }
        }
        limits
    }

    fn judge_lane(&mut self, question: &Question<'_>, margins: &[Octet], lane: usize) -> Option<(usize, f64)> {
        let in_lane = |x: &Octet| x.lane(lane);
        let finite = |numbers: &[Octet]| numbers.iter().all(|x| in_lane(x).is_finite());
        let margin = margins.iter().map(in_lane).fold(1.0, f64::min);
        let numbers = finite(self.q.as_ref()) && finite(self.q_dot.as_ref()) && finite(self.q_ddot.as_ref());
        let known = margins.iter().all(|margin| !in_lane(margin).is_nan()) && in_lane(&question.at.t).is_finite();
        self.good[lane] = numbers && known && margin > Plan::SMALLEST_MARGIN;
        let margin = if known && margin.is_finite() { margin } else { 0.0 };
        self.margin.set(lane, margin);
        margins.iter().map(in_lane).enumerate().find(|(_, margin)| *margin <= Plan::SMALLEST_MARGIN)
    }

    /// Solves again with one lane copied to all lanes, so that it does not depend on the others.
    fn solve_lane_alone<M: Mechanism>(
        &mut self,
        mechanism: &M,
        question: &Question<'_>,
        margins: &mut [Octet],
        lane: usize,
    ) -> Option<(usize, f64)> {
        let mut parameters = M::Parameters::<Octet>::filled(Octet::default());
        let [mut modes, mut start] = [M::Coordinates::<Octet>::filled(Octet::default()); 2];
        spread_lane(parameters.as_mut(), question.parameters, lane);
        spread_lane(modes.as_mut(), question.modes, lane);
        spread_lane(start.as_mut(), question.start, lane);
        let mut inputs = M::Inputs::<Octet>::filled(Signal::constant(Octet::default()));
        for (to, u) in inputs.as_mut().iter_mut().zip(question.at.inputs) {
            *to = u.map(|x| spread(x, lane));
        }
        let question_of_lane = Question {
            parameters: parameters.as_ref(),
            at: &Instant { t: spread(question.at.t, lane), inputs: inputs.as_ref() },
            modes: &modes.as_ref()[..question.modes.len()],
            start: start.as_ref(),
            depth: question.depth,
        };
        let mut poses = BlockSolution::<M::Coordinates<Octet>>::nothing();
        let mut found = Margins::<M, Octet>::filled(Octet::default());
        poses.solve_by_plan(mechanism, &question_of_lane, found.as_mut());
        let limit = poses.judge_lane(&question_of_lane, found.as_ref(), lane);
        copy_lane(margins, found.as_ref(), lane, lane);
        if poses.is_good(lane) {
            self.copy_lane(&poses, lane, lane);
        }
        self.margin.set(lane, poses.margin.lane(lane));
        self.good[lane] = poses.is_good(lane);
        limit
    }

    /// Whether a lane is solved.
    pub(super) fn is_good(&self, lane: usize) -> bool {
        self.good[lane]
    }

    /// Marks a lane as solved, with its least margin.
    pub(super) fn accept(&mut self, lane: usize, margin: f64) {
        self.good[lane] = true;
        self.margin.set(lane, margin);
    }

    /// Marks a lane as not solved.
    pub(super) fn refuse(&mut self, lane: usize) {
        self.good[lane] = false;
    }

    /// Copies lane `from` of `other` to lane `to`.
    pub(super) fn copy_lane(&mut self, other: &BlockSolution<impl AsRef<[Octet]>>, from: usize, to: usize) {
        copy_lane(self.q.as_mut(), other.q.as_ref(), from, to);
        copy_lane(self.q_dot.as_mut(), other.q_dot.as_ref(), from, to);
        copy_lane(self.q_ddot.as_mut(), other.q_ddot.as_ref(), from, to);
    }

    /// Writes zeros to the lanes that are not solved.
    pub(super) fn clear_bad(&mut self) {
        for lane in 0..Octet::COUNT {
            if !self.is_good(lane) {
                let numbers = [self.q.as_mut(), self.q_dot.as_mut(), self.q_ddot.as_mut()];
                numbers.into_iter().flatten().for_each(|number| number.set(lane, 0.0));
            }
        }
    }
}

/// One lane in all lanes.
fn spread(x: Octet, lane: usize) -> Octet {
    Octet::from_f64(x.lane(lane))
}

/// Writes one lane of every number to all lanes.
fn spread_lane(to: &mut [Octet], from: &[Octet], lane: usize) {
    to.iter_mut().zip(from).for_each(|(to, x)| *to = spread(*x, lane));
}

/// Copies lane `from` of every number to lane `to`.
pub(super) fn copy_lane(numbers: &mut [Octet], source: &[Octet], from: usize, to: usize) {
    for (number, other) in numbers.iter_mut().zip(source) {
        number.set(to, other.lane(from));
    }
}
