//! Velocity and acceleration analysis of a given configuration by the blocks of the plan, which is tried first wherever
//! it applies: Φ_q is factorised block by block, and all rows of Φ_q q̇ = −Φ_t or Φ_q q̈ = γ are compared with the
//! solution.

use super::Solver;
use super::by_plan::all_closed;
use crate::equations::residual::{Tolerances, write_lengths};
use crate::equations::system::Parts;
use crate::mechanism::Mechanism;
use crate::planned::branch::FAR_FROM_LIMITS;
use crate::scalar::compare::{all_above, all_finite};
use crate::signal::Instant;
use crate::workspace::{Array, Subset};

/// Largest residual of a row, relative to its terms: rounding of a regular system.
const ROUNDING: f64 = 1e-12;

impl<M: Mechanism> Solver<'_, M> {
    /// q̈ if q̇ is given, otherwise q̇. `None` near singular configurations, with redundant rows, and wherever the plan
    /// does not apply.
    pub(super) fn rates_by_blocks(&self, at: &Instant<'_>, q: &[f64], q_dot: Option<&[f64]>) -> Option<Vec<f64>> {
        let model = M::model();
        let parameters = self.mechanism.parameters::<f64>();
        let is_finite = all_finite(parameters.as_ref()) && all_finite(q) && q_dot.is_none_or(all_finite);
        if model.plan.has_redundant_rows() || !is_finite || !self.has_solution_by_plan(at) {
            return None;
        }
        let mut factors = M::Factors::<f64>::filled(0.0);
        self.mechanism.factorise_with(parameters.as_ref(), at, q, &mut factors).ok()?;
        let (first, end) = M::REGULAR;
        if !all_above(factors.as_ref().get(first..end)?, FAR_FROM_LIMITS) {
            return None;
        }

        let mut workspace = M::workspace::<f64>();
        let (still, satisfied) = (M::Coordinates::<f64>::filled(0.0), M::Rows::<f64>::filled(0.0));
        let (still, satisfied) = (still.as_ref(), satisfied.as_ref());
        let subset = if q_dot.is_some() { Subset::ALL } else { Subset::VELOCITY };
        let given = q_dot.unwrap_or(still);
        self.mechanism.evaluate_with(parameters.as_ref(), subset, at, q, given, &mut workspace).ok()?;
        let mut right = M::Rows::<f64>::filled(0.0);
        for (k, right) in right.as_mut().iter_mut().enumerate() {
            *right = if q_dot.is_some() { workspace.gamma()[k] } else { -workspace.phi_t()[k] };
        }
        let mut found = M::Coordinates::<f64>::filled(0.0);
        M::solve_factorised(&factors, right.as_ref(), found.as_mut()).ok()?;
        let found = found.as_ref();
        let is_certain = q_dot.is_none_or(|q_dot| self.slopes_are_certain(&parameters, at, [q, q_dot, found]));
        if !all_finite(found) || !is_certain || model.has_curves && !self.touches(at, q) {
            return None;
        }

        // The equations of one order are compared; those of the others are 0 = 0.
        let phi_q = workspace.phi_q();
        let (parts, solution) = match q_dot {
            Some(_) => (Parts { phi: satisfied, phi_q, phi_t: satisfied, gamma: workspace.gamma() }, [q, still, found]),
            None => (Parts { phi: satisfied, phi_q, phi_t: workspace.phi_t(), gamma: satisfied }, [q, found, still]),
        };
        let mut lengths = M::Coordinates::<f64>::filled(0.0);
        write_lengths(model, lengths.as_mut());
        let tolerances = Tolerances { position: ROUNDING, rates: ROUNDING };
        all_closed(model, &parts, solution, lengths.as_ref(), tolerances)?;
        Some(found.to_vec())
    }
}
