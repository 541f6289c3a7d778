//! Degenerate contacts with curves: points at which a curve has no angle, gradient or tangent. The errors name the
//! joint and the degeneracy.
//!
//! - A polar curve at w = 0: θ = atan2(w_y, w_x) has no value.
//! - An implicit curve where ∇e = 0 on the curve, a double point or a cusp: its row of Φ_q vanishes.
//! - A parametric curve under a roller where c′ = 0: the side of the curve on which the roller runs is undefined.

use crate::equations::Equations;
use crate::equations::placement::Placement;
use crate::equations::scale::Scale;
use crate::error::{Degeneracy, SolveError};
use crate::model::{CoordinateKind, JointInfo, JointKind, Role};
use crate::signal::Instant;
use crate::workspace::Subset;

/// Lengths below this count as zero, since their squares underflow.
const NOTHING: f64 = 1e-150;
/// Distance from the centre of a polar curve, relative to the typical length, below which its direction is dominated by
/// rounding.
const AT_CENTRE: f64 = 1e-12;
/// Number of places in one step at which the direction of a curve under a roller is compared with the one before.
const SAMPLES: u32 = 4;
/// Cosine of the largest turn of the curve between two such places.
const COS_MAX_TURN: f64 = 0.87;

/// Replaces the error of an evaluation at q by an error that names the degenerate contact, if there is one.
pub(crate) fn explain(equations: &mut Equations<'_>, q: &[f64], error: SolveError) -> SolveError {
    let SolveError::NonFinite { what: "Φ" | "Φ_q" | "Φ_t" | "γ", index: row, .. } = error else { return error };
    let Some(joint) = equations.model.rows.get(row).map(|row| row.joint) else { return error };
    let info = &equations.model.joints[joint];
    let fault = match info.kind {
        JointKind::OnPolarCurve => at_centre(equations, info, q),
        JointKind::OnParametricCurve => without_direction(equations, joint, q),
        _ => None,
    };
    fault.map_or(error, |fault| degenerate(equations, row, fault))
}

/// True if the contact with all curves is defined at q, and no roller has changed its side since `before`.
pub(crate) fn is_regular(equations: &mut Equations<'_>, before: Option<&[f64]>, q: &[f64]) -> Result<bool, SolveError> {
    if !equations.scale.is_known {
        equations.scale = Scale::around(equations, q);
    }
    if let Some(before) = before
        && turned_about(equations, before, q).is_some()
    {
        return Ok(false);
    }
    equations.evaluate(Subset::VELOCITY, q, None)?;
    let tolerance = equations.options.rank_tolerance;
    Ok(at_a_standstill(equations, q).is_none()
        && without_angle(equations, q).is_none()
        && without_gradient(equations, tolerance).is_none())
}

/// The first polar curve whose point is at its centre at q, within rounding.
pub(crate) fn without_angle(equations: &mut Equations<'_>, q: &[f64]) -> Option<SolveError> {
    let joints = equations.model.joints;
    let mut polar = joints.iter().filter(|joint| joint.kind == JointKind::OnPolarCurve);
    polar.find_map(|joint| at_centre(equations, joint, q).map(|fault| degenerate(equations, joint.first_row, fault)))
}

/// The first implicit curve whose row of Φ_q, evaluated last, has no entry above `tolerance` on the common scale.
pub(crate) fn without_gradient(equations: &Equations<'_>, tolerance: f64) -> Option<SolveError> {
    (equations.rows_of_implicit_curves())
        .map(|row| (row, equations.largest_scaled(row)))
        .find(|(_, largest)| *largest <= tolerance)
        .map(|(row, largest)| degenerate(equations, row, Degeneracy::Gradient { largest }))
}

fn degenerate(equations: &Equations<'_>, row: usize, fault: Degeneracy) -> SolveError {
    let (row_name, joint) = (equations.row_name(row), equations.joint_name(row));
    SolveError::DegenerateContact { t: equations.t, joint, row_name, what: fault }
}

