//! Which rows of a joint have t or an input in their own operands.
//!
//! Such rows drive: a length, an angle, an offset or a right-hand side that moves prescribes a motion. A joint of a body
//! whose held coordinate moves contains t as well, but only through the pose of that body. It drives nothing; it is where
//! the mechanism is fastened to something that moves.

use crate::mechanism::check::contains_signal;
use crate::mechanism::{Formula, JointKind, Mechanism};
use core::ops::Range;

/// The rows of a joint, out of `rows`, whose own operands contain t or an input.
pub(super) fn moving_rows(mechanism: &Mechanism, kind: &JointKind, rows: usize) -> Range<usize> {
    if !operands(kind).into_iter().any(|formula| contains_signal(mechanism, formula)) {
        return 0..0;
    }
    match kind {
        // The angle of these joints, or the offset of what rolls, stands in the last row alone.
        JointKind::Translational { .. }
        | JointKind::Fixed { .. }
        | JointKind::RollingOnLine { .. }
        | JointKind::RollingOnDisc { .. } => rows.saturating_sub(1)..rows,
        _ => 0..rows,
    }
}

/// The formulas of a joint that may contain t and inputs: not those of points, axes and radii.
fn operands(kind: &JointKind) -> Vec<&Formula> {
    match kind {
        JointKind::Revolute { .. } => Vec::new(),
        JointKind::Translational { angle, .. }
        | JointKind::Fixed { angle, .. }
        | JointKind::KnifeEdge { angle, .. } => {
            vec![angle]
        }
        JointKind::PointOnLine { offset, .. }
        | JointKind::Gear { offset, .. }
        | JointKind::Belt { offset, .. }
        | JointKind::RackPinion { offset, .. }
        | JointKind::RollingOnLine { offset, .. }
        | JointKind::RollingOnDisc { offset, .. } => vec![offset],
        JointKind::Distance { length, .. } => vec![length],
        JointKind::Coordinate { value, .. }
        | JointKind::Angle { value, .. }
        | JointKind::RelativeAngle { value, .. } => vec![value],
        JointKind::OnCurve { curve, .. } => curve.formulas(),
        JointKind::FlatFollower { support, .. } => vec![support],
        JointKind::Speed { angle, value, .. } => vec![angle, value],
        JointKind::Constraint { left, right }
        | JointKind::Nonholonomic { left, right }
        | JointKind::Driver { left, right, .. } => vec![left, right],
    }
}
