//! The branch of every group of a plan, for configurations that full Newton has found.
//!
//! What [`planned::branch`](crate::planned::branch) asks of a solution by the plan is asked of every configuration here:
//! each group on its own side of where its branches meet, and as far from there as the prediction has it. One sign for
//! the whole mechanism would not do: two groups that change theirs in one step leave it as it was.

use crate::equations::Equations;
use crate::model::{Component, CoordinateKind};
use crate::planned::branch::certainty_of;
use crate::planned::limit::blurred_sign;

/// Nearer than this to where its branches meet a group is on neither of them: as near as rounding lets it be told.
const SMALLEST: f64 = 1e-6;

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
pub(super) fn stay(before: &[f64], predicted: &[f64], found: &[f64], is_redundant: bool) -> bool {
    before.iter().zip(predicted).zip(found).all(|((before, predicted), found)| {
        let sign = if is_redundant { predicted.signum() } else { before.signum() };
        sign * found > SMALLEST && certainty_of(sign * found, sign * predicted) >= 0.0
    })
}

/// True where rates mean nothing, beside a crossing of branches.
pub(super) fn are_blurred(equations: &Equations<'_>, groups: &[f64], q_dot: &[f64], q_ddot: &[f64]) -> bool {
    let distances: Vec<f64> = groups.iter().map(|w| w.abs()).collect();
    let counts = |k: usize| {
        let kind = equations.model.coordinates[k].kind;
        !matches!(kind, CoordinateKind::Pose { component: Component::X | Component::Y, .. })
    };
    blurred_sign(distances.len(), &distances, [q_dot, q_ddot], counts).is_some()
}

/// How near the nearest group is to where its branches meet.
pub(super) fn nearest(groups: &[f64]) -> f64 {
    groups.iter().fold(1.0, |least, w| f64::min(least, w.abs()))
}
