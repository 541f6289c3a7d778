//! The reason why a motion cannot be continued.

use super::nodes::natural_step;
use super::step::{Fault, Node, StepStart};
use crate::analysis::by_plan;
use crate::analysis::singular::dependent_rows;
use crate::equations::Equations;
use crate::equations::contact;
use crate::error::{Refusal, SolveError};
use crate::linear::{Factorization, null_space};
use crate::planned::follower::Control;
use crate::planned::row_end::{RowEnd, RowsBeyond, row_end};
use crate::planned::{Limit, LimitKind};
use crate::signal::Instant;
use crate::state::State;
use crate::workspace::Subset;

/// Relative pivots below this, at the last configuration before a refused step, mean that the motion ends in a singular
/// configuration.
const NEARLY_SINGULAR: f64 = 1e-4;

/// Largest spacing of floating-point numbers near t, relative to the longest step that the options allow: with a larger
/// spacing, the rounding of t moves the mechanism visibly.
const MAX_TIME_SPACING: f64 = 1e-2;

/// Largest distance of a limit from the last instant tried, relative to the longest step that the options allow.
const LIMIT_DISTANCE: f64 = 1e-3;

/// The same beyond which a limit is not the one at which the motion ends, but one that the plan found before full Newton
/// went on. Steps shrink with the distance from a dead centre, and motions end less than ten of them before it.
const OTHER_LIMIT_DISTANCE: f64 = 100.0;

