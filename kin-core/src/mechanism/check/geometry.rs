//! Rules on geometry that can be seen without numbers.

use super::scope::scopes;
use crate::error::{ModelError, Origin};
use crate::mechanism::{BodyRef, Formula, Joint, JointKind, Mechanism, Range};

/// The two bodies of a joint, and the place of the second.
fn bodies(kind: &JointKind) -> Option<(BodyRef, BodyRef, Origin)> {
    match kind {
        JointKind::Revolute { p, q }
        | JointKind::Translational { p, q, .. }
        | JointKind::Fixed { p, q, .. }
        | JointKind::PointOnLine { p, q, .. }
        | JointKind::Distance { p, q, .. }
        | JointKind::OnCurve { p, q, .. }
        | JointKind::FlatFollower { p, q, .. }
        | JointKind::RackPinion { p, q, .. }
        | JointKind::RollingOnLine { p, q, .. }
        | JointKind::RollingOnDisc { p, q, .. } => Some((p.body, q.body, q.origin)),
        JointKind::RelativeAngle { a, b, .. } | JointKind::Gear { a, b, .. } | JointKind::Belt { a, b, .. } => {
            Some((*a, *b, b.origin()))
        }
        JointKind::Coordinate { .. }
        | JointKind::Angle { .. }
        | JointKind::Constraint { .. }
        | JointKind::KnifeEdge { .. }
        | JointKind::Speed { .. }
        | JointKind::Nonholonomic { .. }
        | JointKind::Driver { .. } => None,
    }
}

/// True for a joint of the ground with itself.
pub(super) fn is_within_ground(joint: &Joint) -> bool {
    bodies(&joint.kind).is_some_and(|(a, b, _)| a.is_ground() && b.is_ground())
}

/// A joint joins two bodies, at every step of its range.
pub(super) fn joints_join_two_bodies(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for joint in &mechanism.joints {
        let Some((a, b, origin)) = bodies(&joint.kind) else { continue };
        let (keyword, name) = (joint.kind.keyword(), &joint.name);
        if let Some(body) = common_member(mechanism, joint, a, b) {
            let message =
                format!("{keyword} `{name}` joins `{body}` with itself; its operands belong to two different bodies");
            errors.push(ModelError::new(origin, message));
        }
    }
}

/// The body that two references of a joint both mean at some step of its range, by name.
pub(super) fn common_member(mechanism: &Mechanism, joint: &Joint, a: BodyRef, b: BodyRef) -> Option<String> {
    match (a, b) {
        (BodyRef::Ground(_), BodyRef::Ground(_)) => Some("ground".to_owned()),
        (BodyRef::Body { family, index, .. }, BodyRef::Body { family: other, index: with, .. }) if family == other => {
            let range = joint.range.unwrap_or(Range { start: 0, end: 1 });
            let body = mechanism.bodies.get(family)?;
            let met = range.indices().find_map(|i| index.at(i).filter(|k| with.at(i) == Some(*k)));
            met.map(|k| if body.len.is_some() { format!("{}[{k}]", body.name) } else { body.name.clone() })
        }
        _ => None,
    }
}

/// The axis of a joint points somewhere.
pub(super) fn axes_have_a_direction(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for joint in &mechanism.joints {
        let (JointKind::Translational { axis, .. }
        | JointKind::PointOnLine { axis, .. }
        | JointKind::FlatFollower { axis, .. }
        | JointKind::RackPinion { axis, .. }
        | JointKind::RollingOnLine { axis, .. }) = &joint.kind
        else {
            continue;
        };
        if axis.x.literal() == Some(0.0) && axis.y.literal() == Some(0.0) {
            let message = "an axis (0, 0) has no direction; kin normalises it, so that any other length will do";
            errors.push(ModelError::new(axis.origin, message));
        }
    }
}

/// A distance is positive: at 0 its row has no gradient.
pub(super) fn lengths_are_positive(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for joint in &mechanism.joints {
        let JointKind::Distance { length, length_origin, .. } = &joint.kind else { continue };
        match length.literal() {
            Some(0.0) => {
                let message = "a length of 0 has no gradient; points that coincide are joined with `revolute`";
                errors.push(ModelError::new(*length_origin, message));
            }
            Some(value) if value < 0.0 => {
                errors.push(ModelError::new(*length_origin, format!("a length is positive; this one is {value}")));
            }
            _ => {}
        }
    }
}

/// Nothing is divided by a literal 0.
pub(super) fn divisors_are_not_zero(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for scope in scopes(mechanism) {
        for node in scope.nodes() {
            match node {
                Formula::Div(_, divisor, origin) if divisor.literal() == Some(0.0) => {
                    errors.push(ModelError::new(*origin, "this divides by 0; a divisor is never a literal 0"));
                }
                _ => {}
            }
        }
    }
}
