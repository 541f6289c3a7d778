//! The distances that joints keep: one below 0 does not exist. Its row holds the square, and would quietly keep the positive
//! distance instead.

use crate::error::{Degeneracy, SolveError};
use crate::model::{JointInfo, Model, Role};

/// A distance that a joint keeps.
#[derive(Clone, Copy, Debug)]
pub(super) struct KeptLength {
    joint: &'static str,
    /// Its place in the geometry.
    offset: usize,
    /// True when t or an input may change it.
    pub(super) moves: bool,
}

/// All distances that the joints of a model keep.
pub(super) fn kept_lengths(model: &'static Model) -> Vec<KeptLength> {
    let kept = |joint: &'static JointInfo| {
        let value = joint.geometry.iter().find(|geometry| geometry.role == Role::Value)?;
        let moves = model.rows.get(joint.first_row).is_some_and(|row| row.rheonomic);
        Some(KeptLength { joint: joint.name, offset: value.offset, moves })
    };
    model.joints.iter().filter(|joint| joint.keeps_distance()).filter_map(kept).collect()
}

/// The error if one of these lengths is negative, given the numbers of the geometry at an instant.
pub(super) fn lengths_exist<'k>(
    numbers: &[f64],
    lengths: impl IntoIterator<Item = &'k KeptLength>,
    t: f64,
) -> Result<(), SolveError> {
    let negative = lengths.into_iter().find_map(|kept| {
        let length = numbers.get(kept.offset).copied().filter(|&length| length < 0.0)?;
        let fault = Degeneracy::NegativeLength { length };
        Some(SolveError::DegenerateGeometry { t, joint: kept.joint, fault })
    });
    negative.map_or(Ok(()), Err)
}
