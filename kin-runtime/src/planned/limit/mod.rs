//! The cause and the location of the end of a motion: a fold (dead centre), beyond which a group does not close, or a
//! crossing of branches (branch point).
//!
//! The margin of a group, w², is a smooth function of the place on the course, even where w has a corner. It changes
//! its sign at a fold, and touches 0 at a crossing. So a motion that was stopped at the limit of a group ends at a root
//! or at a minimum of its margin. The solution of a linear system goes to infinity where its determinant changes its sign
//! (see `pole`).

mod fold;
mod iteration;
mod pole;
mod spot;

use super::error::PlanError;
use super::follower::{PlanFollower, PlanSolution, Rejection};
use super::group_limit::{Limit, LimitKind, Located};
use super::step::Step;
use super::substeps::Blocked;
use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::plan::{Depth, Plan, Solved, StepKind};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use spot::{NO_MARGIN, Spot};

/// Largest margin that counts as zero at a crossing, where the margin touches 0: its rounding error.
const TOUCHES: f64 = 1e-9;

/// If the margin is below minus this at the place where its sign changes, it is discontinuous there, and so is the
/// motion.
const DISCONTINUOUS_MARGIN: f64 = 1e-6;

impl<M: Mechanism> PlanFollower<M> {
    /// The error if the instant or a parameter is not finite.
    pub(super) fn unusable(&self, at: &Instant<'_>) -> Option<PlanError> {
        unusable(M::model(), self.parameters.as_ref(), at)
    }

    /// The reason why the trial state is not valid: arguments are checked first, then the steps of the plan in their
    /// order, then results.
    #[cold]
    #[inline(never)]
    pub(super) fn explain(&self, at: &Instant<'_>) -> PlanError {
        if let Some(error) = self.unusable(at) {
            return error;
        }
        let PlanSolution { q, q_dot, q_ddot, margins } = self.trial();
        let start = if self.starts_anew { self.predicted.as_ref() } else { &[] };
        let solution = [q.as_ref(), q_dot.as_ref(), q_ddot.as_ref()];
        explain(M::model(), at.t, start, self.branch.modes.as_ref(), (solution, margins.as_ref()))
    }

    /// The reason why a walk to the instant `at` was stopped: the group at its limit, with the location of the limit.
    #[cold]
    #[inline(never)]
    pub(super) fn refusal(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        at: &Instant<'_>,
        blocked: &Blocked<M>,
    ) -> PlanError {
        self.refusal_at(mechanism, course, at, blocked).0
    }

