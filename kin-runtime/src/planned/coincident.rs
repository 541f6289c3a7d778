//! Points that coincide although their distance is in a row, as neighbouring points of a rope.
//!
//! The distance has no direction there, so that its row has no gradient, and a motion ends.

use super::error::PlanError;
use super::follower::PlanFollower;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::signal::Instant;
use crate::workspace::Array;

/// The distance below which points coincide, relative to the largest coordinate that is no angle.
const COINCIDENT: f64 = 1e-5;

/// The first row in which points coincide at a configuration, given the sum of 1/d² over the distances d in every row.
pub(crate) fn row_with_coincident_points(model: &Model, closeness: &[f64], q: &[f64]) -> Option<usize> {
    // An angle counts the turns of its body, which say nothing of distances.
    let lengths = model.coordinates.iter().zip(q).filter(|(coordinate, _)| !coordinate.kind.is_angle());
    nearer_than(COINCIDENT * lengths.fold(0.0, |most: f64, (_, q)| most.max(q.abs())), closeness)
}

/// The first row with a distance that is not certainly larger than `nearest`.
fn nearer_than(nearest: f64, closeness: &[f64]) -> Option<usize> {
    // The comparison is written so that NaN counts as a distance of 0.
    let are_apart = |sum: &f64| sum * nearest * nearest < 1.0;
    closeness.iter().position(|sum| !are_apart(sum))
}

impl<M: Mechanism> PlanFollower<M> {
    /// The error for a configuration at which a motion ends because two points coincide.
    #[cold]
    #[inline(never)]
    pub(super) fn coincident_points(&self, mechanism: &M, at: &Instant<'_>, q: &[f64]) -> Option<PlanError> {
        if !M::DISTANCES_IN_ROWS {
            return None;
        }
        let mut closeness = M::Rows::<f64>::filled(0.0);
        mechanism.closeness_with(self.parameters.as_ref(), at, q, closeness.as_mut()).ok()?;
        let row = row_with_coincident_points(M::model(), closeness.as_ref(), q)?;
        Some(PlanError::coincident(M::model(), at.t, row))
    }
}

#[cfg(test)]
mod tests {
    use super::nearer_than;

    #[test]
    fn points_coincide_at_a_small_distance() {
        let at = |d: f64| 1.0 / (d * d);
        assert_eq!(None, nearer_than(2e-4, &[0.0, at(2.1e-4)]));
        assert_eq!(Some(1), nearer_than(2e-4, &[0.0, at(1.9e-4)]));
        for exact in [f64::INFINITY, f64::NAN] {
            assert_eq!([Some(0); 2], [2e-4, 0.0].map(|nearest| nearer_than(nearest, &[exact, at(1.0)])));
        }
    }
}
