//! The trial state: the solution of the plan at an instant, and the check whether it is on the branch of the motion.

use super::accurate_solution::solve_accurately;
use super::branch::{first_uncertain, may_have_touched_limit};
use super::follower::{Control, PlanFollower, PlanSolution};
use super::lists::BranchValues;
use super::mode_changes::{self, Passed};
use super::predict::largest_turn;
use super::turning_rows::TrialStep;
use crate::mechanism::{LengthError, Mechanism};
use crate::plan::{Depth, Solved};
use crate::scalar::compare::all_finite;
use crate::signal::{Instant, Signal};

impl<M: Mechanism> PlanFollower<M> {
    /// Solves by the plan in the current modes; true where the solution is valid.
    #[inline]
    pub(super) fn solve_in_modes(&mut self, mechanism: &M, at: &Instant<'_>) -> Result<bool, LengthError> {
        let Self { parameters, branch, states, accepted, predicted, .. } = self;
        let PlanSolution { q, q_dot, q_ddot, margins } = &mut states[1 - *accepted];
        let solved =
            Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: margins.as_mut() };
        let modes = branch.modes.of_closures();
        let depth = Depth::Acceleration;
        solve_accurately(mechanism, parameters.as_ref(), (at, modes), predicted.as_ref(), depth, solved)?;
        let PlanSolution { q, q_dot, q_ddot, margins } = &states[1 - *accepted];
        let finite = all_finite(q.as_ref()) & all_finite(q_dot.as_ref()) & all_finite(q_ddot.as_ref());
        Ok(margins.are_good() & finite & at.t.is_finite())
    }

    /// Solves by the plan with other signs of closures, for a motion that has passed limits of the rows that the plan
    /// uses; true where a valid solution is found. Modes that the caller requested do not change.
    #[cold]
    #[inline(never)]
    pub(super) fn retry_in_other_modes(&mut self, mechanism: &M, at: &Instant<'_>) -> Result<bool, LengthError> {
        let plan = &M::model().plan;
        if !mode_changes::is_missed(plan, self.trial().margins.as_ref()) {
            return Ok(false);
        }
        let current_modes = self.branch.modes;
        let branch_values = BranchValues::at(mechanism, self.parameters.as_ref(), at, self.predicted.as_ref())?;
        let passed = Passed::new(current_modes.of_closures(), branch_values.as_ref(), self.requested.as_ref());
        for attempt in passed.attempts() {
            passed.signs(attempt, self.branch.modes.of_closures_mut());
            if self.solve_in_modes(mechanism, at)? {
                return Ok(true);
            }
        }
        // The solution in the current modes is computed again, because error messages refer to it.
        self.branch.modes = current_modes;
        self.solve_in_modes(mechanism, at)
    }

    /// Writes |w| of the groups of the trial state; returns the smallest.
    #[inline]
    pub(super) fn measure(&mut self) -> f64 {
        self.states[1 - self.accepted].margins.write_distances(&mut self.distances)
    }

    /// The turn of a step of the length h from `state` in which its bodies turn by `turn`: that of the rows, if it is
    /// larger. Iterated groups are looked at within the step instead (see [`rows_are_followed`](Self::rows_are_followed)).
    #[inline]
    pub(super) fn with_rows(&self, turn: f64, state: &PlanSolution<M>, h: f64) -> f64 {
        match self.rows_turn_alone && !M::model().plan.iterates() {
            true => turn.max(largest_turn([state.q_dot.as_ref(), state.q_ddot.as_ref()], self.turns.as_ref(), h)),
            false => turn,
        }
    }

    /// True if in a step of the length h from `state`, where the inputs are `from`, the gradients of rows turn no
    /// farther than bodies may, the trial state is near its prediction by the same measure, and no group whose branch
    /// value must be looked at comes near its limit in between.
    #[inline]
    pub(super) fn rows_are_followed(
        &self,
        mechanism: &M,
        at: &Instant<'_>,
        state: &PlanSolution<M>,
        (from, h): (&[Signal], f64),
        control: &Control,
    ) -> Result<bool, LengthError> {
        if !self.rows_turn_alone {
            return Ok(true);
        }
        let tried = self.trial();
        let step = TrialStep {
            parameters: self.parameters.as_ref(),
            modes: &self.branch.modes,
            turns: self.turns.as_ref(),
            before: [state.q.as_ref(), state.q_dot.as_ref(), state.q_ddot.as_ref()],
            predicted: self.predicted.as_ref(),
            tried: [tried.q.as_ref(), tried.q_dot.as_ref()],
            inputs: from,
            h,
            at,
        };
        Ok(step.certainty_of_rows(mechanism, control)? >= 0.0)
    }

    /// True if no group has changed the sign of its determinant.
    #[inline]
    pub(super) fn keeps_orientations(&self, mechanism: &M, at: &Instant<'_>) -> Result<bool, LengthError> {
        let plan = &M::model().plan;
        if plan.orientations.is_empty() {
            return Ok(true);
        }
        let q = &self.trial().q;
        let found = BranchValues::at(mechanism, self.parameters.as_ref(), at, q.as_ref())?;
        let oriented = plan.modes.len()..plan.signs();
        Ok(have_signs(&self.branch.modes.as_ref()[oriented.clone()], &found.as_ref()[oriented]))
    }

    /// True if every group agrees with its prediction; false where a group may have reached its limit and returned, and
    /// where the step is too long to resolve the branches.
    #[cold]
    #[inline(never)]
    pub(super) fn stays_on_its_branch(
        &self,
        mechanism: &M,
        at: &Instant<'_>,
        resolution: f64,
    ) -> Result<bool, LengthError> {
        let is_resolved = resolution >= 0.0;
        if !is_resolved || may_have_touched_limit(self.branch.distances.as_ref(), self.distances.as_ref()) {
            return Ok(false);
        }
        self.uncertain(mechanism, at, self.predicted.as_ref()).map(|uncertain| uncertain.is_none())
    }

    /// The first group of the trial state that does not agree with a prediction.
    pub(super) fn uncertain(
        &self,
        mechanism: &M,
        at: &Instant<'_>,
        predicted: &[f64],
    ) -> Result<Option<usize>, LengthError> {
        let branch_values_at = |q: &[f64]| BranchValues::at(mechanism, self.parameters.as_ref(), at, q);
        let (foretold, found) = (branch_values_at(predicted)?, branch_values_at(self.trial().q.as_ref())?);
        Ok(first_uncertain(self.branch.modes.as_ref(), foretold.as_ref(), found.as_ref()))
    }
}

/// True if all branch values have the signs of their groups.
fn have_signs(modes: &[f64], branch_values: &[f64]) -> bool {
    modes.iter().zip(branch_values).all(|(mode, value)| mode * value > 0.0)
}
