//! The update from one solved instant to the next on the same branch, without an allocation.
//!
//! Usually one step suffices: the next configuration is predicted, the plan solves, and the step is accepted if no body
//! turns too far, the solution is near the prediction, and every group has the expected distance from its limit (see
//! [`trial`](super::trial) and [`branch`](super::branch)). Otherwise the motion is divided into steps that are short
//! enough for that (see [`substeps`](super::substeps)). Where no step is short enough, the motion ends: see
//! [`limit`](super::limit).

use super::branch::{OUT_OF_REACH, resolves};
use super::error::PlanError;
use super::follower::{Control, NEGLIGIBLE_CORRECTION, PlanFollower, PlanSolution, most_turn};
use super::group_limit::Limit;
use super::ill_conditioned::CHECKED_DISTANCE;
use super::lists::{BranchValues, Modes};
use super::predict::{beyond_parabola, parabola, turned, weights};
use crate::course::{Between, Course, PathShape, kind};
use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::plan::ModeInfo;
use crate::scalar::compare::all_finite;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use core::f64::consts::PI;

impl<M: Mechanism> PlanFollower<M> {
    /// Solves the plan of the mechanism at an instant, in the modes of a configuration q, n numbers.
    pub(crate) fn new(mechanism: &M, at: &Instant<'_>, q: &[f64]) -> Result<Self, PlanError> {
        if let Some(why) = M::model().plan.absent {
            return Err(PlanError::NoPlan { why });
        }
        let mut follower = Self::empty(mechanism.parameters(), at.t);
        follower.restart(mechanism, at, q)?;
        Ok(follower)
    }

    /// Solves the plan at an instant from a start in the given modes, with parameters of the caller.
    #[cfg(any(feature = "std", all(feature = "simd", feature = "alloc")))]
    pub(crate) fn begin(
        mechanism: &M,
        parameters: M::Parameters<f64>,
        at: &Instant<'_>,
        start: &[f64],
        modes: Modes<M>,
    ) -> Result<Self, PlanError> {
        let mut follower = Self::empty(parameters, at.t);
        follower.restart_in(mechanism, at, start, modes)?;
        Ok(follower)
    }

    /// Starts again from a configuration q, n numbers, in the modes of q. An iteration must lead to a configuration with the
    /// orientation that its group has at q, no more than half a turn away; after an error the state is that before.
    pub(crate) fn restart(&mut self, mechanism: &M, at: &Instant<'_>, q: &[f64]) -> Result<(), PlanError> {
        if q.len() != M::COORDINATES {
            return Err(LengthError { what: "q", expected: M::COORDINATES, found: q.len() }.into());
        }
        let signs = BranchValues::at(mechanism, self.parameters.as_ref(), at, q)?.modes();
        let before = *self;
        self.restart_in(mechanism, at, q, signs)?;
        let (model, modes) = (M::model(), M::model().plan.modes.len());
        let iterated = model.plan.orientations.iter().take(model.plan.iterations).enumerate();
        let mut left = iterated.filter(|(k, group)| {
            let is_turned = |&(k, _): &(usize, usize)| {
                model.coordinates[k].kind.is_angle() && (self.state().q.as_ref()[k] - q[k]).abs() > PI
            };
            signs.as_ref()[modes + k] != self.branch.modes.as_ref()[modes + k]
                || model.plan.steps[group.step].unknowns().iter().any(is_turned)
        });
        if let Some((_, ModeInfo { name: group, .. })) = left.next() {
            *self = before;
            return Err(PlanError::OtherClosure { t: at.t, group });
        }
        Ok(())
    }

    /// As [`restart`](Self::restart), in the given modes.
    pub(crate) fn restart_in(
        &mut self,
        mechanism: &M,
        at: &Instant<'_>,
        start: &[f64],
        modes: Modes<M>,
    ) -> Result<(), PlanError> {
        self.q_at_limit = None;
        if !all_finite(self.parameters.as_ref())
            && let Some(error) = self.unusable(at)
        {
            return Err(error);
        }
        self.lengths_exist(mechanism, at)?;
        let before = core::mem::replace(&mut self.branch.modes, modes);
        self.predicted.as_mut().copy_from_slice(start);
        let anew = core::mem::replace(&mut self.starts_anew, true);
        let requested_before = core::mem::replace(&mut self.requested, Modes::filled(1.0));
        if let Err(error) = self.solve_anew(mechanism, at) {
            (self.branch.modes, self.starts_anew, self.requested) = (before, anew, requested_before);
            return Err(error);
        }
        Ok(())
    }

    /// Computes q, q̇ and q̈ at another instant on the same branch; inputs change as described in
    /// [`course`](crate::course).
    #[inline]
    pub(crate) fn update(&mut self, mechanism: &M, at: &Instant<'_>, control: &Control) -> Result<(), PlanError> {
        self.q_at_limit = None;
        if let Err(error) = self.lengths_exist(mechanism, at) {
            let from = self.inputs;
            let from = Instant { t: self.t, inputs: from.as_ref() };
            let course = Between { kind: kind(&from, at), from, to: *at };
            // A length that the caller has given is wrong whatever lies between.
            return Err(if M::INPUTS > 0 { error } else { self.limit_before(mechanism, &course, at, control, error) });
        }
        let turn = self.predict(at.t - self.t);
        if self.starts_anew {
            return self.solve_anew(mechanism, at);
        }
        if self.try_one_step(mechanism, at, turn, control, None)? {
            return Ok(());
        }
        self.walk_between(mechanism, at, control)
    }