/// The error with the reason why the motion cannot go from `start` to the place `refused` on its way from the last instant
/// to `target`.
/// `located` is the limit that the plan found, and `jumps` is true if the plan found that a row or an input jumps.
pub(super) fn refusal(
    equations: &mut Equations<'_>,
    (last_instant, start): (&State, &StepStart<'_>),
    [refused, target]: [f64; 2],
    fault: Fault,
    (located, jumps): (Option<Limit>, bool),
) -> SolveError {
    if let Some(error) = coincident_points(equations, start) {
        return error;
    }
    // Where full Newton solves although there is a plan, the plan still knows where and why the motion ends.
    let located = located.or_else(|| limit_by_plan(equations, last_instant, target));
    // The plan has looked for the end of a row before it located a limit.
    let ended = if located.is_none() { end_of_row(equations, start, target) } else { None };
    if let Some((row, reason)) = ended {
        let t = equations.time_at(start.s);
        let (row_name, joint) = (equations.row_name(row), equations.joint_name(row));
        return SolveError::StepRefused { t, t_refused: t, row_name, joint, reason, limit: None };
    }
    let (row, reason) = match fault {
        Fault::Error(error) => return error,
        Fault::Open(row) => (Some(row), Refusal::NotAssembled),
        Fault::Jump(row) => (Some(row), Refusal::WouldJump),
        Fault::Rounded(row) => (Some(row), Refusal::Rounded),
        Fault::GlobalError(row) => (Some(row), Refusal::GlobalError),
        Fault::Coarse(_) => (None, Refusal::StepTooSmall),
    };
    let spacing = f64::EPSILON * start.s.abs();
    let natural = natural_step(equations, [&start.node.state.q, start.q_dot, start.q_ddot], 1.0, &start.basis.turns);
    let is_coarse = spacing > MAX_TIME_SPACING * natural;
    let jumps = jumps && !is_coarse;
    let reason = match reason {
        _ if is_coarse => Refusal::TimeTooCoarse,
        _ if jumps => Refusal::Discontinuous,
        reason => reason,
    };
    let t_refused = equations.time_at(refused);
    let Node { state: State { q, .. }, .. } = start.node;
    let groups = &start.basis.groups;
    let limit_beyond = |equations: &mut Equations<'_>| {
        equations.move_to(refused).ok().and_then(|()| by_plan::limit_in(equations, groups, q))
    };
    let (t_here, after_natural) = (equations.time_at(start.s), equations.time_at(start.s + natural));
    let step = (after_natural - t_here).abs();
    let is_here = |limit: &Limit| limit.at().is_some_and(|at| !is_elsewhere(at, [t_here, t_refused], step));
    // A limit that was looked for on the way from the last instant is the first one, however early full Newton ends, but
    // not one that full Newton has passed: redundant rows lead through branch points of the rows that the plan solves.
    let ahead = (t_refused - t_here).signum();
    let is_passed = |at: f64| step.is_finite() && (t_here - at) * ahead > OTHER_LIMIT_DISTANCE * step;
    let located = located.filter(|limit| match equations.options.use_plan {
        true => is_here(limit),
        false => !limit.at().is_some_and(is_passed),
    });
    let limit = located.or_else(|| limit_beyond(equations)).filter(|_| !jumps);
    let evaluated = equations.move_to(start.s).and_then(|()| equations.evaluate(Subset::VELOCITY, q, None));
    if let Err(error) = evaluated {
        return error;
    }
    let expected_rank = start.basis.factor.rank;
    // The instant of the limit itself is reported if the motion was followed up to it.
    let t = limit
        .and_then(|limit| limit.at())
        .filter(|at| is_between(*at, t_here, t_refused, LIMIT_DISTANCE * step))
        .unwrap_or(equations.t);
    let all: Vec<usize> = (0..equations.rows()).collect();
    let columns = &equations.scale.columns;
    let factor = Factorization::revealing(&equations.scaled_rows(&all), columns, NEARLY_SINGULAR);
    // Where the motion turns back, a gradient that is merely small is not the reason.
    let turns_back = limit.and_then(|limit| limit.kind()) == Some(LimitKind::DeadCentre);
    let least = if turns_back { equations.options.rank_tolerance } else { NEARLY_SINGULAR };
    if let Some(error) = contact::without_gradient(equations, least) {
        return error;
    }
    if factor.rank < expected_rank {
        let null_vectors = null_space(&equations.scaled(&all).transpose(), NEARLY_SINGULAR);
        let rows = dependent_rows(equations, &null_vectors);
        let (rank, condition) = (factor.rank, factor.full_condition);
        return SolveError::Singular { t, rank, expected_rank, rows, condition, limit };
    }
    // A row that vanishes is singular, too, although its pivot is not small relative to itself.
    let vanishing: Vec<usize> =
        all.iter().copied().filter(|&row| equations.largest_scaled(row) <= NEARLY_SINGULAR).collect();
    if let Some(&first) = vanishing.first() {
        let condition = factor.full_condition.max(1.0 / equations.largest_scaled(first));
        let rows = vanishing.iter().map(|&row| equations.row_name(row)).collect();
        let rank = expected_rank.saturating_sub(vanishing.len());
        return SolveError::Singular { t, rank, expected_rank, rows, condition, limit };
    }
    let names = |row| (equations.row_name(row), equations.joint_name(row));
    let (row_name, joint) = row.map_or(("", ""), names);
    SolveError::StepRefused { t, t_refused, row_name, joint, reason, limit }
}

/// The limit at which the plan ends the motion from an instant to `target`, where full Newton solves although there is a
/// plan.
fn limit_by_plan(equations: &mut Equations<'_>, from: &State, target: f64) -> Option<Limit> {
    if equations.options.use_plan || !by_plan::exists(equations) || equations.time_at(target) != target {
        return None;
    }
    equations.system.follow_from(&from.instant(), &from.q).ok()?;
    // A length may be negative at the target, although the motion ends before.
    let _ = equations.move_to(target);
    let (control, inputs) = (Control::of(&equations.options), equations.input_function());
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let mut state = from.clone();
    equations.system.follow(&at, inputs, &control, &mut state).err()?.limit().copied()
}

/// The rows at a distance from a place of the course.
struct FromPlace<'a, 'e> {
    equations: &'a mut Equations<'e>,
    s: f64,
}

impl RowsBeyond for FromPlace<'_, '_> {
    fn write(&mut self, distance: f64, q: &[f64], phi: &mut [f64]) -> bool {
        let Self { equations, s } = self;
        if equations.move_to(*s + distance).is_err() {
            return false;
        }
        let at = Instant { t: equations.t, inputs: &equations.inputs };
        let still = vec![0.0; q.len()];
        let is_known = equations.system.evaluate(Subset::PHI, &at, q, &still).is_ok();
        phi.copy_from_slice(equations.system.constraints().phi);
        is_known
    }
}

