//! Rules on discs, gears and what carries them.

use super::geometry::common_member;
use crate::error::{ModelError, Origin};
use crate::mechanism::{BodyRef, Joint, JointKind, Mechanism, Radius};

/// A radius is not a literal 0, and discs that roll on one another do not have one centre; assembly sees what comes to
/// that for a member of a family, and what is 0 only once numbers are folded.
pub(super) fn radii_have_a_size(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for joint in &mechanism.joints {
        for radius in radii(&joint.kind) {
            if radius.value.literal() == Some(0.0) {
                let message =
                    "a radius is not 0; it is positive, or negative for a disc or gear that the other runs inside of";
                errors.push(ModelError::new(radius.origin, message));
            }
        }
        let JointKind::RollingOnDisc { radii, .. } = &joint.kind else { continue };
        if let (Some(i), Some(j)) = (radii.i.value.literal(), radii.j.value.literal())
            && i != 0.0
            && i + j == 0.0
        {
            let message = format!("radii ({i}, {j}) put both discs on one centre, where nothing rolls");
            errors.push(ModelError::new(radii.origin, message));
        }
    }
}

fn radii(kind: &JointKind) -> Vec<&Radius> {
    match kind {
        JointKind::Gear { radii, .. } | JointKind::Belt { radii, .. } | JointKind::RollingOnDisc { radii, .. } => {
            vec![&radii.i, &radii.j]
        }
        JointKind::RackPinion { radius, .. } | JointKind::RollingOnLine { radius, .. } => vec![radius],
        _ => Vec::new(),
    }
}

/// The body that carries the axles of a gear pair is none of the two, at no step of the range; likewise the guide of
/// a rack and the pinion.
pub(super) fn carriers_carry(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for joint in &mechanism.joints {
        let found = match &joint.kind {
            JointKind::Gear { a, b, carrier, .. } | JointKind::Belt { a, b, carrier, .. } => {
                // Two gears on one body have their own message.
                let is_pair = common_member(mechanism, joint, *a, *b).is_none();
                [a, b].into_iter().filter(|_| is_pair).find_map(|gear| own_carrier(mechanism, joint, *gear, *carrier))
            }
            JointKind::RackPinion { p, pinion, .. } => common_member(mechanism, joint, p.body, *pinion).map(|body| {
                let name = &joint.name;
                let message = format!("`{body}` is the guide of rack_pinion `{name}`, against which the pinion turns");
                (pinion.origin(), message)
            }),
            _ => None,
        };
        errors.extend(found.map(|(origin, message)| ModelError::new(origin, message)));
    }
}

/// Where a gear is its own carrier, and what to say about it.
fn own_carrier(mechanism: &Mechanism, joint: &Joint, gear: BodyRef, carrier: BodyRef) -> Option<(Origin, String)> {
    let body = common_member(mechanism, joint, gear, carrier)?;
    let (keyword, name) = (joint.kind.keyword(), &joint.name);
    Some(if gear.is_ground() {
        let right = "a body that carries both axles is given with `carrier = …`";
        (gear.origin(), format!("{keyword} `{name}` turns against the ground and not with it; {right}"))
    } else {
        let right = "its carrier is a third body";
        (carrier.origin(), format!("`{body}` is one of the two bodies that {keyword} `{name}` couples; {right}"))
    })
}