    /// As [`update`](Self::update) where inputs are functions of time, whose values at the instant are those of `at`.
    #[cfg(feature = "std")]
    pub(crate) fn update_timed(
        &mut self,
        mechanism: &M,
        at: &Instant<'_>,
        inputs: &dyn Fn(f64, &mut [crate::signal::Signal]),
        control: &Control,
    ) -> Result<(), PlanError> {
        self.q_at_limit = None;
        let course = crate::course::Timed { from: self.t, to: at.t, inputs };
        if let Err(error) = self.lengths_exist(mechanism, at) {
            return Err(self.limit_before(mechanism, &course, at, control, error));
        }
        let turn = self.predict(at.t - self.t);
        if self.starts_anew {
            return self.solve_anew(mechanism, at);
        }
        if self.try_one_step(mechanism, at, turn, control, Some(&course))? {
            return Ok(());
        }
        self.walk_and_keep(mechanism, &course, at, control)
    }

    /// An error if a length that a joint prescribes is negative.
    #[inline]
    fn lengths_exist(&self, mechanism: &M, at: &Instant<'_>) -> Result<(), PlanError> {
        if M::LENGTHS == 0 {
            return Ok(());
        }
        let mut lengths = M::Rows::<f64>::filled(0.0);
        let Some(lengths) = lengths.as_mut().get_mut(..M::LENGTHS) else { return Ok(()) };
        mechanism.lengths_with(self.parameters.as_ref(), at, lengths)?;
        checked_lengths(M::model(), at.t, lengths)
    }

    /// The limit at which the motion to an instant with a negative length ends, if it comes before the length is
    /// negative; otherwise the error of the length. The state stays where it is.
    #[cold]
    #[inline(never)]
    fn limit_before(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        at: &Instant<'_>,
        control: &Control,
        error: PlanError,
    ) -> PlanError {
        if self.starts_anew || course.is_frozen() {
            return error;
        }
        let before = *self;
        let mut refused = None;
        if let Err(blocked) = self.walk(mechanism, course, at, control) {
            refused = Some(self.refusal(mechanism, course, at, &blocked));
        }
        let q_at_limit = self.q_at_limit;
        *self = before;
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let located = refused.as_ref().and_then(PlanError::limit).and_then(Limit::at);
        let is_before = located.is_some_and(|t| {
            course.at(t, inputs.as_mut());
            self.lengths_exist(mechanism, &Instant { t, inputs: inputs.as_ref() }).is_ok()
        });
        match refused {
            Some(refused) if is_before => {
                (self.q_at_limit, self.t_before) = (q_at_limit, f64::NAN);
                refused
            }
            _ => error,
        }
    }

    #[cold]
    #[inline(never)]
    fn walk_between(&mut self, mechanism: &M, at: &Instant<'_>, control: &Control) -> Result<(), PlanError> {
        if let Some(error) = self.unusable(at) {
            return Err(error);
        }
        let inputs = self.inputs;
        let from = Instant { t: self.t, inputs: inputs.as_ref() };
        let mut path = Between { kind: kind(&from, at), from, to: *at };
        if path.kind == PathShape::Smooth {
            let smooth = self.walk_and_keep(mechanism, &path, at, control);
            if smooth.is_ok() || M::INPUTS == 0 {
                return smooth;
            }
            // The quintic course of the inputs may leave the mechanism's range although the straight one does not.
            path.kind = PathShape::Straight;
        }
        self.walk_and_keep(mechanism, &path, at, control)
    }

    fn walk_and_keep(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        at: &Instant<'_>,
        control: &Control,
    ) -> Result<(), PlanError> {
        let before = (self.branch, self.turns, self.weights);
        match self.walk(mechanism, course, at, control) {
            Ok(()) => {
                let nearest = self.measure();
                self.accept(at, nearest, false);
                // Another course may have ended at a limit before.
                self.q_at_limit = None;
                let q = self.state().q;
                self.measure_turns(mechanism, at, &q);
                Ok(())
            }
            Err(blocked) => {
                let error = self.refusal(mechanism, course, at, &blocked);
                (self.branch, self.turns, self.weights) = before;
                self.t_before = f64::NAN;
                Err(error)
            }
        }
    }

    /// Writes the prediction; returns its largest rotation.
    #[inline]
    fn predict(&mut self, h: f64) -> f64 {
        let PlanSolution { q, q_dot, q_ddot, .. } = &self.states[self.accepted];
        let rates = [q.as_ref(), q_dot.as_ref(), q_ddot.as_ref()];
        let turn = parabola(self.predicted.as_mut(), rates, self.weights.as_ref(), h);
        if M::model().plan.iterates() {
            self.predict_unknowns(h);
        }
        turn
    }

