//! How fast the gradients of rows turn, and rounding errors that dominate a solution for that reason.

use super::Equations;
use crate::error::{Degeneracy, SolveError};
use crate::planned::coincident::row_with_coincident_points;
use crate::planned::steep_rows::first_steep;
use crate::signal::Instant;

impl Equations<'_> {
    /// How far the gradients of rows turn with each coordinate at a configuration, in radians per unit; empty if there is
    /// no plan, or if coordinates are prescribed.
    pub(crate) fn turns(&self, at: &Instant<'_>, q: &[f64]) -> Vec<f64> {
        if self.given() > 0 || !self.model.plan.exists() {
            return Vec::new();
        }
        let mut turns = vec![0.0; q.len()];
        if self.system.turns(at, q, &mut turns).is_err() {
            turns.clear();
        }
        turns
    }

    /// An error if rounding errors dominate a coordinate in a solution q, q̇, q̈ of the current instant. Where the plan
    /// divides by 0 it cannot tell.
    pub(crate) fn check_slopes(&self, solution: [&[f64]; 3]) -> Result<(), SolveError> {
        let has_distances = self.system.distances_in_rows();
        if !self.model.plan.iterates() && !has_distances {
            return Ok(());
        }
        let turns = self.turns(&self.instant(), solution[0]);
        let is_known = !turns.is_empty() && turns.iter().all(|turn| turn.is_finite());
        let found = if is_known { first_steep(self.model, has_distances, &turns, solution) } else { None };
        let Some(k) = found else { return Ok(()) };
        Err(match self.row_with_coincident_points(solution[0]) {
            Some(row) => {
                let (t, joint) = (self.t, self.joint_name(row));
                SolveError::DegenerateGeometry { t, joint, fault: Degeneracy::Coincident }
            }
            None => SolveError::Rounded { t: self.t, coordinate: self.model.coordinates[k].name },
        })
    }

    /// The first row in which two points coincide at a configuration of the current instant.
    pub(crate) fn row_with_coincident_points(&self, q: &[f64]) -> Option<usize> {
        if !self.system.distances_in_rows() {
            return None;
        }
        let mut closeness = vec![0.0; self.model.rows.len()];
        self.system.closeness(&self.instant(), q, &mut closeness).ok()?;
        row_with_coincident_points(self.model, &closeness, q)
    }
}
