//! Points that coincide although their distance is in a row, as neighbouring points of a rope.
//!
//! The distance has no direction there, so that its row has no gradient, and a motion ends.

use super::error::PlanError;
use super::follower::PlanFollower;
use crate::mechanism::Mechanism;
use crate::signal::Instant;
use crate::workspace::Array;

/// The distance below which points coincide, relative to the largest coordinate.
const COINCIDENT: f64 = 1e-5;

/// The first row in which points coincide at a configuration, given the sum of 1/d² over the distances d in every row.
pub(crate) fn row_with_coincident_points(closeness: &[f64], q: &[f64]) -> Option<usize> {
    let size = q.iter().fold(0.0, |most: f64, q| most.max(q.abs()));
    let nearest = COINCIDENT * size;
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
        let row = row_with_coincident_points(closeness.as_ref(), q)?;
        Some(PlanError::coincident(M::model(), at.t, row))
    }
}

#[cfg(test)]
mod tests {
    use super::row_with_coincident_points;

    #[test]
    fn points_coincide_at_a_distance_that_is_small_beside_the_coordinates() {
        let at = |d: f64| 1.0 / (d * d);
        let q = [1.0, -20.0, 3.0];
        assert_eq!(None, row_with_coincident_points(&[0.0, at(2.1e-4)], &q));
        assert_eq!(Some(1), row_with_coincident_points(&[0.0, at(1.9e-4)], &q));
        for exact in [f64::INFINITY, f64::NAN] {
            assert_eq!(Some(0), row_with_coincident_points(&[exact, at(1.0)], &q));
        }
    }
}
