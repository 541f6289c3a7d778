//! Dimensions of joints that are degenerate at the values of the parameters.
//!
//! - A gear or a disc of radius 0 couples nothing. A roller may have radius 0: it is then a point that follows the curve.
//! - Discs that roll on one another with a common centre have no line of centres.
//! - An axis cannot be normalised if both components are 0, or if their squares underflow or overflow.

use super::Equations;
use crate::error::{Degeneracy, SolveError};
use crate::model::{JointInfo, JointKind, Model, Role};
use crate::signal::Instant;

/// Deviation of the square of a unit vector's length from 1 that exceeds rounding.
const UNIT: f64 = 1e-9;

/// The first joint with a degenerate dimension; `numbers` is the geometry at an instant.
pub(crate) fn first_degenerate(model: &'static Model, numbers: &[f64]) -> Option<(&'static JointInfo, Degeneracy)> {
    model
        .joints
        .iter()
        .find_map(|joint| Some((joint, degenerate_radius(joint, numbers).or_else(|| degenerate_axis(joint, numbers))?)))
}

fn degenerate_radius(joint: &JointInfo, numbers: &[f64]) -> Option<Degeneracy> {
    if joint.kind == JointKind::OnParametricCurve {
        return None;
    }
    let of_radii = joint.geometry.iter().filter(|geometry| geometry.role == Role::Radius);
    let mut radii = of_radii.filter_map(|geometry| numbers.get(geometry.offset));
    let sum: f64 = radii.clone().sum();
    match joint.kind {
        _ if radii.any(|radius| *radius == 0.0) => Some(Degeneracy::Radius { value: 0.0 }),
        JointKind::RollingOnDisc if sum == 0.0 => Some(Degeneracy::OneCentre { sum }),
        _ => None,
    }
}

fn degenerate_axis(joint: &JointInfo, numbers: &[f64]) -> Option<Degeneracy> {
    let mut axes = joint.geometry.iter().filter(|geometry| geometry.role == Role::Axis);
    let is_unit = |offset: usize| match numbers.get(offset..offset + 2) {
        Some(&[x, y]) => (x * x + y * y - 1.0).abs() <= UNIT,
        _ => true,
    };
    axes.any(|axis| !is_unit(axis.offset)).then_some(Degeneracy::Axis)
}

/// An error if a dimension of a joint is degenerate at the current instant.
pub(super) fn check(equations: &Equations<'_>) -> Result<(), SolveError> {
    let mut geometry = equations.model.joints.iter().flat_map(|joint| joint.geometry);
    if !geometry.any(|geometry| matches!(geometry.role, Role::Radius | Role::Axis)) {
        return Ok(());
    }
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let Some((joint, fault)) = first_degenerate(equations.model, &equations.system.geometry(&at)?) else {
        return Ok(());
    };
    let (t, name) = (equations.t, joint.name);
    Err(match fault {
        Degeneracy::Axis => SolveError::DegenerateGeometry { t, joint: name, fault },
        what => {
            let row_name = equations.row_name(joint.first_row);
            SolveError::DegenerateContact { t, joint: name, row_name, what }
        }
    })
}
