//! Radii that are degenerate at the values of the parameters: a gear or a disc of radius 0 couples nothing, and discs
//! that roll on one another with a common centre have no line of centres. A roller may have radius 0: it is then a
//! point that follows the curve.

use crate::equations::Equations;
use crate::error::{Degeneracy, SolveError};
use crate::model::{JointKind, Role};
use crate::signal::Instant;

/// The error of the first joint with a degenerate radius.
pub(crate) fn degenerate(equations: &Equations<'_>) -> Option<SolveError> {
    let joints = equations.model.joints;
    if !joints.iter().flat_map(|joint| joint.geometry).any(|geometry| geometry.role == Role::Radius) {
        return None;
    }
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let numbers = equations.system.geometry(&at).ok()?;
    let mut coupled = joints.iter().filter(|joint| joint.kind != JointKind::OnParametricCurve);
    coupled.find_map(|joint| {
        let places = joint.geometry.iter().filter(|geometry| geometry.role == Role::Radius);
        let radii: Vec<f64> = places.filter_map(|geometry| numbers.get(geometry.offset).copied()).collect();
        let sum: f64 = radii.iter().sum();
        let fault = match joint.kind {
            _ if radii.contains(&0.0) => Degeneracy::Radius { value: 0.0 },
            JointKind::RollingOnDisc if sum == 0.0 => Degeneracy::OneCentre { sum },
            _ => return None,
        };
        let row_name = equations.row_name(joint.first_row);
        Some(SolveError::DegenerateContact { t: equations.t, joint: joint.name, row_name, what: fault })
    })
}
