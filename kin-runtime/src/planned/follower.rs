//! The follower of a plan: from one solved instant to the next on the same branch, without an allocation.
//!
//! Usually one step does: the next configuration is predicted, the plan solves, and the step counts if nothing turned far,
//! the solution is where it was predicted, and every group is where it was expected beside its limit (see
//! [`branch`](super::branch)). Otherwise the way there is walked in steps that are short enough for that (see
//! [`walk`](super::walk)), and where no step is short enough, the motion ends: see [`limit`](super::limit).

use super::branch::{Branch, OUT_OF_REACH, certainty_of, distances, may_dip, resolves};
use super::error::PlanError;
use super::mode::Sign;
use super::passed::{self, Passed};
use super::predict::{beyond_parabola, parabola, turned, weights};
use crate::course::{Between, Course, Kind, kind};
use crate::mechanism::{LengthError, Mechanism};
use crate::plan::{Depth, Plan, Solved, StepKind};
use crate::scalar::compare::Compare;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// How long the steps of a follower are, and how short they may become.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Control {
    /// Most radians by which velocity, or acceleration, alone may turn a body in one step.
    pub(crate) rotation: f64,
    /// Largest distance of a solution from its prediction, relative to the predicted motion.
    pub(crate) correction: f64,
    /// Smallest step, relative to the way to go or to the usual step, whichever is shorter.
    pub(crate) min_step: f64,
    /// Most steps on the way to one instant.
    pub(crate) max_steps: usize,
}

impl Control {
    pub(crate) const USUAL: Self = Self { rotation: 0.3, correction: 0.1, min_step: 1e-13, max_steps: 200_000 };
}

/// Most radians of one step from a state whose nearest group is at the distance w from its limit: rounding of q̈, which is
/// about ε q̇²/w³ beside a crossing of branches, must not decide where the step leads.
pub(crate) fn most_turn(control: &Control, w: f64) -> f64 {
    f64::min(control.rotation, 0.01 / f64::EPSILON * w * w * w)
}

/// Corrections (rad) that are always small enough: where the motion starts from rest.
pub(crate) const NEGLIGIBLE: f64 = 1e-4;

/// q, q̇, q̈ and margins.
pub(crate) struct Poses<M: Mechanism> {
    pub(crate) q: M::Coordinates<f64>,
    pub(crate) q_dot: M::Coordinates<f64>,
    pub(crate) q_ddot: M::Coordinates<f64>,
    /// There are never more margins than rows.
    pub(crate) margins: M::Rows<f64>,
}

impl<M: Mechanism> Clone for Poses<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Poses<M> {}

impl<M: Mechanism> Poses<M> {
    /// Zeros.
    pub(crate) fn nothing() -> Self {
        let zeros = M::Coordinates::<f64>::filled(0.0);
        Self { q: zeros, q_dot: zeros, q_ddot: zeros, margins: M::Rows::<f64>::filled(0.0) }
    }
}

/// A branch of the motion and the instant reached on it.
pub(crate) struct Follower<M: Mechanism> {
    pub(super) parameters: M::Parameters<f64>,
    pub(super) branch: Branch<M::Coordinates<f64>>,
    pub(super) t: f64,
    pub(super) inputs: M::Inputs<f64>,
    /// The last good state, and one that is being tried.
    pub(super) states: [Poses<M>; 2],
    /// Which of them is the good one.
    pub(super) good: usize,
    /// The time of the state before the good one, which the other place holds; NaN where it holds something else.
    before: f64,
    /// The next state has nothing to do with the last one.
    pub(super) anew: bool,
    /// Not 0 for every mode that was asked for since the last good state.
    pub(super) asked: M::Coordinates<f64>,
    pub(super) predicted: M::Coordinates<f64>,
    /// The smallest |w| of the good state.
    pub(super) nearest: f64,
    /// |w| of the state that is being tried.
    pub(super) distances: M::Coordinates<f64>,
    /// Radians that a unit of each coordinate counts for.
    pub(super) weights: M::Coordinates<f64>,
}

impl<M: Mechanism> Clone for Follower<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Follower<M> {}

/// Why a step does not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    /// A margin that is not positive, by its place.
    Margin(usize),
    /// It is not certain that this group, a place among the signs, has stayed on its branch.
    Sign(usize),
    /// The motion is not where it was predicted.
    Coarse,
    /// A number is not finite.
    NonFinite,
}

