//! The end of a motion at which a linear step is singular: its solution goes to infinity, or two branches cross.

use super::spot::{NO_MARGIN, Spot};
use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::plan::Plan;
use crate::planned::error::PlanError;
use crate::planned::follower::PlanFollower;
use crate::planned::group_limit::{Limit, LimitKind, Located};
use crate::planned::lists::BranchValues;
use crate::planned::step::Step;
use crate::planned::substeps::Blocked;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// How much larger than before a solution is that goes to infinity; it is inversely proportional to the determinant,
/// which at the limit is 0 but for rounding.
const POLE_GROWTH: f64 = 1e3;

/// How much larger a solution that goes to infinity becomes in an iteration, which is followed up to a distance from the
/// limit of about the spacing of numbers.
const UNBOUNDED: f64 = 1e6;

/// Smallest size of a solution before its limit, relative to the largest coordinate, that the size at the limit is
/// compared with.
const MIN_COMPARED_SIZE: f64 = 1e-3;

impl<M: Mechanism> PlanFollower<M> {
    /// The error where the determinant of a linear group changes its sign, and the place on the course at which it does.
    pub(super) fn refusal_at_pole(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        t: f64,
        (group, step): (usize, Step),
        blocked: &Blocked<M>,
    ) -> (PlanError, f64) {
        let Spot { s, margin, .. } = Spot::beyond(blocked.interval, (course.ends(), M::INPUTS == 0), &mut |s| {
            self.signed_margin(mechanism, course, s, group, blocked)
        });
        let kind = if self.goes_to_infinity(step, blocked) { LimitKind::Pole } else { LimitKind::BranchPoint };
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let at = course.at(s, inputs.as_mut());
        let is_there = margin <= Plan::SMALLEST_MARGIN.max(NO_MARGIN);
        let located = Some(Located { at, kind: is_there.then_some(kind) });
        (PlanError::Limit { t, limit: Limit { step, margin, located } }, s)
    }

    /// True if a coordinate of a step is much larger at the limit, in the trial state, than at the last place reached.
    pub(super) fn goes_to_infinity(&self, step: Step, blocked: &Blocked<M>) -> bool {
        is_larger(M::model(), step, [blocked.state.q.as_ref(), self.trial().q.as_ref()], POLE_GROWTH)
    }

    /// True if a coordinate of an iterated step has grown without bound on the way to the last place reached.
    pub(super) fn has_gone_to_infinity(&self, step: Step, blocked: &Blocked<M>) -> bool {
        is_larger(M::model(), step, [self.state().q.as_ref(), blocked.state.q.as_ref()], UNBOUNDED)
    }

    /// The margin of a linear group at a place of the course, negative where its determinant has the other sign.
    fn signed_margin(&mut self, mechanism: &M, course: &dyn Course, s: f64, group: usize, blocked: &Blocked<M>) -> f64 {
        let Some(of_margin) = M::model().plan.margin_of_group(group) else { return -1.0 };
        let margin = self.margin_at(mechanism, course, s, of_margin, blocked);
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let at = Instant { t: course.at(s, inputs.as_mut()), inputs: inputs.as_ref() };
        let found = BranchValues::at(mechanism, self.parameters.as_ref(), &at, self.trial().q.as_ref());
        let keeps = found.is_ok_and(|found| found.as_ref()[group] * self.branch.modes.as_ref()[group] > 0.0);
        if keeps { margin } else { -margin.abs() }
    }
}

/// True if a length or scalar of a step is larger by this factor in the second configuration than in the first. Angles do
/// not go to infinity: where two pins coincide, an angle is 0/0.
fn is_larger(model: &Model, step: Step, [q_before, q]: [&[f64]; 2], factor: f64) -> bool {
    let is_angle = |k: usize| model.coordinates.get(k).is_some_and(|coordinate| coordinate.kind.is_angle());
    let lengths = || step.info().coordinates.iter().map(|coordinate| coordinate.0).filter(|k| !is_angle(*k));
    let larger = |largest: f64, x: &f64| largest.max(x.abs());
    let all = q_before.iter().fold(0.0, larger);
    let before = lengths().filter_map(|k| q_before.get(k)).fold(MIN_COMPARED_SIZE * all, larger);
    let is_finite = lengths().all(|k| q.get(k).is_some_and(|x| x.abs() < factor * before));
    before > 0.0 && !is_finite
}
