//! Rack and pinion: a pinion, whose axle is on the guide, moves a rack along the guide.
//!
//! Row (1), where u = A_i v̂ belongs to the guide i and φ_b to the pinion, in units of length:
//! ```text
//! u·(r_Q − r_P) − R(φ_b − φ_i) − e = 0
//! ```
//! With a positive radius, counter-clockwise rotation of the pinion moves the rack along the axis: the rack meshes to
//! the right of the axle, seen along the axis. A rack to the left has a negative radius. A translational joint keeps
//! the rack on its guide, and a revolute joint the pinion on its axle. Never singular as long as R is not 0. Reports
//! the stroke u·(r_Q − r_P). After Haug (1989), section 3.3.

use super::joint::{JointType, Reaction, joint};
use super::translational::along;
use crate::constraint::{Assembly, Frame, JointRows, RowMeaning};
use crate::error::ModelError;
use crate::expr::ExprId;
use crate::mechanism::{
    Axis, BodyRef, Dimension, Formula, Mechanism, OperandSlot, OperandType, Place, Statement, Value,
};
use crate::vectors::{Equation, EquationPiece, Letter, NamedJoint, Terms, equals};
use crate::vocabulary::Role;

joint! {
    /// Operands of a rack and its pinion.
    RackPinion {
        /// The point P of the guide, body i.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of the rack, body j.
        q: Place = OperandSlot::point("q"),
        /// The direction v in body i.
        axis: Axis = OperandSlot::option("axis", OperandType::Axis),
        /// The pinion, whose axle is on the guide.
        pinion: BodyRef = OperandSlot::option("pinion", OperandType::Body),
        /// The radius R.
        radius: Value = OperandSlot::option("radius", OperandType::Radius),
        /// The offset e.
        offset: Formula = OperandSlot::offset("offset", Dimension::Length),
    }
    example: "#[rack_pinion(A: ground @ (0, 0), rack @ (0, 0), axis = (1, 0), pinion = wheel, radius = r)]"
}

impl JointType for RackPinion {
    const REACTION: Reaction = Reaction::OnSecondAndCouples;

    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let wheel = a.frame(&self.pinion).unwrap_or(Frame::Ground);
        let radius = a.radius(&self.radius);
        let mut rows = stroke_by_angle(a, [&self.p, &self.q], &self.axis, &self.pinion, radius, &self.offset);
        rows.geometry.insert(3, (Role::Radius, wheel, vec![radius]));
        rows
    }

    fn check(&self, joint: &Statement, mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
        guide_does_not_turn(self.p.body, self.pinion, "pinion", joint, mechanism, errors);
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        let Some(terms) = Terms::of(joint) else { return Vec::new() };
        let arc = [
            EquationPiece::Op(" − "),
            EquationPiece::Scalar(Letter::plain("R").of(joint.name)),
            EquationPiece::Op("Δφ"),
        ];
        let stroke = terms.along().into_iter().chain(arc).collect();
        vec![equals(stroke, terms.scalar("e")), terms.d_is_difference()]
    }
}

/// The row of a stroke along `axis` that is proportional to a rotation relative to the guide, `by_radian` for each
/// radian: u·(r_Q − r_P) − by_radian (φ_b − φ_i) − e.
pub(super) fn stroke_by_angle(
    a: &mut Assembly<'_>,
    [p, q]: [&Place; 2],
    axis: &Axis,
    turning: &BodyRef,
    by_radian: ExprId,
    offset: &Formula,
) -> JointRows {
    let (p, q) = (a.place(p), a.place(q));
    let axis = a.axis(axis, &p);
    let (turned, offset) = (a.pose(turning)[2], a.formula(offset));
    let stroke = along(a, &axis, &p, &q);
    let angle = a.graph.sub(turned, p.angle);
    let advance = a.graph.mul(by_radian, angle);
    let rest = a.graph.sub(stroke, advance);
    let mut rows = JointRows::between(&p, &q);
    rows.geometry.push((Role::Axis, p.frame, axis.local.to_vec()));
    rows.geometry.push((Role::Value, p.frame, vec![offset]));
    rows.residuals = vec![("", RowMeaning::Other, a.graph.sub(rest, offset))];
    rows.quantities = vec![("stroke", stroke)];
    rows
}

/// Rule: the guide is not the rotating body, for any index of the range; `role` names the latter in the message.
pub(super) fn guide_does_not_turn(
    guide: BodyRef,
    turning: BodyRef,
    role: &str,
    joint: &Statement,
    mechanism: &Mechanism,
    errors: &mut Vec<ModelError>,
) {
    if let Some(body) = mechanism.common_member(joint.range, guide, turning) {
        let (keyword, name) = (joint.operands.keyword(), &joint.name);
        let message = format!("`{body}` is the guide of {keyword} `{name}`, so that it cannot also be the {role}");
        errors.push(ModelError::new(turning.origin(), message));
    }
}