impl<M: Mechanism> Follower<M> {
    /// Nothing solved yet.
    pub(super) fn empty(parameters: M::Parameters<f64>, t: f64) -> Self {
        let zeros = M::Coordinates::<f64>::filled(0.0);
        Self {
            parameters,
            branch: Branch { signs: zeros, distances: zeros },
            t,
            inputs: M::Inputs::<f64>::filled(Signal::constant(0.0)),
            states: [Poses::nothing(); 2],
            good: 0,
            before: f64::NAN,
            anew: true,
            asked: zeros,
            predicted: zeros,
            nearest: 1.0,
            distances: zeros,
            weights: zeros,
        }
    }

    /// The plan of the mechanism solved at an instant, in the modes of a configuration q, n numbers.
    pub(crate) fn new(mechanism: &M, at: &Instant<'_>, q: &[f64]) -> Result<Self, PlanError> {
        if let Some(why) = M::model().plan.absent {
            return Err(PlanError::NoPlan { why });
        }
        let mut follower = Self::empty(mechanism.parameters(), at.t);
        follower.restart(mechanism, at, q)?;
        Ok(follower)
    }

    /// The plan solved at an instant from a start with these signs, at parameters that the caller has.
    #[cfg(feature = "std")]
    pub(crate) fn begin(
        mechanism: &M,
        parameters: M::Parameters<f64>,
        at: &Instant<'_>,
        start: &[f64],
        signs: M::Coordinates<f64>,
    ) -> Result<Self, PlanError> {
        let mut follower = Self::empty(parameters, at.t);
        follower.restart_in(mechanism, at, start, signs)?;
        Ok(follower)
    }

    /// A motion that stands at a good state, of which nothing before is known.
    #[cfg(all(feature = "simd", feature = "alloc"))]
    pub(crate) fn resume(
        parameters: M::Parameters<f64>,
        signs: M::Coordinates<f64>,
        at: &Instant<'_>,
        [q, q_dot, q_ddot]: [M::Coordinates<f64>; 3],
        margins: M::Rows<f64>,
    ) -> Self {
        let mut follower = Self::empty(parameters, at.t);
        follower.states[0] = Poses { q, q_dot, q_ddot, margins };
        follower.branch.signs = signs;
        follower.anew = false;
        weights(M::model(), q.as_ref(), follower.weights.as_mut());
        follower.keep_inputs(at.inputs);
        let plan = &M::model().plan;
        follower.nearest = distances(plan, margins.as_ref(), follower.branch.distances.as_mut());
        follower
    }

    /// Begins anew from a configuration q, n numbers, in the modes that it has.
    pub(crate) fn restart(&mut self, mechanism: &M, at: &Instant<'_>, q: &[f64]) -> Result<(), PlanError> {
        if q.len() != M::COORDINATES {
            return Err(LengthError { what: "q", expected: M::COORDINATES, found: q.len() }.into());
        }
        let mut signs = M::Coordinates::<f64>::filled(0.0);
        let count = M::model().plan.signs();
        mechanism.branches_with(self.parameters.as_ref(), at, q, &mut signs.as_mut()[..count])?;
        self.restart_in(mechanism, at, q, signs)
    }

    /// [`restart`](Self::restart) with signs of their own.
    pub(crate) fn restart_in(
        &mut self,
        mechanism: &M,
        at: &Instant<'_>,
        start: &[f64],
        mut signs: M::Coordinates<f64>,
    ) -> Result<(), PlanError> {
        // NaN where it is not decided: whatever depends on it is NaN then.
        signs.as_mut().iter_mut().for_each(|sign| *sign = Sign::of(*sign).map_or(f64::NAN, Sign::value));
        let before = core::mem::replace(&mut self.branch.signs, signs);
        self.predicted.as_mut().copy_from_slice(start);
        let anew = core::mem::replace(&mut self.anew, true);
        let asked = core::mem::replace(&mut self.asked, M::Coordinates::filled(1.0));
        if let Err(error) = self.solve_anew(mechanism, at) {
            (self.branch.signs, self.anew, self.asked) = (before, anew, asked);
            return Err(error);
        }
        Ok(())
    }

