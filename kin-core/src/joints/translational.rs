//! Translational joint: body j slides along an axis of body i and does not rotate relative to it.
//!
//! Rows (2), with u = A_i v̂, |v̂| = 1:
//! ```text
//! normal:  perp(u)·(r_Q − r_P) = 0      length
//! angle:   φ_j − φ_i − c = 0            angle
//! ```
//! perp(u)·(r_P − r_i) is the constant perp(v̂)·s′_P, so the first row is computed as perp(u)·(r_Q − r_i) minus that
//! constant, which takes fewer operations. Reports the stroke u·(r_Q − r_P). After Haug (1989), section 3.3.

use super::joint::{JointType, joint};
use crate::constraint::{Assembly, JointRows, PlacedAxis, PlacedPoint, RowMeaning};
use crate::expr::ExprId;
use crate::mechanism::{Axis, Dimension, Formula, OperandSlot, OperandType, Place};
use crate::vectors::{Equation, NamedJoint, Terms, equals, zero};
use crate::vocabulary::Role;

joint! {
    /// Operands of a translational joint.
    Translational {
        /// The point P of body i.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of body j.
        q: Place = OperandSlot::frame("q"),
        /// The direction v of the axis in body i.
        axis: Axis = OperandSlot::option("axis", OperandType::Axis),
        /// The angle c.
        angle: Formula = OperandSlot::offset("angle", Dimension::Angle).in_last_row(),
    }
    example: "#[translational(A: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]"
}

impl JointType for Translational {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        let axis = a.axis(&self.axis, &p);
        let angle = a.formula(&self.angle);
        let mut rows = JointRows::between(&p, &q);
        rows.geometry.push((Role::Axis, p.frame, axis.local.to_vec()));
        rows.geometry.push((Role::Value, p.frame, vec![angle]));
        let turn = a.graph.sub(q.angle, p.angle);
        rows.residuals = vec![
            ("normal", RowMeaning::AcrossAxis(None), across(a, &axis, &p, &q)),
            ("angle", RowMeaning::Angle, a.graph.sub(turn, angle)),
        ];
        rows.quantities = vec![("stroke", along(a, &axis, &p, &q))];
        rows
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        let Some(terms) = Terms::of(joint) else { return Vec::new() };
        vec![equals(terms.across(), zero()), terms.turned_by(terms.scalar("c")), terms.d_is_difference()]
    }
}

/// The distance across the axis, perp(u)·(r_Q − r_P).
pub(super) fn across(a: &mut Assembly<'_>, axis: &PlacedAxis, p: &PlacedPoint, q: &PlacedPoint) -> ExprId {
    let d = [a.graph.sub(q.r[0], p.base[0]), a.graph.sub(q.r[1], p.base[1])];
    let whole = a.graph.cross(axis.angle, axis.u, d);
    let constant = a.graph.plain_cross(axis.local, p.local);
    a.graph.sub(whole, constant)
}

/// The stroke along the axis, u·(r_Q − r_P).
pub(super) fn along(a: &mut Assembly<'_>, axis: &PlacedAxis, p: &PlacedPoint, q: &PlacedPoint) -> ExprId {
    let d = [a.graph.sub(q.r[0], p.base[0]), a.graph.sub(q.r[1], p.base[1])];
    let whole = a.graph.dot(axis.angle, axis.u, d);
    let constant = a.graph.plain_dot(axis.local, p.local);
    a.graph.sub(whole, constant)
}
