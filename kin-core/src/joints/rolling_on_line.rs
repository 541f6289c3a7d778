//! Rolling on a line: a disc of body j, centred at Q, rolls without slipping on a line of body i through P.
//!
//! Rows (2), with u = A_i v̂ and d = r_Q − r_P, in units of length:
//! ```text
//! normal:  perp(u)·d − R = 0
//! roll:    u·d + R(φ_j − φ_i) − e = 0
//! ```
//! A positive radius means a disc to the left of the axis, which rotates clockwise when it rolls along the axis; a
//! negative radius means a disc to the right. The derivative of the second row says that the point of the disc in
//! contact with the line has the velocity of the line there. Never singular as long as R is not 0. Reports the stroke
//! u·d of the centre. After Nikravesh (1988), section 4.2.

use super::contact::{Contact, Normal, side};
use super::joint::{JointType, joint};
use super::translational::{across, along};
use crate::constraint::{Assembly, JointRows, RowMeaning};
use crate::mechanism::{Axis, Dimension, Formula, OperandSlot, OperandType, Place, Value};
use crate::vectors::{Equation, EquationPiece, Letter, NamedJoint, Terms, equals};
use crate::vocabulary::Role;

/// A message with the two forms of a rolling disc.
pub(super) const WAYS: &str =
    "a disc rolls on a line with `axis = (1, 0), radius = r`, on another disc with `radii = (r1, r2), along = psi`";

joint! {
    /// Operands of a disc that rolls on a line.
    RollingOnLine {
        /// The point P of body i, on the line.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of body j, the centre of the disc.
        q: Place = OperandSlot::frame("q"),
        /// The direction v of the line in body i.
        axis: Axis = OperandSlot::option("axis", OperandType::Axis),
        /// The radius R.
        radius: Value = OperandSlot::option("radius", OperandType::Radius),
        /// The offset e.
        offset: Formula = OperandSlot::offset("offset", Dimension::Length).in_last_row(),
    }
    example: "#[rolling(A: ground @ (0, 0), wheel @ (0, 0), axis = (1, 0), radius = r)]",
    choice: WAYS
}

impl JointType for RollingOnLine {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        let axis = a.axis(&self.axis, &p);
        let (radius, offset) = (a.radius(&self.radius), a.formula(&self.offset));
        let mut rows = JointRows::between(&p, &q);
        rows.geometry.push((Role::Axis, p.frame, axis.local.to_vec()));
        rows.geometry.push((Role::Radius, q.frame, vec![radius]));
        rows.geometry.push((Role::Value, p.frame, vec![offset]));
        let (height, stroke) = (across(a, &axis, &p, &q), along(a, &axis, &p, &q));
        let turn = a.graph.sub(q.angle, p.angle);
        let arc = a.graph.mul(radius, turn);
        let rolled = a.graph.add(stroke, arc);
        rows.residuals = vec![
            ("normal", RowMeaning::Other, a.graph.sub(height, radius)),
            ("roll", RowMeaning::Other, a.graph.sub(rolled, offset)),
        ];
        rows.quantities = vec![("stroke", stroke)];
        rows
    }

    /// The normal points from the line to the side on which the disc lies.
    fn contact(&self, a: &mut Assembly<'_>) -> Option<Contact> {
        let radius = a.formula(&self.radius.value);
        Some(Contact { normal: Normal::UnitGradient, side: side(&mut a.graph, radius), sticks: true })
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        let Some(terms) = Terms::of(joint) else { return Vec::new() };
        let roll = [
            EquationPiece::Op(" + "),
            EquationPiece::Scalar(Letter::plain("R").of(joint.name)),
            EquationPiece::Op("("),
            EquationPiece::Scalar(terms.j.phi()),
            EquationPiece::Op(" − "),
            EquationPiece::Scalar(terms.i.phi()),
            EquationPiece::Op(")"),
        ];
        let rolled = terms.along().into_iter().chain(roll).collect();
        vec![equals(terms.across(), terms.scalar("R")), equals(rolled, terms.scalar("e")), terms.d_is_difference()]
    }
}