    /// q, q̇ and q̈ at another instant on the same branch; the inputs go there as [`course`](crate::course) says.
    #[inline]
    pub(crate) fn update(&mut self, mechanism: &M, at: &Instant<'_>, control: &Control) -> Result<(), PlanError> {
        let turn = self.predict(at.t - self.t);
        if self.anew {
            return self.solve_anew(mechanism, at);
        }
        if self.takes_one_step(mechanism, at, turn, control)? {
            return Ok(());
        }
        self.walk_between(mechanism, at, control)
    }

    /// [`update`](Self::update) where inputs are functions of time, whose values at the instant are those of `at`.
    #[cfg(feature = "std")]
    pub(crate) fn update_timed(
        &mut self,
        mechanism: &M,
        at: &Instant<'_>,
        inputs: &dyn Fn(f64, &mut [Signal]),
        control: &Control,
    ) -> Result<(), PlanError> {
        let turn = self.predict(at.t - self.t);
        if self.anew {
            return self.solve_anew(mechanism, at);
        }
        if self.takes_one_step(mechanism, at, turn, control)? {
            return Ok(());
        }
        self.walk_and_keep(mechanism, &crate::course::Timed { from: self.t, to: at.t, inputs }, at, control)
    }

    #[cold]
    #[inline(never)]
    fn walk_between(&mut self, mechanism: &M, at: &Instant<'_>, control: &Control) -> Result<(), PlanError> {
        if let Some(error) = self.unusable(at) {
            return Err(error);
        }
        let inputs = self.inputs;
        let from = Instant { t: self.t, inputs: inputs.as_ref() };
        let mut way = Between { kind: kind(&from, at), from, to: *at };
        if way.kind == Kind::Smooth {
            let swung = self.walk_and_keep(mechanism, &way, at, control);
            if swung.is_ok() || M::INPUTS == 0 {
                return swung;
            }
            // The quintic may lead out of the mechanism's range where the straight way does not.
            way.kind = Kind::Straight;
        }
        self.walk_and_keep(mechanism, &way, at, control)
    }

    fn walk_and_keep(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        at: &Instant<'_>,
        control: &Control,
    ) -> Result<(), PlanError> {
        let kept = self.branch;
        match self.walk(mechanism, course, at, control) {
            Ok(()) => {
                let nearest = self.measure();
                self.keep(at, nearest, false);
                Ok(())
            }
            Err(blocked) => {
                let error = self.refusal(mechanism, course, at, &blocked);
                self.branch = kept;
                self.before = f64::NAN;
                Err(error)
            }
        }
    }

    /// Predicts; gives by how much the prediction turns.
    #[inline]
    fn predict(&mut self, h: f64) -> f64 {
        let Poses { q, q_dot, q_ddot, .. } = &self.states[self.good];
        let rates = [q.as_ref(), q_dot.as_ref(), q_ddot.as_ref()];
        let turn = parabola(self.predicted.as_mut(), rates, self.weights.as_ref(), h);
        if !M::model().plan.orientations.is_empty() {
            self.predict_unknowns(h);
        }
        turn
    }

    /// The unknowns of iterations, nearer.
    fn predict_unknowns(&mut self, h: f64) {
        let (now, before) = (&self.states[self.good], &self.states[1 - self.good]);
        let of = |state: &Poses<M>, k: usize| [state.q.as_ref()[k], state.q_dot.as_ref()[k], state.q_ddot.as_ref()[k]];
        for step in M::model().plan.steps {
            let StepKind::Newton(unknowns) = step.kind else { continue };
            for &(k, _) in step.coordinates.iter().take(unknowns) {
                let beyond = beyond_parabola(of(before, k), of(now, k), self.t - self.before, h);
                self.predicted.as_mut()[k] += beyond;
            }
        }
    }