    /// [`refusal`](Self::refusal) with the place on the course of the limit or, where that is not known, of the last
    /// state reached.
    #[cold]
    #[inline(never)]
    pub(super) fn refusal_at(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        at: &Instant<'_>,
        blocked: &Blocked<M>,
    ) -> (PlanError, f64) {
        let last = blocked.interval[0];
        if let Some(error) = self.unusable(at) {
            return (error, last);
        }
        self.q_at_limit = None;
        let t = at.t;
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let reached = course.at(blocked.interval[0], inputs.as_mut());
        let Some(fault) = blocked.fault else { return (PlanError::TooManySteps { t: reached, t_refused: t }, last) };
        let instant = Instant { t: reached, inputs: inputs.as_ref() };
        if let Some(error) = self.coincident_points(mechanism, &instant, blocked.state.q.as_ref()) {
            return (error, last);
        }
        let plan = &M::model().plan;
        if let Rejection::Rounded(k) = fault {
            return (PlanError::rounded(M::model(), t, k), last);
        }
        let rates = [blocked.state.q.as_ref(), blocked.state.q_dot.as_ref()];
        if let Some(error) = self.end_of_row(mechanism, (course, last), rates, [reached, t]) {
            return (error, last);
        }
        let Some((of_margin, step)) = step_of(M::model(), fault) else {
            self.predicted = blocked.state.q;
            let error = match self.solve_in_modes(mechanism, at) {
                Ok(false) => self.explain(at),
                Ok(true) => match self.limit_of_iteration(mechanism, course, reached, blocked) {
                    Some(limit) => of_kind(t, limit),
                    None => PlanError::Jump { t: reached, t_refused: t },
                },
                Err(error) => error.into(),
            };
            return (error, last);
        };
        let Some(group) = plan.group_of_margin(of_margin) else {
            // How much redundant rows contradict the others at the instant requested, if the plan solves there.
            let margin_at_request = self.margin_at(mechanism, course, course.ends()[1], of_margin, blocked);
            let margin = match margin_at_request <= Plan::SMALLEST_MARGIN {
                true => margin_at_request,
                false => self.margin_at(mechanism, course, blocked.interval[1], of_margin, blocked),
            };
            return (of_kind(t, Limit { step, margin, located: Some(Located { at: reached, kind: None }) }), last);
        };
        let has_two_closures = group < plan.modes.len();
        if step.info().is_linear() {
            return self.refusal_at_pole(mechanism, course, t, (group, step), blocked);
        }
        if !has_two_closures && self.has_gone_to_infinity(step, blocked) {
            let margin = self.margin_at(mechanism, course, blocked.interval[1], of_margin, blocked);
            let located = Some(Located { at: reached, kind: Some(LimitKind::Pole) });
            return (PlanError::Limit { t, limit: Limit { step, margin, located } }, last);
        }
        // An iteration does not converge beyond a fold, so that its margin has no root: the limit is where the walk
        // stopped.
        let spot = if has_two_closures {
            self.locate(mechanism, course, of_margin, blocked)
        } else {
            let s = blocked.interval[1];
            let margin = self.margin_at(mechanism, course, s, of_margin, blocked);
            Spot { s, margin, least: margin }
        };
        let Spot { s, margin, least } = spot;
        if has_two_closures && margin < -DISCONTINUOUS_MARGIN {
            // The margin is nowhere zero, so the motion jumps.
            return (PlanError::Jump { t: reached, t_refused: t }, last);
        }
        // If the minimum is not zero, the search ended before the limit, which lies farther on.
        let is_there = has_two_closures && margin <= TOUCHES;
        if is_there && self.goes_to_infinity(step, blocked) {
            let located = Some(Located { at: course.at(s, inputs.as_mut()), kind: Some(LimitKind::Pole) });
            return (PlanError::Limit { t, limit: Limit { step, margin, located } }, s);
        }
        // A closed form has its margin on both sides of a fold; an iteration, which has not, is followed along the arc.
        let fold = if has_two_closures { None } else { self.fold(mechanism, course, group, blocked) };
        let found = fold.or_else(|| self.extrapolate(mechanism, course, (group, s), blocked));
        self.q_at_limit = found.as_ref().map(|found| found.q);
        let kind_found = found.as_ref().and_then(|found| found.kind);
        let kind = match kind_found {
            _ if is_there && least < -NO_MARGIN => Some(LimitKind::DeadCentre),
            Some(kind) => Some(kind),
            None => is_there.then_some(LimitKind::BranchPoint),
        };
        // A minimum is accurate to half of the digits, a root of the margin to all of them.
        let is_root = is_there && kind == Some(LimitKind::DeadCentre);
        let s = match &found {
            Some(found) if !is_root => found.s,
            _ => s,
        };
        let limit_at = course.at(s, inputs.as_mut());
        // The margin at the instant requested shows how far beyond its limit the group would be.
        let margin_at_request = self.margin_at(mechanism, course, course.ends()[1], of_margin, blocked);
        let margin = if margin_at_request <= Plan::SMALLEST_MARGIN { margin_at_request } else { margin };
        (of_kind(t, Limit { step, margin, located: Some(Located { at: limit_at, kind }) }), s)
    }

    /// The margin of this index at a place of the course, in the current modes.
    fn margin_at(&mut self, mechanism: &M, course: &dyn Course, s: f64, margin: usize, blocked: &Blocked<M>) -> f64 {
        let plan = &M::model().plan;
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let t = course.at(s, inputs.as_mut());
        let start = blocked.state.q;
        let spare = &mut self.states[1 - self.accepted];
        let margins = spare.margins.as_mut();
        let (q, q_dot, q_ddot) = (spare.q.as_mut(), spare.q_dot.as_mut(), spare.q_ddot.as_mut());
        let solved = Solved { q, q_dot, q_ddot, margins };
        let modes = self.branch.modes.of_closures();
        let at = Instant { t, inputs: inputs.as_ref() };
        let solution = mechanism.solve_with(
            self.parameters.as_ref(),
            &at,
            modes,
            start.as_ref(),
            // The margins of iterations depend on velocities.
            if plan.iterates() { Depth::Velocity } else { Depth::Position },
            solved,
        );
        let margin = self.trial().margins.as_ref()[margin];
        // An undefined margin counts as negative.
        if solution.is_ok() && !margin.is_nan() { margin } else { -1.0 }
    }

