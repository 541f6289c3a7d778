//! The end of a motion in an iteration whose margin does not show it: where all entries of a row vanish together, and
//! all terms of each of them, the solutions that meet there have regular margins on both sides.

use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::plan::StepKind;
use crate::planned::error::{Limit, Located};
use crate::planned::follower::{Fault, PlanFollower};
use crate::planned::step::Step;
use crate::planned::walk::Blocked;
use crate::signal::Signal;
use crate::workspace::Array;

/// Largest difference between the solutions on both sides of the place at which a motion ends, relative to the largest
/// coordinate plus 1; where they are farther apart, the motion jumps.
const CONTINUOUS: f64 = 1e-4;

impl<M: Mechanism> PlanFollower<M> {
    /// The iterated group whose rates jump where no step is short enough, if positions do not jump there.
    pub(super) fn limit_of_iteration(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        reached: f64,
        blocked: &Blocked<M>,
    ) -> Option<Limit> {
        if blocked.fault != Some(Fault::Coarse) || !M::model().plan.iterates() {
            return None;
        }
        self.predicted = blocked.here.q;
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        if !self.solve_at(mechanism, course, blocked.places[1], &mut inputs).unwrap_or(false) {
            return None;
        }
        let (here, beyond) = (&blocked.here, self.trial());
        let change = |before: &M::Coordinates<f64>, now: &M::Coordinates<f64>, k: usize| {
            (now.as_ref()[k] - before.as_ref()[k]).abs()
        };
        let size = here.q.as_ref().iter().fold(1.0_f64, |size, q| size.max(1.0 + q.abs()));
        if (0..M::COORDINATES).any(|k| change(&here.q, &beyond.q, k) > CONTINUOUS * size) {
            return None;
        }
        let mut found = None;
        let mut most = 0.0;
        for group in M::model().plan.orientations {
            let step = Step::new(M::model(), group.step)?;
            let StepKind::Newton(unknowns) = step.info().kind else { continue };
            let own = step.info().coordinates.iter().take(unknowns);
            let change = own.fold(0.0, |most, &(k, _)| f64::max(most, change(&here.q_dot, &beyond.q_dot, k)));
            if change > most {
                (most, found) = (change, Some((step, group.margin)));
            }
        }
        let (step, margin) = found?;
        let located = Some(Located { at: reached, kind: None });
        Some(Limit { step, margin: beyond.margins.as_ref()[margin], located })
    }
}
