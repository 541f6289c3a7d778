//! Point on a line: Q of body j stays on a line of body i through P, or at a signed distance from it
//! (revolute–translational composite).
//!
//! Row (1), with u = A_i v̂, in units of length; a positive offset is to the left of the axis:
//! ```text
//! perp(u)·(r_Q − r_P) − e = 0
//! ```
//! Reports the stroke u·(r_Q − r_P). After Haug (1989), section 3.3.

use super::joint::{JointType, joint};
use super::translational::{across, along};
use crate::constraint::{Assembly, JointRows, RowMeaning};
use crate::mechanism::{Axis, Dimension, Formula, OperandSlot, OperandType, Place};
use crate::vectors::{Equation, NamedJoint, Terms, equals};
use crate::vocabulary::Role;

joint! {
    /// Operands of a point on a line.
    PointOnLine {
        /// The point P of body i, on the line.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of body j.
        q: Place = OperandSlot::frame("q"),
        /// The direction v of the line in body i.
        axis: Axis = OperandSlot::option("axis", OperandType::Axis),
        /// The offset e.
        offset: Formula = OperandSlot::offset("offset", Dimension::Length),
    }
    example: "#[point_on_line(A: rocker @ (0, 0), crank @ (l1, 0), axis = (1, 0))]"
}

impl JointType for PointOnLine {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        let axis = a.axis(&self.axis, &p);
        let offset = a.formula(&self.offset);
        let mut rows = JointRows::between(&p, &q);
        rows.geometry.push((Role::Axis, p.frame, axis.local.to_vec()));
        rows.geometry.push((Role::Value, p.frame, vec![offset]));
        let normal = across(a, &axis, &p, &q);
        rows.residuals = vec![("", RowMeaning::AcrossAxis(Some(offset)), a.graph.sub(normal, offset))];
        rows.quantities = vec![("stroke", along(a, &axis, &p, &q))];
        rows
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        let Some(terms) = Terms::of(joint) else { return Vec::new() };
        vec![equals(terms.across(), terms.scalar("e")), terms.d_is_difference()]
    }
}
