//! The distances that joints keep must not be negative: their rows contain the square of the distance, and would
//! silently keep the positive distance instead.

use crate::error::{Degeneracy, SolveError};
use crate::model::{JointInfo, Model, Role};

/// A distance that a joint keeps.
#[derive(Clone, Copy, Debug)]
pub(super) struct KeptLength {
    joint: &'static str,
    /// Index of its row.
    pub(super) row: usize,
    /// Index of the distance in the list of geometry.
    pub(super) offset: usize,
    /// True if the row is d² − e², with the distance d of two points and its prescribed value e.
    pub(super) is_squared: bool,
    /// True when t or an input may change the distance.
    pub(super) moves: bool,
}

/// All distances that the joints of a model keep.
pub(super) fn kept_lengths(model: &'static Model) -> Vec<KeptLength> {
    let length_of = |joint: &'static JointInfo| {
        let value = joint.geometry.iter().find(|geometry| geometry.role == Role::Value)?;
        let row = joint.first_row;
        let moves = model.rows.get(row).is_some_and(|row| row.rheonomic);
        // The row of a rope over several points contains the distances themselves.
        let is_squared = joint.geometry.iter().all(|geometry| geometry.role != Role::Via);
        Some(KeptLength { joint: joint.name, row, offset: value.offset, is_squared, moves })
    };
    model.joints.iter().filter(|joint| joint.keeps_distance()).filter_map(length_of).collect()
}

/// The error if one of the given lengths is negative. `numbers` is the geometry at an instant.
pub(super) fn lengths_exist<'k>(
    numbers: &[f64],
    lengths: impl IntoIterator<Item = &'k KeptLength>,
    t: f64,
) -> Result<(), SolveError> {
    let negative = lengths.into_iter().find_map(|length_info| {
        let length = numbers.get(length_info.offset).copied().filter(|&length| length < 0.0)?;
        let fault = Degeneracy::NegativeLength { length };
        Some(SolveError::DegenerateGeometry { t, joint: length_info.joint, fault })
    });
    negative.map_or(Ok(()), Err)
}
