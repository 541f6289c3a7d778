//! The global error of an integrated motion, and what it does to the rates.
//!
//! The length of a step bounds its local error, but not what becomes of that: the error e of q follows
//!
//! ```text
//! ė = v(q + e, t) − v(q, t)
//! ```
//!
//! and may grow without bound, as towards the end of y ẏ = −t at t = 1, where y = √(1 − t²) and e is proportional to 1/y. There
//! an error of 10⁻¹² moves the end by as much, so that an integration passes it and goes on where no motion exists. Once e
//! changes the velocity by a considerable part, the rates are unknown, and the motion ends.

use super::integrate::velocity;
use super::step::{Fault, Node, StepStart};
use crate::analysis::velocity::scaled;
use crate::equations::Equations;
use crate::nonlinear::newton::largest;

/// Largest change of the velocity by the error of q, relative to the largest velocity of the motion so far.
const MAX_CHANGE: f64 = 0.1;

/// The estimated global error at a node.
#[derive(Clone, Debug, Default)]
pub(super) struct GlobalError {
    /// The error e of q; empty before the first step.
    error: Vec<f64>,
    /// v(q + e) − v(q).
    change: Vec<f64>,
    /// The largest velocity so far, on the common scale.
    fastest: f64,
}

impl GlobalError {
    /// The error after a step with the local error `local`, by the trapezoidal rule; a fault where it dominates the velocity.
    pub(super) fn after(
        &self,
        equations: &mut Equations<'_>,
        from: StepStart<'_>,
        to: &Node,
        local: &[f64],
    ) -> Result<Self, Fault> {
        let (h, state, rank) = (to.s - from.s, &to.state, from.basis.factor.rank);
        let still = vec![0.0; local.len()];
        let [error, change] = [&self.error, &self.change].map(|old| if old.is_empty() { &still } else { old });
        // Local errors of different steps are taken not to cancel.
        let grown = |k: usize, rate: f64| {
            let e = error[k] + h * rate;
            e + local[k].abs().copysign(e)
        };
        let beside: Vec<f64> = state.q.iter().enumerate().map(|(k, q)| q + grown(k, change[k])).collect();
        let moved = velocity(equations, rank, [to.s, 0.0], &beside);
        // The row that the error changes most.
        let residuals = equations.times(&state.q_dot) + &equations.phi_t;
        let dominated = Fault::GlobalError(largest(&scaled(equations, &residuals)).0);
        equations.move_to(to.s)?;
        let Ok(moved) = moved else { return Err(dominated) };
        let now: Vec<f64> = moved.iter().zip(&state.q_dot).map(|(moved, v)| moved - v).collect();
        let size = |numbers: &[f64]| equations.scale.size(numbers);
        let fastest = self.fastest.max(size(&state.q_dot)).max(size(from.q_dot));
        // At rest, velocities of the size of rounding tell nothing. The comparison is written so that NaN is rejected.
        let negligible = equations.options.integration_tolerance / h.abs();
        let is_clear = size(&now) <= f64::max(MAX_CHANGE * fastest, negligible);
        if !is_clear {
            return Err(dominated);
        }
        let error = (0..local.len()).map(|k| grown(k, 0.5 * (change[k] + now[k]))).collect();
        Ok(Self { error, change: now, fastest })
    }
}
