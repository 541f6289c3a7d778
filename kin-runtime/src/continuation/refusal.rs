//! Why a motion does not go on.

use super::follow::natural_step;
use super::step::{Fault, Node, Start};
use crate::by_plan;
use crate::contact;
use crate::equations::Equations;
use crate::error::{Refusal, SolveError};
use crate::linear::{Factorization, null_space};
use crate::singular::dependent_rows;
use crate::state::State;
use crate::workspace::Subset;

/// Pivots below this, at the last configuration before a refused step, say that the motion ends in a singular one.
const NEARLY_SINGULAR: f64 = 1e-4;

/// Largest spacing of the numbers of t, relative to a step in which the motion turns as far as it may: where it is larger,
/// the rounding of t moves the mechanism visibly.
const COARSEST: f64 = 1e-2;

/// Why there is no way on from `start` to the place `refused`.
pub(super) fn refusal(equations: &mut Equations<'_>, start: &Start<'_>, refused: f64, fault: Fault) -> SolveError {
    let (row, reason) = match fault {
        Fault::Error(error) => return error,
        Fault::Open(row) => (Some(row), Refusal::NotAssembled),
        Fault::Jump(row) => (Some(row), Refusal::WouldJump),
        Fault::Coarse(_) => (None, Refusal::StepTooSmall),
    };
    let spacing = f64::EPSILON * start.s.abs();
    let reason = if spacing > COARSEST * natural_step(equations, start) { Refusal::TimeTooCoarse } else { reason };
    let t_refused = equations.time_at(refused);
    let Node { state: State { q, .. }, modes, .. } = start.node;
    let limit = equations.move_to(refused).ok().and_then(|()| by_plan::limit_in(equations, modes, q));
    let evaluated = equations.move_to(start.s).and_then(|()| equations.evaluate(Subset::VELOCITY, q, None));
    if let Err(error) = evaluated {
        return error;
    }
    let (t, expected_rank) = (equations.t, start.node.factor.rank);
    let all: Vec<usize> = (0..equations.rows()).collect();
    let columns = &equations.scale.columns;
    let factor = Factorization::revealing(&equations.scaled_rows(&all), columns, NEARLY_SINGULAR);
    if let Some(error) = contact::without_gradient(equations, NEARLY_SINGULAR) {
        return error;
    }
    if factor.rank < expected_rank {
        let left = null_space(&equations.scaled(&all).transpose(), NEARLY_SINGULAR);
        let rows = dependent_rows(equations, &left);
        let (rank, condition) = (factor.rank, factor.full_condition);
        return SolveError::Singular { t, rank, expected_rank, rows, condition, limit };
    }
    let names = |row| (equations.row_name(row), equations.joint_name(row));
    let (row_name, joint) = row.map_or(("", ""), names);
    SolveError::StepRefused { t, t_refused, row_name, joint, reason, limit }
}
