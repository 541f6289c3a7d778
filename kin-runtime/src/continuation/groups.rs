//! The branch of every group of a plan, for configurations that full Newton has found.
//!
//! What [`planned::branch`](crate::planned::branch) asks of a solution by the plan is asked of every configuration here:
//! each group on its own side of where its branches meet, and as far from there as the prediction has it. One sign for
//! the whole mechanism would not do: two groups that change theirs in one step leave it as it was.

use crate::by_plan;
use crate::equations::Equations;
use crate::planned::branch::{OUT_OF_REACH, certainty_of, resolves};
use crate::planned::limit::{blurred_group, largest_angle};

/// Nearer than this to where its branches meet a group is on neither of them: as near as rounding lets it be told.
const SMALLEST: f64 = 1e-6;

/// Condition numbers of the scaled Φ_q below which no configuration is near to a singular one.
const REGULAR: f64 = 1e3;

/// Deviation of a closure from its prediction, relative to the larger one, where redundant rows carry the motion past its
/// limit; and how near to it both may be.
const PASSING: f64 = 0.5;
const FLAT: f64 = 1e-3;

/// Writes what tells the branches of every group apart at q; nothing where there is no plan.
pub(super) fn write(equations: &Equations<'_>, q: &[f64], groups: &mut Vec<f64>) {
    groups.clear();
    if equations.given() > 0 {
        return;
    }
    groups.resize(equations.model.plan.signs(), 0.0);
    if equations.system.branches(&equations.instant(), q, groups).is_err() {
        groups.fill(f64::NAN);
    }
}

/// True where every group has stayed on its branch, from a configuration `before` over a prediction to what was found.
///
/// With redundant rows a group of the kept ones may have a limit that the mechanism passes: then the sign may change, as
/// the prediction has it.
pub(super) fn stay([before, predicted, found]: [&[f64]; 3], turn: f64, is_redundant: bool) -> bool {
    before.iter().zip(predicted).zip(found).all(|((before, predicted), found)| {
        if is_redundant {
            let size = found.abs().max(predicted.abs());
            return (found - predicted).abs() <= PASSING * size || size <= FLAT;
        }
        let sign = before.signum();
        let nearest = f64::min(sign * found, sign * before);
        sign * found > SMALLEST
            && (nearest >= OUT_OF_REACH * turn || resolves(nearest, turn) >= 0.0)
            && certainty_of(sign * found, sign * predicted) >= 0.0
    })
}

/// True where rates mean nothing, so near to a crossing of branches, given the condition number of Φ_q.
pub(super) fn are_blurred(
    equations: &mut Equations<'_>,
    groups: &[f64],
    [q, q_dot, q_ddot]: [&[f64]; 3],
    condition: f64,
) -> bool {
    if groups.is_empty() || condition < REGULAR {
        return false;
    }
    // What the plan divides by may be small where its closures are far apart.
    let margins = by_plan::margins(equations, groups, q);
    let plan = &equations.model.plan;
    let by_margin = |sign: usize| plan.margin_of_sign(sign).map_or(1.0, |place| margins[place].max(0.0).sqrt());
    let distances: Vec<f64> = groups.iter().enumerate().map(|(sign, w)| w.abs().min(by_margin(sign))).collect();
    let further = 1e-6 / largest_angle(equations.model, q_dot);
    let ahead: Vec<f64> = q.iter().zip(q_dot).map(|(q, v)| q + further * v).collect();
    let mut rates = Vec::new();
    write(equations, &ahead, &mut rates);
    rates.iter_mut().zip(groups).for_each(|(then, now)| *then = (*then - now) / further);
    blurred_group(equations.model, [groups, &rates], &distances, [q_dot, q_ddot]).is_some()
}

/// How near the nearest group is to where its branches meet.
pub(super) fn nearest(groups: &[f64]) -> f64 {
    groups.iter().fold(1.0, |least, w| f64::min(least, w.abs()))
}