    /// Solves at an instant that has nothing to do with the last one.
    fn solve_anew(&mut self, mechanism: &M, at: &Instant<'_>) -> Result<(), PlanError> {
        let kept = self.branch.signs;
        let good = self.ask(mechanism, at)? || self.pass(mechanism, at)?;
        if !good {
            self.before = f64::NAN;
            return Err(self.explain(at));
        }
        let plan = &M::model().plan;
        let nearest = self.measure();
        if self.is_blurred(mechanism, at) {
            let error = self.explain_blurred(mechanism, at);
            self.branch.signs = kept;
            return Err(error);
        }
        if !plan.orientations.is_empty() {
            // An iteration has found whatever solution is near: its orientation counts from here on.
            let mut found = M::Coordinates::<f64>::filled(0.0);
            let count = plan.signs();
            let q = self.states[1 - self.good].q;
            mechanism.branches_with(self.parameters.as_ref(), at, q.as_ref(), &mut found.as_mut()[..count])?;
            for sign in plan.modes.len()..count {
                self.branch.signs.as_mut()[sign] = found.as_ref()[sign].direction();
            }
        }
        let q = self.states[1 - self.good].q;
        weights(M::model(), q.as_ref(), self.weights.as_mut());
        self.keep(at, nearest, false);
        self.anew = false;
        self.asked = M::Coordinates::filled(0.0);
        Ok(())
    }

    /// True if the prediction leads to the instant in one step that counts; the instant is reached then.
    #[inline]
    fn takes_one_step(
        &mut self,
        mechanism: &M,
        at: &Instant<'_>,
        turn: f64,
        control: &Control,
    ) -> Result<bool, LengthError> {
        // All comparisons are such that NaN does not count.
        let is_short = turn <= most_turn(control, self.nearest);
        if !self.ask(mechanism, at)? || !is_short {
            return Ok(false);
        }
        let tried = &self.states[1 - self.good];
        let away = turned(tried.q.as_ref(), self.predicted.as_ref(), self.weights.as_ref());
        let is_expected = away <= control.correction * turn + NEGLIGIBLE;
        if !is_expected || !self.keeps_orientations(mechanism, at)? {
            return Ok(false);
        }
        let nearest = self.measure();
        let least = f64::min(nearest, self.nearest);
        let far = least >= OUT_OF_REACH * turn && least >= super::limit::NEAR;
        if !far && !self.stays_on_its_branch(mechanism, at, resolves(least, turn))? {
            return Ok(false);
        }
        self.keep(at, nearest, true);
        Ok(true)
    }

    /// True if no iterated group has changed the sign of its determinant.
    #[inline]
    fn keeps_orientations(&self, mechanism: &M, at: &Instant<'_>) -> Result<bool, LengthError> {
        let plan = &M::model().plan;
        if plan.orientations.is_empty() {
            return Ok(true);
        }
        let q = self.states[1 - self.good].q;
        let mut found = M::Coordinates::<f64>::filled(0.0);
        let found = &mut found.as_mut()[..plan.signs()];
        mechanism.branches_with(self.parameters.as_ref(), at, q.as_ref(), found)?;
        let signs = self.branch.signs.as_ref().iter().zip(found).skip(plan.modes.len());
        Ok(signs.into_iter().all(|(sign, found)| sign * *found > 0.0))
    }

    /// True if every group is where the prediction has it; not where one is so near to its limit that it may have been there
    /// and come back, nor where the step is too long to resolve it.
    #[cold]
    #[inline(never)]
    fn stays_on_its_branch(&self, mechanism: &M, at: &Instant<'_>, resolution: f64) -> Result<bool, LengthError> {
        let plan = &M::model().plan;
        let (before, now) = (self.branch.distances.as_ref(), self.distances.as_ref());
        let is_resolved = resolution >= 0.0;
        if !is_resolved || (0..plan.signs()).any(|sign| may_dip(before[sign], now[sign])) {
            return Ok(false);
        }
        if self.is_blurred(mechanism, at) {
            return Ok(false);
        }
        self.uncertain(mechanism, at, self.predicted.as_ref()).map(|uncertain| uncertain.is_none())
    }

    /// The first group that is not where a prediction has it, for the state that is being tried.
    pub(super) fn uncertain(
        &self,
        mechanism: &M,
        at: &Instant<'_>,
        predicted: &[f64],
    ) -> Result<Option<usize>, LengthError> {
        let plan = &M::model().plan;
        let count = plan.signs();
        let mut foretold = M::Coordinates::<f64>::filled(0.0);
        mechanism.branches_with(self.parameters.as_ref(), at, predicted, &mut foretold.as_mut()[..count])?;
        let q = self.states[1 - self.good].q;
        let mut found = M::Coordinates::<f64>::filled(0.0);
        mechanism.branches_with(self.parameters.as_ref(), at, q.as_ref(), &mut found.as_mut()[..count])?;
        let (signs, foretold, found) = (self.branch.signs.as_ref(), foretold.as_ref(), found.as_ref());
        let on_branch = |sign: usize| {
            let now = signs[sign] * found[sign];
            now > 0.0 && certainty_of(now, signs[sign] * foretold[sign]) >= 0.0
        };
        Ok((0..count).find(|sign| !on_branch(*sign)))
    }

