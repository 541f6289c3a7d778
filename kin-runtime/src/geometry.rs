//! Geometry that is degenerate at the values of the parameters: reported by the name of the joint.
//!
//! - An axis whose components are both 0, or so small or large that their squares are no numbers, cannot be normalised.
//! - A distance of 0 has no gradient where it is kept; its row of Φ_q vanishes.
//! - A distance below 0 does not exist. Its row holds the square, and would quietly keep the positive distance instead.

use crate::equations::Equations;
use crate::error::{GeometryFault, SolveError};
use crate::model::{JointInfo, Model, Role};
use crate::workspace::Instant;

/// The error of an evaluation, by the name of the joint whose axis has no direction, if that is why.
pub(crate) fn explain(equations: &mut Equations<'_>, error: SolveError) -> SolveError {
    let SolveError::NonFinite { what: "Φ" | "Φ_q" | "Φ_t" | "γ", index: row, .. } = error else { return error };
    let Some(joint) = equations.model.rows.get(row).map(|row| &equations.model.joints[row.joint]) else { return error };
    match numbers(equations, joint, Role::Axis) {
        Some([x, y]) if !(x.is_finite() && y.is_finite()) => {
            SolveError::DegenerateGeometry { t: equations.t, joint: joint.name, fault: GeometryFault::Axis }
        }
        _ => error,
    }
}

/// Deviation of a unit vector's length from one that is more than rounding.
const UNIT: f64 = 1e-9;

/// The first joint whose axis is no unit vector, at the current instant.
pub(crate) fn without_direction(equations: &Equations<'_>) -> Option<SolveError> {
    let joints = equations.model.joints;
    if !joints.iter().flat_map(|joint| joint.geometry).any(|geometry| geometry.role == Role::Axis) {
        return None;
    }
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let all = equations.system.geometry(&at).ok()?;
    joints.iter().find_map(|joint| {
        let mut axes = joint.geometry.iter().filter(|geometry| geometry.role == Role::Axis);
        let is_unit = |offset: usize| match all.get(offset..offset + 2) {
            Some(&[x, y]) => (x.hypot(y) - 1.0).abs() <= UNIT,
            _ => true,
        };
        let (t, joint, fault) = (equations.t, joint.name, GeometryFault::Axis);
        axes.any(|axis| !is_unit(axis.offset)).then_some(SolveError::DegenerateGeometry { t, joint, fault })
    })
}

/// A distance that a joint keeps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeptLength {
    joint: &'static str,
    /// Its place in the geometry.
    offset: usize,
    /// True when t or an input may change it.
    pub(crate) moves: bool,
}

/// All distances that the joints of a model keep.
pub(crate) fn kept_lengths(model: &'static Model) -> Vec<KeptLength> {
    let kept = |joint: &'static JointInfo| {
        let value = joint.geometry.iter().find(|geometry| geometry.role == Role::Value)?;
        let moves = model.rows.get(joint.first_row).is_some_and(|row| row.rheonomic);
        Some(KeptLength { joint: joint.name, offset: value.offset, moves })
    };
    model.joints.iter().filter(|joint| joint.keeps_distance()).filter_map(kept).collect()
}

/// The error if one of these lengths is negative, given the numbers of the geometry at an instant.
pub(crate) fn lengths_exist<'k>(
    numbers: &[f64],
    lengths: impl IntoIterator<Item = &'k KeptLength>,
    t: f64,
) -> Result<(), SolveError> {
    let negative = lengths.into_iter().find_map(|kept| {
        let length = numbers.get(kept.offset).copied().filter(|&length| length < 0.0)?;
        let fault = GeometryFault::NegativeLength { length };
        Some(SolveError::DegenerateGeometry { t, joint: kept.joint, fault })
    });
    negative.map_or(Ok(()), Err)
}

/// The first joint that keeps a distance of nothing, on the common scale.
pub(crate) fn without_length(equations: &mut Equations<'_>) -> Option<SolveError> {
    let tolerance = equations.options.rank_tolerance * equations.scale.length;
    let joints: Vec<&JointInfo> = equations.model.joints.iter().filter(|joint| joint.keeps_distance()).collect();
    joints.into_iter().find_map(|joint| {
        let [length] = numbers(equations, joint, Role::Value)?;
        let fault = GeometryFault::Length { length };
        (length.abs() <= tolerance).then_some(SolveError::DegenerateGeometry {
            t: equations.t,
            joint: joint.name,
            fault,
        })
    })
}

/// The numbers of a piece of a joint's geometry.
fn numbers<const N: usize>(equations: &mut Equations<'_>, joint: &JointInfo, role: Role) -> Option<[f64; N]> {
    let geometry = joint.geometry.iter().find(|geometry| geometry.role == role)?;
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let all = equations.system.geometry(&at).ok()?;
    all.get(geometry.offset..geometry.offset + N)?.try_into().ok()
}
