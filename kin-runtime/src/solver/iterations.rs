//! Whether the iterations of the plan found the solution on the same branch as their start.
//!
//! Newton's iteration from a distant start may converge to any solution: to the roller on the other side of its cam, or
//! to a point of a curve after dozens of revolutions. A solution is accepted if the orientation of the group, the sign
//! of the determinant of its block of Φ_q, is the same at the start as at the solution, and if its angles are within half
//! a turn of their start. If the group contains a scalar, such as the parameter of a curve, all its unknowns must also be
//! near their start. Otherwise the general path, whose steps are shorter, decides.

use super::Solver;
use crate::mechanism::Mechanism;
use crate::model::{Component, CoordinateKind, Model};
use crate::plan::StepKind;
use crate::planned::lists::BranchValues;
use crate::signal::Instant;
use crate::workspace::Array;
use core::f64::consts::PI;

/// The distance from its start, relative to its size, up to which a coordinate is near it.
const NEAR_START: f64 = 0.25;

impl<M: Mechanism> Solver<'_, M> {
    /// True if no iteration of the plan left the surroundings of `start` on its way to the solution q. Of the coordinates
    /// that a group places, those with a guess, or all of a complete start, count together with its unknowns.
    pub(super) fn stays_near(
        &self,
        parameters: &M::Parameters<f64>,
        at: &Instant<'_>,
        (start, is_complete): (&[f64], bool),
        q: &[f64],
    ) -> bool {
        let model = M::model();
        if !model.plan.iterates() {
            return true;
        }
        let Some(mut begun) = M::Coordinates::<f64>::view(q).copied() else { return false };
        let guesses = &self.settings.guesses;
        let is_given = |k: usize| is_complete || model.guesses.contains(&k) || guesses.iter().any(|guess| guess.0 == k);
        if !begins_near(model, (start, &is_given), q, begun.as_mut()) {
            return false;
        }
        let branch_values_at = |q: &[f64]| BranchValues::<M>::at(self.mechanism, parameters.as_ref(), at, q);
        let (Ok(first), Ok(last)) = (branch_values_at(begun.as_ref()), branch_values_at(q)) else { return false };
        let closures = model.plan.modes.len();
        first.as_ref().iter().zip(last.as_ref()).skip(closures).all(have_same_sign)
    }
}

/// Whether two branch values have the same sign.
fn have_same_sign((first, last): (&f64, &f64)) -> bool {
    first * last > 0.0
}

/// Writes the unknowns of all iterations at their start, and what is given of the coordinates that follow from them; false
/// if an angle is more than half a turn away from its start at the solution q, or if a group that contains a scalar begins
/// far from it.
fn begins_near(
    model: &Model,
    (start, is_given): (&[f64], &dyn Fn(usize) -> bool),
    q: &[f64],
    begun: &mut [f64],
) -> bool {
    for step in model.plan.steps {
        let StepKind::Newton(unknowns) = step.kind else { continue };
        let (unknowns, solved_later) = step.coordinates.split_at_checked(unknowns).unwrap_or_default();
        let has_scalar = unknowns.iter().any(|&(k, _)| model.coordinates[k].kind == CoordinateKind::Scalar);
        if has_scalar && !unknowns.iter().all(|&(k, _)| is_near(model.coordinates[k].kind, start[k], q[k])) {
            return false;
        }
        unknowns.iter().for_each(|&(k, _)| begun[k] = start[k]);
        solved_later.iter().filter(|(k, _)| is_given(*k)).for_each(|&(k, _)| begun[k] = start[k]);
    }
    model.iterated_angles().all(|k| (q[k] - start[k]).abs() <= PI)
}

/// True if a coordinate is near its start: a length relative to itself, an angle within a fraction of a radian, a
/// scalar, whose unit is unknown, within the larger of both.
fn is_near(kind: CoordinateKind, start: f64, found: f64) -> bool {
    let size = match kind {
        CoordinateKind::Pose { component: Component::Phi, .. } => 1.0,
        CoordinateKind::Pose { .. } => start.abs(),
        CoordinateKind::Scalar => start.abs().max(1.0),
    };
    (found - start).abs() <= NEAR_START * size
}
