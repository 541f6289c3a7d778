//! The end of a motion in an iteration whose margin does not show it: where all entries of a row vanish together, and
//! all terms of each of them, the solutions that meet there have regular margins on both sides.

use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::plan::{Plan, StepKind};
use crate::planned::follower::PlanFollower;
use crate::planned::group_limit::{Limit, Located};
use crate::planned::step::Step;
use crate::planned::substeps::Blocked;
use crate::signal::Signal;
use crate::workspace::Array;

/// Largest difference between the numbers on both sides of the place at which a motion ends, relative to the largest of
/// them, for which they count as equal.
const CONTINUOUS: f64 = 1e-4;

impl<M: Mechanism> PlanFollower<M> {
    /// The limit of the first group whose rates jump where no step is short enough, if that group is iterated and no
    /// position jumps there. Where a driver jumps, the rates of an earlier group do, or those of its own coordinate. If no
    /// rates jump, the limit is that of the first iteration.
    pub(super) fn limit_of_iteration(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        reached: f64,
        blocked: &Blocked<M>,
    ) -> Option<Limit> {
        if !M::model().plan.iterates() {
            return None;
        }
        self.predicted = blocked.state.q;
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        if !self.solve_at(mechanism, course, blocked.interval[1], &mut inputs).unwrap_or(false) {
            return None;
        }
        let (last, beyond) = (&blocked.state, self.trial());
        let (index, margin) = iterated_that_changes(
            &M::model().plan,
            [last.q.as_ref(), beyond.q.as_ref()],
            [last.q_dot.as_ref(), beyond.q_dot.as_ref()],
        )?;
        let (step, at_margin) = (Step::new(M::model(), index)?, beyond.margins.as_ref()[margin]);
        let group = M::model().plan.group_of_margin(margin);
        let fold = group.and_then(|group| self.fold(mechanism, course, group, blocked));
        self.q_at_limit = fold.as_ref().map(|fold| fold.q);
        let located = match fold {
            Some(fold) => Located { at: course.at(fold.s, inputs.as_mut()), kind: fold.kind },
            None => Located { at: reached, kind: None },
        };
        Some(Limit { step, margin: at_margin, located: Some(located) })
    }
}

/// The first step whose rates jump, or else the first that iterates, and its margin; `None` if it does not iterate or if a
/// position jumps.
fn iterated_that_changes(plan: &Plan, q: [&[f64]; 2], q_dot: [&[f64]; 2]) -> Option<(usize, usize)> {
    if changes(q, 1.0).next().is_some() {
        return None;
    }
    let given_by =
        |k: usize| plan.steps.iter().position(|step| step.coordinates.iter().any(|coordinate| coordinate.0 == k));
    let first = changes(q_dot, 0.0).filter_map(given_by).min();
    let is_iterated = |index: &usize| matches!(plan.steps[*index].kind, StepKind::Newton(_));
    let index = first.or_else(|| (0..plan.steps.len()).find(is_iterated)).filter(is_iterated)?;
    let group = plan.orientations.iter().find(|group| group.step == index)?;
    Some((index, group.margin))
}

/// The indices of the numbers that differ between two lists, which are compared with their largest number plus `least`.
fn changes<'a>([before, now]: [&'a [f64]; 2], least: f64) -> impl Iterator<Item = usize> + 'a {
    let largest = before.iter().chain(now).fold(0.0_f64, |most, x| most.max(x.abs()));
    let allowed = CONTINUOUS * (largest + least);
    let pairs = before.iter().zip(now).enumerate();
    pairs.filter(move |(_, (a, b))| (*a - *b).abs() > allowed).map(|(k, _)| k)
}