    /// The place beyond the last place reached at which the margin of this index is zero or has its minimum.
    fn locate(&mut self, mechanism: &M, course: &dyn Course, margin: usize, blocked: &Blocked<M>) -> Spot {
        Spot::beyond(blocked.interval, (course.ends(), M::INPUTS == 0), &mut |s| {
            self.margin_at(mechanism, course, s, margin, blocked)
        })
    }
}

/// The error if the instant or a parameter is not finite.
fn unusable(model: &Model, parameters: &[f64], at: &Instant<'_>) -> Option<PlanError> {
    let t = at.t;
    let error = |what, index, name| Some(PlanError::NonFinite { what, index, name, t });
    if !t.is_finite() {
        return error("t", 0, "t");
    }
    for (index, u) in at.inputs.iter().enumerate() {
        if ![u.value, u.rate, u.acceleration].iter().all(|x| x.is_finite()) {
            return error("inputs", index, model.inputs.get(index).copied().unwrap_or(""));
        }
    }
    let index = parameters.iter().position(|x| !x.is_finite())?;
    error("parameters", index, model.parameters.get(index).map_or("", |p| p.name))
}

/// The reason why the solution q, q̇, q̈ with these margins is not valid; `start` is the q from which a restart begins,
/// otherwise empty.
fn explain(
    model: &'static Model,
    t: f64,
    start: &[f64],
    modes: &[f64],
    (solution, margins): ([&[f64]; 3], &[f64]),
) -> PlanError {
    let error = |what, index, name| PlanError::NonFinite { what, index, name, t };
    let place = |numbers: &[f64]| numbers.iter().position(|x| !x.is_finite());
    let coordinate = |index: usize| model.coordinates.get(index).map_or("", |c| c.name);
    if let Some(index) = place(start) {
        return error("q", index, coordinate(index));
    }
    for (mode, sign) in model.plan.modes.iter().zip(modes) {
        if sign.is_nan() && margins.get(mode.margin).is_some_and(|margin| *margin > Plan::SMALLEST_MARGIN) {
            return PlanError::Undecided { t, mode: mode.name };
        }
    }
    for (index, &margin) in margins.iter().enumerate() {
        match Step::of_margin(model, index) {
            Some(step) if margin <= Plan::SMALLEST_MARGIN => return of_kind(t, Limit::new(step, margin)),
            _ if margin.is_nan() => return error("margins", index, ""),
            _ => {}
        }
    }
    for (what, numbers) in ["q", "q_dot", "q_ddot"].into_iter().zip(solution) {
        if let Some(index) = place(numbers) {
            return error(what, index, coordinate(index));
        }
    }
    error("margins", 0, "")
}

/// The margin because of which a step was rejected, and the step of the plan to which it belongs; `None` where no step
/// of the plan is at its limit.
fn step_of(model: &'static Model, fault: Rejection) -> Option<(usize, Step)> {
    let index = match fault {
        Rejection::Margin(index) => index,
        Rejection::Group(group) => model.plan.margin_of_group(group)?,
        Rejection::Coarse | Rejection::Rounded(_) | Rejection::NonFinite => return None,
    };
    Step::of_margin(model, index).map(|step| (index, step))
}

/// The error of a step whose margin is not positive.
fn of_kind(t: f64, limit: Limit) -> PlanError {
    match limit.step.info().kind {
        StepKind::Closure if limit.step.closes() => PlanError::Limit { t, limit },
        StepKind::RedundantRows => PlanError::Contradiction { t, limit },
        _ => PlanError::Singular { t, limit },
    }
}

#[cfg(test)]
mod tests;
