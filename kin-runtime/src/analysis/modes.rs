//! Assembly modes of configurations, and assembly in given modes.

use crate::analysis;
use crate::analysis::assemble::{assemble, propagated};
use crate::analysis::by_plan::{self, Answer};
use crate::analysis::position::{Position, position};
use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::plan::Depth;
use crate::planned::{Limit, PlanError, Sign, Step};
use crate::state::State;
use crate::text::number;
use core::fmt;

/// A mode of a configuration.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Mode {
    /// Its name: the names of its joints, joined with `-`.
    pub name: &'static str,
    /// The kinematic group that it belongs to, `RRR` for example; empty for a group without a name.
    pub group: &'static str,
    /// The joints of the group.
    pub joints: Vec<&'static str>,
    /// Which of its two closures the configuration has; none where the two coincide.
    pub sign: Option<Sign>,
    /// A number in −1 ≤ w ≤ 1 with that sign; its size measures the distance from the limit at which the closures
    /// coincide.
    pub closure: f64,
}

/// The start of assembly: guesses, and the requested modes by their indices.
#[derive(Clone, Debug)]
pub(crate) struct WantedAssembly {
    pub(crate) guess: Vec<Option<f64>>,
    pub(crate) modes: Vec<(usize, Sign)>,
}

/// The modes of q.
pub(crate) fn modes(equations: &Equations<'_>, q: &[f64]) -> Result<Vec<Mode>, SolveError> {
    equations.check("q", q)?;
    let plan = &equations.model.plan;
    if let Some(why) = plan.absent {
        return Err(SolveError::Plan(PlanError::NoPlan { why }));
    }
    let mut closures = vec![0.0; plan.signs()];
    equations.system.branches(&equations.instant(), q, &mut closures)?;
    let mode = |(info, closure): (&crate::plan::ModeInfo, f64)| {
        let step = Step::new(equations.model, info.step);
        Mode {
            name: info.name,
            group: step.map_or("", |step| step.info().group),
            joints: step.map_or_else(Vec::new, |step| step.joints().collect()),
            sign: Sign::of(closure),
            closure,
        }
    };
    Ok(plan.modes.iter().zip(closures).map(mode).collect())
}

/// The state near a complete start, or the one that the guesses lead to, and the factorised Φ_q there.
pub(crate) fn first_state(
    equations: &mut Equations<'_>,
    start: Option<&[f64]>,
    wanted: impl FnOnce() -> Result<WantedAssembly, SolveError>,
) -> Result<(State, Factorization), SolveError> {
    let position = match start {
        Some(start) => position(equations, start)?,
        None => assemble_in(equations, &wanted()?)?,
    };
    analysis::state(equations, position)
}

/// The configuration that the guesses lead to, in the requested modes.
///
/// First it is assembled without regard to modes. Then the plan solves with the requested signs; all other modes are
/// those of the assembled configuration or, if there is none, of the guess. Full Newton closes the result of the plan.
pub(crate) fn assemble_in(equations: &mut Equations<'_>, wanted: &WantedAssembly) -> Result<Position, SolveError> {
    let assembled = assemble(equations, &wanted.guess);
    if wanted.modes.is_empty() {
        return assembled;
    }
    if !by_plan::exists(equations) {
        let why = equations.model.plan.absent.unwrap_or("coordinates are prescribed");
        return Err(SolveError::Plan(PlanError::NoPlan { why }));
    }
    let near = match &assembled {
        Ok(position) => position.q.clone(),
        Err(SolveError::NotAssembled { .. }) => propagated(equations, &wanted.guess),
        Err(_) => return assembled,
    };
    let mut signs = Vec::new();
    by_plan::modes(equations, &near, &mut signs);
    let found = signs.clone();
    wanted.modes.iter().for_each(|&(index, sign)| signs[index] = sign.value());
    if assembled.is_ok() && found == signs {
        return assembled;
    }
    signs.iter_mut().filter(|sign| **sign == 0.0).for_each(|sign| *sign = 1.0);
    let mut answer = Answer::new(equations);
    answer.solve(equations, &signs, &near, Depth::Position).map_err(|limit| refusal(equations, wanted, limit))?;
    let closed = position(equations, &answer.q)?;
    if answer.is_in(equations, &signs, &closed.q) { Ok(closed) } else { Err(refusal(equations, wanted, None)) }
}

/// The error for requested modes that have no configuration.
fn refusal(equations: &Equations<'_>, wanted: &WantedAssembly, limit: Option<Limit>) -> SolveError {
    let name = |index: usize| equations.model.plan.modes.get(index).map_or("", |mode| mode.name);
    let modes = wanted.modes.iter().map(|&(index, sign)| (name(index), sign)).collect();
    SolveError::ModeNotAssembled { t: equations.t, modes, limit }
}

/// `A-B-D: - (closure -0.735)`.
impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name)?;
        match self.sign {
            Some(sign) => sign.fmt(f)?,
            None => f.write_str("undecided")?,
        }
        f.write_str(" (closure ")?;
        number(f, &self.closure)?;
        f.write_str(")")
    }
}