    /// Writes |w| of the state that is being tried; gives the smallest.
    #[inline]
    pub(super) fn measure(&mut self) -> f64 {
        let margins = &self.states[1 - self.good].margins;
        distances(&M::model().plan, margins.as_ref(), self.distances.as_mut())
    }

    /// The state that was tried, whose nearest group has this distance from its limit, is the good one now; after one step
    /// from the one before, or in other ways.
    fn keep(&mut self, at: &Instant<'_>, nearest: f64, in_one_step: bool) {
        self.before = if in_one_step { self.t } else { f64::NAN };
        self.branch.distances = self.distances;
        self.nearest = nearest;
        self.good = 1 - self.good;
        self.t = at.t;
        self.keep_inputs(at.inputs);
    }

    fn keep_inputs(&mut self, inputs: &[Signal]) {
        self.inputs.as_mut().iter_mut().zip(inputs).for_each(|(to, from)| *to = *from);
    }

    /// What the plan gives in the modes that are kept; true where it is good.
    #[inline]
    pub(super) fn ask(&mut self, mechanism: &M, at: &Instant<'_>) -> Result<bool, LengthError> {
        let plan = &M::model().plan;
        let Self { parameters, branch, states, good, predicted, .. } = self;
        let Poses { q, q_dot, q_ddot, margins } = &mut states[1 - *good];
        let margins = &mut margins.as_mut()[..plan.margins];
        let solved = Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins };
        let modes = &branch.signs.as_ref()[..plan.modes.len()];
        let depth = Depth::Acceleration;
        mechanism.solve_with(parameters.as_ref(), at, modes, predicted.as_ref(), depth, solved)?;
        let Poses { q, q_dot, q_ddot, margins } = &states[1 - *good];
        // Without early ends, so that the loops run in lanes.
        let finite = |numbers: &[f64]| numbers.iter().fold(true, |all, x| all & x.is_finite());
        let good_margins =
            margins.as_ref()[..plan.margins].iter().fold(true, |all, m| all & (*m > Plan::SMALLEST_MARGIN));
        let all = good_margins & finite(q.as_ref()) & finite(q_dot.as_ref()) & finite(q_ddot.as_ref());
        Ok(all & at.t.is_finite())
    }

    /// What the plan gives where the motion has passed limits that only the kept rows have, with the signs that closures
    /// have behind them; true where it is good. Modes that were asked for stay what they are.
    #[cold]
    #[inline(never)]
    pub(super) fn pass(&mut self, mechanism: &M, at: &Instant<'_>) -> Result<bool, LengthError> {
        let plan = &M::model().plan;
        let margins = self.states[1 - self.good].margins;
        if !passed::is_missed(plan, |place| margins.as_ref()[place]) {
            return Ok(false);
        }
        let count = plan.modes.len();
        let (kept, mut closures) = (self.branch.signs, M::Coordinates::<f64>::filled(0.0));
        let closures = &mut closures.as_mut()[..plan.signs()];
        mechanism.branches_with(self.parameters.as_ref(), at, self.predicted.as_ref(), closures)?;
        let passed = Passed::new(&kept.as_ref()[..count], &closures[..count], self.asked.as_ref());
        for attempt in passed.attempts() {
            passed.signs(attempt, &mut self.branch.signs.as_mut()[..count]);
            if self.ask(mechanism, at)? {
                return Ok(true);
            }
        }
        // Once more, for what is said of it.
        self.branch.signs = kept;
        self.ask(mechanism, at)
    }

    /// The last good state.
    #[inline]
    pub(crate) fn state(&self) -> &Poses<M> {
        &self.states[self.good]
    }

    /// Its time.
    pub(crate) const fn t(&self) -> f64 {
        self.t
    }

    /// The signs of its modes, then those of its iterations.
    pub(crate) fn signs(&self) -> &[f64] {
        &self.branch.signs.as_ref()[..M::model().plan.signs()]
    }
}
