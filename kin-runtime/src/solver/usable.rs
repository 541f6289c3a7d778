//! Whether the plan may be used for one instant, and whether its solution is regular where only the solution shows it.

use super::Solver;
use crate::equations::contact::is_regular;
use crate::equations::dimensions::first_degenerate;
use crate::mechanism::Mechanism;
use crate::model::{Geometry, JointInfo, Model, Role};
use crate::signal::{Instant, Signal};

impl<M: Mechanism> Solver<'_, M> {
    /// True if the plan determines all coordinates, the geometry of the joints is not degenerate, and no contact with a
    /// curve can be.
    pub(crate) fn goes_by_plan(&self, at: &Instant<'_>) -> bool {
        !M::model().has_curves && self.has_solution_by_plan(at)
    }

    /// True if the plan determines all coordinates and the geometry of the joints is not degenerate. Contacts with
    /// curves may be degenerate at the solution.
    pub(super) fn has_solution_by_plan(&self, at: &Instant<'_>) -> bool {
        let model = M::model();
        let usable =
            self.settings.options.use_plan && self.settings.given.is_empty() && self.settings.options.check().is_ok();
        usable && has_plan_for(model, at) && (!model.has_sizes || self.is_sound(at))
    }

    /// True if no dimension of a joint is degenerate at these parameters.
    fn is_sound(&self, at: &Instant<'_>) -> bool {
        let model = M::model();
        let parameters = self.mechanism.parameters::<f64>();
        let mut numbers = vec![0.0; model.geometry];
        if self.mechanism.write_geometry(parameters.as_ref(), at, &mut numbers).is_err() {
            return false;
        }
        are_sound(model, &numbers)
    }

    /// True if the contacts with all curves are defined at q.
    #[cold]
    pub(super) fn touches(&self, at: &Instant<'_>, q: &[f64]) -> bool {
        self.equations(at).and_then(|mut equations| is_regular(&mut equations, None, q)).unwrap_or(false)
    }
}

/// True if the plan solves the mechanism, and the instant has all inputs and only finite numbers.
fn has_plan_for(model: &Model, at: &Instant<'_>) -> bool {
    let finite = |u: &Signal| u.value.is_finite() && u.rate.is_finite() && u.acceleration.is_finite();
    let is_usable = at.t.is_finite() && at.inputs.len() == model.inputs.len() && at.inputs.iter().all(finite);
    is_usable && model.plan.exists()
}

/// True if no dimension of a joint is degenerate and the distances that joints keep exist; `numbers` is the geometry.
fn are_sound(model: &'static Model, numbers: &[f64]) -> bool {
    let exists = |joint: &JointInfo, piece: &Geometry| {
        let value = numbers.get(piece.offset).filter(|_| piece.role == Role::Value);
        value.is_none_or(|value| value.is_finite() && (*value >= 0.0 || !joint.keeps_distance()))
    };
    first_degenerate(model, numbers).is_none()
        && model.joints.iter().all(|joint| joint.geometry.iter().all(|piece| exists(joint, piece)))
}
