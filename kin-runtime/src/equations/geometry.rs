//! Geometry that is degenerate at the values of the parameters. The errors name the joint.
//!
//! A kept distance of 0 has no gradient; its row of Φ_q is zero. Degenerate radii and axes are in
//! [`dimensions`](super::dimensions).

use crate::equations::Equations;
use crate::error::{Degeneracy, SolveError};
use crate::model::{Geometry, JointInfo, Role};
use crate::signal::Instant;

/// Replaces the error of an evaluation by an error that names the joint whose axis has no direction, if that is the
/// cause.
pub(crate) fn explain(equations: &mut Equations<'_>, error: SolveError) -> SolveError {
    let SolveError::NonFinite { what: "Φ" | "Φ_q" | "Φ_t" | "γ", index: row, .. } = error else { return error };
    let Some(joint) = equations.model.rows.get(row).map(|row| &equations.model.joints[row.joint]) else { return error };
    match numbers(equations, joint, Role::Axis) {
        Some([x, y]) if !(x.is_finite() && y.is_finite()) => {
            SolveError::DegenerateGeometry { t: equations.t, joint: joint.name, fault: Degeneracy::Axis }
        }
        _ => error,
    }
}

/// An error if the geometry of a joint is not a number, as the root of a negative difference of dimensions. No configuration
/// satisfies its rows then, which is no statement about the mechanism.
pub(crate) fn check(equations: &Equations<'_>) -> Result<(), SolveError> {
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let all = equations.system.geometry(&at)?;
    let is_known = |geometry: &Geometry| {
        let is_vector = matches!(geometry.role, Role::P | Role::Q | Role::Axis);
        all.iter().skip(geometry.offset).take(1 + usize::from(is_vector)).all(|number| number.is_finite())
    };
    let Some(joint) = equations.model.joints.iter().find(|joint| !joint.geometry.iter().all(is_known)) else {
        return Ok(());
    };
    let (index, t) = (joint.first_row, Some(equations.t));
    Err(SolveError::NonFinite { what: "Φ", index, name: equations.row_name(index), t })
}

/// The first joint that keeps a distance of zero, on the common scale.
pub(crate) fn without_length(equations: &mut Equations<'_>) -> Option<SolveError> {
    let tolerance = equations.options.rank_tolerance * equations.scale.length;
    let joints: Vec<&JointInfo> = equations.model.joints.iter().filter(|joint| joint.keeps_distance()).collect();
    joints.into_iter().find_map(|joint| {
        let [length] = numbers(equations, joint, Role::Value)?;
        let fault = Degeneracy::Length { length };
        (length.abs() <= tolerance).then_some(SolveError::DegenerateGeometry {
            t: equations.t,
            joint: joint.name,
            fault,
        })
    })
}

/// The numbers that describe one geometric operand of a joint.
fn numbers<const N: usize>(equations: &mut Equations<'_>, joint: &JointInfo, role: Role) -> Option<[f64; N]> {
    let geometry = joint.geometry.iter().find(|geometry| geometry.role == role)?;
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let all = equations.system.geometry(&at).ok()?;
    all.get(geometry.offset..geometry.offset + N)?.try_into().ok()
}
