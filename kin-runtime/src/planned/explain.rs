//! What stands in the way of an answer: arguments first, then steps of the plan in their order, then results.

use super::{Limit, PlanError, Planned, Step};
use crate::mechanism::Mechanism;
use crate::plan::{Plan, StepKind};
use crate::signal::Instant;

impl<M: Mechanism> Planned<'_, M> {
    /// Why what was tried is not good.
    #[cold]
    #[inline(never)]
    pub(super) fn explain(&self, at: &Instant<'_>) -> PlanError {
        let model = M::model();
        let tried = &self.states[1 - self.good];
        let t = at.t;
        let error = |what, index, name| PlanError::NonFinite { what, index, name, t };
        if !t.is_finite() {
            return error("t", 0, "t");
        }
        for (index, u) in at.inputs.iter().enumerate() {
            if ![u.value, u.rate, u.acceleration].iter().all(|x| x.is_finite()) {
                return error("inputs", index, model.inputs.get(index).copied().unwrap_or(""));
            }
        }
        let place = |numbers: &[f64]| numbers.iter().position(|x| !x.is_finite());
        if let Some(index) = place(self.parameters.as_ref()) {
            return error("parameters", index, model.parameters.get(index).map_or("", |p| p.name));
        }
        if let Some(index) = place(self.predicted.as_ref()).filter(|_| self.anew) {
            // What a restart begins with.
            return error("q", index, model.coordinates.get(index).map_or("", |c| c.name));
        }
        let margins = &tried.margins.as_ref()[..model.plan.margins];
        for (mode, sign) in model.plan.modes.iter().zip(self.modes.as_ref()) {
            if sign.is_nan() && margins.get(mode.margin).is_some_and(|margin| *margin > Plan::SMALLEST_MARGIN) {
                return PlanError::Undecided { t, mode: mode.name };
            }
        }
        for (index, &margin) in margins.iter().enumerate() {
            match Step::of_margin(model, index) {
                Some(step) if margin <= Plan::SMALLEST_MARGIN => {
                    let limit = Limit { step, margin };
                    return match step.info().kind {
                        StepKind::Closure if step.closes() => PlanError::Limit { t, limit },
                        StepKind::Watched(_) => PlanError::Contradiction { t, limit },
                        _ => PlanError::Singular { t, limit },
                    };
                }
                _ if margin.is_nan() => return error("margins", index, ""),
                _ => {}
            }
        }
        for (what, numbers) in [("q", &tried.q), ("q_dot", &tried.q_dot), ("q_ddot", &tried.q_ddot)] {
            if let Some(index) = place(numbers.as_ref()) {
                return error(what, index, model.coordinates.get(index).map_or("", |c| c.name));
            }
        }
        error("margins", 0, "")
    }
}
