//! Rules for geometry that depend on literal numbers only.

use super::scope::scopes;
use crate::error::ModelError;
use crate::mechanism::{BodyRef, Formula, Mechanism, Operand, OperandSlot, OperandType, Statement};

/// True if the joint connects the ground with itself.
pub(super) fn is_within_ground(joint: &Statement) -> bool {
    joint.operands.joined().is_some_and(|bodies| bodies.iter().all(BodyRef::is_ground))
}

/// Rule: a joint connects two different bodies, for every index of its range.
pub(super) fn joints_join_two_bodies(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for joint in &mechanism.joints {
        let Some([a, b]) = joint.operands.joined() else { continue };
        let (keyword, name) = (joint.operands.keyword(), &joint.name);
        if let Some(body) = mechanism.common_member(joint.range, a, b) {
            let message =
                format!("{keyword} `{name}` joins `{body}` with itself; its operands belong to two different bodies");
            errors.push(ModelError::new(b.origin(), message));
        }
    }
}

/// Rule: the axis of a joint has a direction.
pub(super) fn axes_have_a_direction(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for (_, operand) in operands(mechanism) {
        let Operand::Axis(axis) = operand else { continue };
        if axis.x.literal() == Some(0.0) && axis.y.literal() == Some(0.0) {
            let message = "an axis (0, 0) has no direction; kin normalises it, so that any other length will do";
            errors.push(ModelError::new(axis.origin, message));
        }
    }
}

/// Rule: a distance is positive, because a row with the distance 0 has no gradient.
pub(super) fn lengths_are_positive(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for (slot, operand) in operands(mechanism) {
        let (true, Operand::Value(length)) = (slot.positive, operand) else { continue };
        match length.value.literal() {
            Some(0.0) => {
                let message = "a length of 0 has no gradient; points that coincide are joined with `revolute`";
                errors.push(ModelError::new(length.origin, message));
            }
            Some(value) if value < 0.0 => {
                errors.push(ModelError::new(length.origin, format!("a length must be positive; this one is {value}")));
            }
            _ => {}
        }
    }
}

/// Rule: a radius is not a literal 0. A radius that is 0 for a member of a family, or after constant folding, is
/// reported when the rows are written.
pub(super) fn radii_are_not_zero(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for (slot, operand) in operands(mechanism) {
        let radii = match operand {
            Operand::Radii(radii) => vec![&radii.i, &radii.j],
            Operand::Value(radius) if slot.takes == OperandType::Radius => vec![radius],
            _ => continue,
        };
        for radius in radii.into_iter().filter(|radius| radius.value.literal() == Some(0.0)) {
            let message =
                "a radius must not be 0: positive, or negative for a disc or gear that the other runs inside of";
            errors.push(ModelError::new(radius.origin, message));
        }
    }
}

/// The operands of all joints.
fn operands(mechanism: &Mechanism) -> impl Iterator<Item = (&'static OperandSlot, &Operand)> {
    mechanism.joints.iter().flat_map(|joint| joint.operands.iter())
}

/// Rule: no divisor is a literal 0.
pub(super) fn divisors_are_not_zero(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for scope in scopes(mechanism) {
        for node in scope.nodes() {
            match node {
                Formula::Div(_, divisor, origin) if divisor.literal() == Some(0.0) => {
                    errors.push(ModelError::new(*origin, "this divides by 0"));
                }
                _ => {}
            }
        }
    }
}