/// The error if two points coincide at the place that a motion has reached.
fn coincident_points(equations: &mut Equations<'_>, start: &StepStart<'_>) -> Option<SolveError> {
    equations.move_to(start.s).ok()?;
    let row = equations.row_with_coincident_points(&start.node.state.q)?;
    let (t, row_name, joint) = (equations.t, equations.row_name(row), equations.joint_name(row));
    Some(SolveError::StepRefused { t, t_refused: t, row_name, joint, reason: Refusal::Coincident, limit: None })
}

/// The row of the mechanism that ends just beyond the place that a motion has reached, and the reason why the motion ends
/// there.
fn end_of_row(equations: &mut Equations<'_>, start: &StepStart<'_>, target: f64) -> Option<(usize, Refusal)> {
    let rows = equations.model.rows.len();
    let [mut phi, mut other] = [(); 2].map(|()| vec![0.0; rows]);
    let mut at = vec![0.0; start.q_dot.len()];
    let rates = [&start.node.state.q[..], start.q_dot];
    let (length, spacing) = (target - start.s, f64::EPSILON * start.s.abs());
    let mut place = FromPlace { equations, s: start.s };
    Some(match row_end(&mut place, rates, (length, spacing), (&mut at, [&mut phi, &mut other]))? {
        RowEnd::Undefined(row) => (row, Refusal::Undefined),
        RowEnd::Jump(row) => (row, Refusal::Discontinuous),
    })
}

/// True for the time of a limit at which a motion that ends between these two times cannot end. `step` is the longest step
/// there; it is not finite where it has no bound or time stands still, so that no limit is known to be elsewhere.
fn is_elsewhere(t: f64, [from, refused]: [f64; 2], step: f64) -> bool {
    step.is_finite() && !is_between(t, from, refused, OTHER_LIMIT_DISTANCE * step)
}

/// True for a time between two others, or outside of them by no more than `beside` and rounding.
fn is_between(t: f64, a: f64, b: f64, tolerance: f64) -> bool {
    let tolerance = tolerance + 1e-9 * a.abs().max(b.abs());
    t >= a.min(b) - tolerance && t <= a.max(b) + tolerance
}

#[cfg(test)]
mod tests {
    use super::{is_between, is_elsewhere};

    #[test]
    fn a_time_is_on_the_way_in_either_direction_or_just_beside_it() {
        for (a, b) in [(2.0, 3.0), (3.0, 2.0)] {
            let on_the_way = |t: f64| is_between(t, a, b, 0.1);
            assert!([1.91, 2.0, 2.5, 3.0, 3.09].into_iter().all(on_the_way));
            assert!(![1.89, 3.11, f64::NAN, -2.5].into_iter().any(on_the_way));
            // The times themselves are rounded.
            let to_rounding = |t: f64| is_between(t, a, b, 0.0);
            assert!([2.0 - 2.9e-9, 3.0 + 2.9e-9].into_iter().all(to_rounding));
            assert!(![2.0 - 3.1e-9, 3.0 + 3.1e-9].into_iter().any(to_rounding));
        }
        // The rounding is that of the time with the larger absolute value.
        assert!(is_between(1e-7, -200.0, 0.0, 0.0) && !is_between(3e-7, -200.0, 0.0, 0.0));
    }

    #[test]
    fn a_limit_that_is_many_steps_away_is_another_one() {
        for refused in [0.5746, 0.5747] {
            let elsewhere = |t: f64| is_elsewhere(t, [0.5746, refused], 1e-6);
            assert!([1.2697, 0.5749, 0.574_49, -1.0].into_iter().all(elsewhere), "{refused}");
            assert!(![0.5746, 0.574_69, 0.574_51].into_iter().any(elsewhere), "{refused}");
        }
        for step in [f64::INFINITY, f64::NAN] {
            assert!(!is_elsewhere(1.2697, [0.5746, 0.5747], step));
        }
    }
}
