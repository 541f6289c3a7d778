//! Solutions by the plan, for analyses that compare them with Φ.

use crate::equations::Equations;
use crate::error::SolveError;
use crate::plan::{Depth, Plan, Solved};
use crate::planned::{Limit, Step};
use crate::signal::Instant;
use crate::workspace::Subset;

/// If the two closures of a group are nearer to one another than this, the mode of a configuration is undecided.
const UNDECIDED: f64 = 1e-6;

/// A solution by the plan, in buffers that are reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct Answer {
    pub(crate) q: Vec<f64>,
    pub(crate) q_dot: Vec<f64>,
    pub(crate) q_ddot: Vec<f64>,
    margins: Vec<f64>,
    branch_values: Vec<f64>,
}

/// True if the mechanism has a plan and no coordinates are prescribed.
pub(crate) fn exists(equations: &Equations<'_>) -> bool {
    equations.model.plan.exists() && equations.given() == 0
}

/// Writes the sign of every mode of q; 0 if it is undecided.
pub(crate) fn modes(equations: &Equations<'_>, q: &[f64], modes: &mut Vec<f64>) {
    modes.clear();
    let plan = &equations.model.plan;
    modes.resize(plan.signs(), 0.0);
    let at = equations.instant();
    if equations.system.branches(&at, q, modes).is_err() {
        modes.fill(0.0);
    }
    modes.truncate(plan.modes.len());
    for mode in modes {
        *mode = if mode.abs() > UNDECIDED { mode.signum() } else { 0.0 };
    }
}

impl Answer {
    /// Buffers for the solutions of these equations.
    pub(crate) fn new(equations: &Equations<'_>) -> Self {
        let n = vec![0.0; equations.coordinates()];
        let plan = &equations.model.plan;
        let (margins, branch_values) = (vec![0.0; plan.margins], vec![0.0; plan.signs()]);
        Self { q: n.clone(), q_dot: n.clone(), q_ddot: n, margins, branch_values }
    }

    /// Solves at the current instant in the given modes, from `start`.
    ///
    /// # Errors
    /// The first step without an acceptable solution; `None` if numbers are not finite.
    pub(crate) fn solve(
        &mut self,
        equations: &mut Equations<'_>,
        modes: &[f64],
        start: &[f64],
        depth: Depth,
    ) -> Result<(), Option<Limit>> {
        let Self { q, q_dot, q_ddot, margins, .. } = self;
        let at = Instant { t: equations.t, inputs: &equations.inputs };
        let solved = Solved { q, q_dot, q_ddot, margins };
        equations.system.solve(&at, modes, start, depth, solved).map_err(|_| None)?;
        if let Some(index) = self.margins.iter().position(|margin| *margin <= Plan::SMALLEST_MARGIN) {
            return Err(self.limit(equations, index));
        }
        let mut parts = [&self.margins, &self.q, &self.q_dot, &self.q_ddot].into_iter().take(2 + depth as usize);
        if parts.all(|part| part.iter().all(|x| x.is_finite())) { Ok(()) } else { Err(None) }
    }

    fn limit(&self, equations: &Equations<'_>, margin: usize) -> Option<Limit> {
        Step::of_margin(equations.model, margin).map(|step| Limit::new(step, self.margins[margin]))
    }

    /// True if q is certainly in these modes.
    pub(crate) fn is_in(&mut self, equations: &Equations<'_>, modes: &[f64], q: &[f64]) -> bool {
        let at = equations.instant();
        equations.system.branches(&at, q, &mut self.branch_values).is_ok()
            && modes.iter().zip(&self.branch_values).all(|(mode, value)| mode * value > UNDECIDED)
    }
}

/// The margins of a solution at the current instant from q, in the modes given by the signs of `modes`.
pub(crate) fn margins(equations: &mut Equations<'_>, modes: &[f64], q: &[f64]) -> Vec<f64> {
    let modes = modes.iter().take(equations.model.plan.modes.len());
    let modes: Vec<f64> = modes.map(|mode| mode.signum()).collect();
    let mut answer = Answer::new(equations);
    // An error is ignored: the margins show it.
    let _ = answer.solve(equations, &modes, q, Depth::Velocity);
    answer.margins
}

/// The first group that is at its limit or cannot close at the current instant, in the modes of q.
pub(crate) fn limit(equations: &mut Equations<'_>, q: &[f64]) -> Option<Limit> {
    if !exists(equations) {
        return None;
    }
    let mut signs = Vec::new();
    modes(equations, q, &mut signs);
    limit_in(equations, &signs, q)
}

/// Why a row has no value or no derivative at the solution of the plan in the modes of q, if no group is at a limit there:
/// the reason why no iteration closes the rows.
pub(crate) fn undefined(equations: &mut Equations<'_>, q: &[f64]) -> Option<SolveError> {
    if !exists(equations) || equations.model.plan.iterates() {
        return None;
    }
    let mut signs = Vec::new();
    modes(equations, q, &mut signs);
    signs.iter_mut().filter(|sign| **sign == 0.0).for_each(|sign| *sign = 1.0);
    let mut answer = Answer::new(equations);
    if let Err(Some(_)) = answer.solve(equations, &signs, q, Depth::Position) {
        return None;
    }
    // What a row without a value determines is no number either, and so are rows with that.
    answer.q.iter_mut().filter(|x| !x.is_finite()).for_each(|x| *x = 0.0);
    equations.evaluate(Subset::ALL, &answer.q, None).err().filter(|error| matches!(error, SolveError::NonFinite { .. }))
}

/// [`limit`] in the modes given by the signs of these numbers; 0 counts as +.
pub(crate) fn limit_in(equations: &mut Equations<'_>, modes: &[f64], q: &[f64]) -> Option<Limit> {
    if !exists(equations) {
        return None;
    }
    let modes = modes.iter().take(equations.model.plan.modes.len());
    let modes: Vec<f64> = modes.map(|&mode| if mode == 0.0 { 1.0 } else { mode.signum() }).collect();
    let answer = Answer::new(equations).solve(equations, &modes, q, Depth::Position);
    answer.err().flatten().filter(|limit| limit.step.closes() || limit.contradiction().is_some())
}