/// The degeneracy if point Q is at the centre P of the curve.
fn at_centre(equations: &mut Equations<'_>, joint: &JointInfo, q: &[f64]) -> Option<Degeneracy> {
    let nothing = (AT_CENTRE * equations.scale.length).max(NOTHING);
    let placement = Placement::at(equations, q).ok()?;
    let place = |role: Role| placement.point(joint.geometry.iter().find(|geometry| geometry.role == role)?);
    let ([px, py], [qx, qy]) = (place(Role::P)?, place(Role::Q)?);
    let distance = (qx - px).hypot(qy - py);
    (distance <= nothing).then_some(Degeneracy::Centre { distance })
}

/// The first roller on a curve with c′ = 0 at q, on the common scale.
pub(crate) fn at_a_standstill(equations: &Equations<'_>, q: &[f64]) -> Option<SolveError> {
    rollers(equations).find_map(|(index, joint)| {
        let (column, _, speed) = speed(equations, index, q)?;
        let length = equations.scale.length;
        let still = speed * equations.scale.columns[column] <= equations.options.rank_tolerance * length;
        let fault = Degeneracy::Direction { parameter: equations.model.coordinates[column].name, value: q[column] };
        still.then(|| degenerate(equations, joint.first_row, fault))
    })
}

/// The first row of a roller whose curve turns so far between two configurations that the roller may have changed its
/// side: at a cusp the normal reverses its direction, and the roller with it, although Φ = 0 holds on both sides.
pub(crate) fn turned_about(equations: &Equations<'_>, from: &[f64], to: &[f64]) -> Option<usize> {
    rollers(equations).find_map(|(index, joint)| {
        let column = parameter(equations, joint)?;
        let direction = |k: u32| {
            let value = from[column] + f64::from(k) / f64::from(SAMPLES) * (to[column] - from[column]);
            let [x, y] = tangent(equations, index, value)?;
            let speed = x.hypot(y);
            Some([x / speed, y / speed])
        };
        let mut before = direction(0)?;
        for k in 1..=SAMPLES {
            let after = direction(k)?;
            let cosine = before[0] * after[0] + before[1] * after[1];
            if cosine.is_nan() || cosine < COS_MAX_TURN {
                return Some(joint.first_row);
            }
            before = after;
        }
        None
    })
}

/// The parametric curves under a roller, with the indices of their joints.
fn rollers<'e>(equations: &'e Equations<'_>) -> impl Iterator<Item = (usize, &'static JointInfo)> + use<'e> {
    equations.model.joints.iter().enumerate().filter(|(_, joint)| {
        joint.kind == JointKind::OnParametricCurve && joint.geometry.iter().any(|g| g.role == Role::Radius)
    })
}

/// The degeneracy if c′ = 0 at the current value of the parameter.
fn without_direction(equations: &Equations<'_>, joint: usize, q: &[f64]) -> Option<Degeneracy> {
    let (column, value, speed) = speed(equations, joint, q)?;
    (speed < NOTHING).then_some(Degeneracy::Direction { parameter: equations.model.coordinates[column].name, value })
}

/// Index in q and value of the parameter of a joint's curve, and |c′| there.
fn speed(equations: &Equations<'_>, joint: usize, q: &[f64]) -> Option<(usize, f64, f64)> {
    let column = parameter(equations, &equations.model.joints[joint])?;
    let [x, y] = tangent(equations, joint, q[column])?;
    Some((column, q[column], x.hypot(y)))
}

/// Index in q of the parameter of a curve.
fn parameter(equations: &Equations<'_>, joint: &JointInfo) -> Option<usize> {
    let rows = joint.first_row..joint.first_row + joint.rows;
    let is_scalar = |column: usize| equations.model.coordinates[column].kind == CoordinateKind::Scalar;
    let entries = equations.model.constraint_pattern.entries.iter();
    entries.filter(|entry| rows.contains(&entry.0)).map(|entry| entry.1).find(|k| is_scalar(*k))
}

/// c′ at a value of the parameter.
fn tangent(equations: &Equations<'_>, joint: usize, value: f64) -> Option<[f64; 2]> {
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    Some(equations.system.curve(&at, joint, value)?.tangent)
}