    /// Improves the prediction of the unknowns of iterations by the quintic.
    fn predict_unknowns(&mut self, h: f64) {
        let (now, before) = (&self.states[self.accepted], &self.states[1 - self.accepted]);
        let derivatives_of = |state: &PlanSolution<M>, k: usize| {
            [state.q.as_ref()[k], state.q_dot.as_ref()[k], state.q_ddot.as_ref()[k]]
        };
        for k in M::model().plan.iterated_coordinates() {
            let beyond = beyond_parabola(derivatives_of(before, k), derivatives_of(now, k), self.t - self.t_before, h);
            self.predicted.as_mut()[k] += beyond;
        }
    }

    /// Solves at an instant that is unrelated to the last one.
    fn solve_anew(&mut self, mechanism: &M, at: &Instant<'_>) -> Result<(), PlanError> {
        let before = (self.branch.modes, self.turns, self.weights);
        let good = self.solve_in_modes(mechanism, at)? || self.retry_in_other_modes(mechanism, at)?;
        if !good {
            self.t_before = f64::NAN;
            return Err(self.explain(at));
        }
        let plan = &M::model().plan;
        let nearest = self.measure();
        let q = self.trial().q;
        self.measure_turns(mechanism, at, &q);
        if self.is_ill_conditioned(mechanism, at) {
            let error = self.explain_ill_conditioned(mechanism, at);
            (self.branch.modes, self.turns, self.weights) = before;
            return Err(error);
        }
        if let Some(k) = self.first_steep_unknown(&self.turns) {
            (self.branch.modes, self.turns, self.weights) = before;
            let coincident = self.coincident_points(mechanism, at, q.as_ref());
            return Err(coincident.unwrap_or_else(|| PlanError::rounded(M::model(), at.t, k)));
        }
        if !plan.orientations.is_empty() {
            // An iteration may find any solution near its start, so its orientation is taken from the result.
            let q = &self.trial().q;
            let found = BranchValues::at(mechanism, self.parameters.as_ref(), at, q.as_ref())?.modes();
            for group in plan.modes.len()..plan.signs() {
                self.branch.modes.as_mut()[group] = found.as_ref()[group];
            }
        }
        self.accept(at, nearest, false);
        weights(M::model(), q.as_ref(), self.weights.as_mut());
        self.starts_anew = false;
        self.requested = Modes::filled(0.0);
        Ok(())
    }

    /// Moves the follower to the instant in one step from the prediction, if that is accepted; returns whether it was.
    /// Without a course the inputs change as between any two instants.
    #[inline]
    fn try_one_step(
        &mut self,
        mechanism: &M,
        at: &Instant<'_>,
        turn: f64,
        control: &Control,
        course: Option<&dyn Course>,
    ) -> Result<bool, LengthError> {
        // The comparisons are written so that NaN is rejected.
        let is_short = turn <= most_turn(control, self.nearest);
        if !self.solve_in_modes(mechanism, at)? || !is_short {
            return Ok(false);
        }
        let tried = self.trial();
        let away = turned(tried.q.as_ref(), self.predicted.as_ref(), self.weights.as_ref());
        let is_expected = away <= control.correction * turn + NEGLIGIBLE_CORRECTION;
        let state = &self.states[self.accepted];
        if !is_expected
            || !self.rows_are_followed(mechanism, at, state, (self.inputs.as_ref(), at.t - self.t), control)?
            || (M::KNOWN_VALUES_CURVE || M::INPUTS_CURVE)
                && !self.hides_nothing_until(mechanism, at, course, control)?
        {
            return Ok(false);
        }
        // Where every group is out of reach of its limit, no sign can have changed: neither within the step nor between
        // the solution and its prediction, which are much nearer to one another than both ends of the step. An
        // iteration of lengths may still have found another solution, and a linear step may have passed a pole, since the
        // turns of bodies do not bound how far lengths move.
        let turn = self.with_rows(turn, state, at.t - self.t);
        let nearest = self.measure();
        let least = f64::min(nearest, self.nearest);
        let far = least >= OUT_OF_REACH * turn && least >= CHECKED_DISTANCE;
        let stays = match far {
            true => !self.checks_determinant_signs || self.keeps_orientations(mechanism, at)?,
            false => self.stays_on_its_branch(mechanism, at, resolves(least, turn))?,
        };
        if !stays {
            return Ok(false);
        }
        if self.rows_turn_alone {
            let Some(turns) = self.turns_unless_steep(mechanism, at) else { return Ok(false) };
            self.turns = turns;
        }
        self.accept(at, nearest, true);
        if self.has_scalars {
            let q = self.state().q;
            weights(M::model(), q.as_ref(), self.weights.as_mut());
        }
        Ok(true)
    }
}

/// An error if a length is negative.
fn checked_lengths(model: &'static Model, t: f64, lengths: &[f64]) -> Result<(), PlanError> {
    match lengths.iter().position(|length| *length < 0.0) {
        Some(index) => Err(PlanError::negative_length(model, t, index, lengths[index])),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
