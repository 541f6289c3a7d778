//! Gear: two bodies roll on one another; their axles are fixed, or moved by a carrier.
//!
//! Row (1), in units of length; φ_c = 0 for axles in the ground:
//! ```text
//! R_a(φ_a − φ_c) + R_b(φ_b − φ_c) − e = 0
//! ```
//! External gears have radii of the same sign and rotate in opposite senses. The ring of an internal pair has a
//! negative radius and rotates in the sense of its pinion. Only the ratio matters, so numbers of teeth can be given
//! instead of radii. The row does not hold the axles in place, for which revolute joints on the carrier are needed.
//! Never singular as long as no radius is 0; for R_a + R_b = 0 the carrier cancels out. After Haug (1989), section
//! 3.3; relative to the carrier it is Willis' equation.

use super::joint::{JointType, Reaction, joint};
use crate::constraint::{Assembly, Frame, JointRows, RowMeaning};
use crate::error::{ModelError, Origin};
use crate::expr::ExprId;
use crate::mechanism::{BodyRef, Dimension, Formula, Mechanism, OperandSlot, OperandType, Radii, Statement};
use crate::vectors::{Equation, EquationPiece, Letter, NamedJoint, Terms, equals};
use crate::vocabulary::Role;

joint! {
    /// Operands of a gear pair.
    Gear {
        /// The body a.
        a: BodyRef = OperandSlot::body("a"),
        /// The body b.
        b: BodyRef = OperandSlot::body("b"),
        /// The radii R_a and R_b.
        radii: Radii = OperandSlot::option("radii", OperandType::Radii).measured_in(Dimension::CommonLength),
        /// The body that carries both axles, by default the ground.
        carrier: BodyRef = OperandSlot::option("carrier", OperandType::Carrier),
        /// The offset e.
        offset: Formula = OperandSlot::offset("offset", Dimension::CommonLength),
    }
    example: "#[gear(A: sun, planet, radii = (r1, r2), carrier = arm)]"
}

impl JointType for Gear {
    const REACTION: Reaction = Reaction::Couples;

    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        coupled(a, [&self.a, &self.b, &self.carrier], &self.radii, &self.offset, |a, [first, second]| {
            a.graph.add(first, second)
        })
    }

    fn check(&self, joint: &Statement, mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
        carrier_is_a_third_body([self.a, self.b], self.carrier, joint, mechanism, errors);
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        coupled_angles(joint, " + ")
    }
}

/// The row of two arcs R_a(φ_a − φ_c) and R_b(φ_b − φ_c) combined by `join`, minus the offset; `bodies` are a, b and
/// c.
pub(super) fn coupled(
    a: &mut Assembly<'_>,
    bodies: [&BodyRef; 3],
    radii: &Radii,
    offset: &Formula,
    join: impl FnOnce(&mut Assembly<'_>, [ExprId; 2]) -> ExprId,
) -> JointRows {
    let [i, j, carrier] = bodies.map(|body| a.frame(body));
    let turned = bodies.map(|body| a.pose(body)[2]);
    let radii = [&radii.i, &radii.j].map(|radius| a.radius(radius));
    let offset = a.formula(offset);
    let arcs = [0, 1].map(|k| {
        let angle = a.graph.sub(turned[k], turned[2]);
        a.graph.mul(radii[k], angle)
    });
    let whole = join(a, arcs);
    let frame = |frame: Option<Frame>| frame.unwrap_or(Frame::Ground);
    JointRows {
        residuals: vec![("", RowMeaning::Other, a.graph.sub(whole, offset))],
        geometry: vec![
            (Role::Radius, frame(i), vec![radii[0]]),
            (Role::Radius, frame(j), vec![radii[1]]),
            (Role::Value, frame(carrier), vec![offset]),
        ],
        frames: [i, j],
        ..JointRows::default()
    }
}

/// Rule: the carrier of a gear pair is neither of the two gears, for any index of the range.
pub(super) fn carrier_is_a_third_body(
    gears: [BodyRef; 2],
    carrier: BodyRef,
    joint: &Statement,
    mechanism: &Mechanism,
    errors: &mut Vec<ModelError>,
) {
    // A joint of two gears on one body is reported by another rule.
    if mechanism.common_member(joint.range, gears[0], gears[1]).is_some() {
        return;
    }
    let fault = |gear| own_carrier(mechanism, joint, gear, carrier);
    errors.extend(gears.into_iter().find_map(fault).map(|(origin, message)| ModelError::new(origin, message)));
}

/// If a gear is its own carrier, the origin and the message of the error.
fn own_carrier(mechanism: &Mechanism, joint: &Statement, gear: BodyRef, carrier: BodyRef) -> Option<(Origin, String)> {
    let body = mechanism.common_member(joint.range, gear, carrier)?;
    let (keyword, name) = (joint.operands.keyword(), &joint.name);
    Some(if gear.is_ground() {
        let wrong = format!("the ground cannot be one of the two bodies that {keyword} `{name}` couples");
        let right = "unless a moving body that carries both axles is given with `carrier = …`";
        (gear.origin(), format!("{wrong}, {right}"))
    } else {
        let right = "its carrier is a third body";
        (carrier.origin(), format!("`{body}` is one of the two bodies that {keyword} `{name}` couples; {right}"))
    })
}

/// The equation R_a(φ_a − φ_c) ± R_b(φ_b − φ_c) = e with the carrier c.
pub(super) fn coupled_angles(joint: &NamedJoint<'_>, sign: &'static str) -> Vec<Equation> {
    let Some(terms) = Terms::of(joint) else { return Vec::new() };
    let arc = |place: &'static str, phi: Letter| {
        [
            EquationPiece::Scalar(Letter::plain("R").of(place)),
            EquationPiece::Op("("),
            EquationPiece::Scalar(phi),
            EquationPiece::Op(" − "),
            EquationPiece::Scalar(Letter::plain("φ").of("c")),
            EquationPiece::Op(")"),
        ]
    };
    let (a, b) = (arc("a", terms.i.phi()), arc("b", terms.j.phi()));
    let arcs = a.into_iter().chain([EquationPiece::Op(sign)]).chain(b).collect();
    vec![equals(arcs, terms.scalar("e"))]
}
