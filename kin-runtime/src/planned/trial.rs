//! The state that is being tried: what the plan gives at an instant, and whether it is on the branch of the motion.

use super::branch::{certainty_of, distances, may_dip};
use super::follower::{Follower, Poses};
use super::passed::{self, Passed};
use crate::mechanism::{LengthError, Mechanism};
use crate::plan::{Depth, Plan, Solved};
use crate::signal::Instant;
use crate::workspace::Array;

impl<M: Mechanism> Follower<M> {
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

    /// Writes |w| of the state that is being tried; gives the smallest.
    #[inline]
    pub(super) fn measure(&mut self) -> f64 {
        let margins = &self.states[1 - self.good].margins;
        distances(&M::model().plan, margins.as_ref(), self.distances.as_mut())
    }

    /// True if no iterated group has changed the sign of its determinant.
    #[inline]
    pub(super) fn keeps_orientations(&self, mechanism: &M, at: &Instant<'_>) -> Result<bool, LengthError> {
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
    pub(super) fn stays_on_its_branch(
        &self,
        mechanism: &M,
        at: &Instant<'_>,
        resolution: f64,
    ) -> Result<bool, LengthError> {
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
}
