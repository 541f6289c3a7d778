//! Fixed joint: two bodies move as one rigid body.
//!
//! Rows (3): those of a revolute joint, and the relative angle.
//! ```text
//! x, y:   r_Q − r_P = 0
//! angle:  φ_j − φ_i − c = 0
//! ```

use super::joint::{JointType, joint};
use super::revolute::coincidence;
use crate::constraint::{Assembly, JointRows, RowMeaning};
use crate::mechanism::{Dimension, Formula, OperandSlot, Place};
use crate::vectors::{Equation, NamedJoint, Terms, equals, zero};
use crate::vocabulary::Role;

joint! {
    /// Operands of a fixed joint.
    Fixed {
        /// The point P of body i.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of body j.
        q: Place = OperandSlot::frame("q"),
        /// The angle c.
        angle: Formula = OperandSlot::offset("angle", Dimension::Angle).in_last_row(),
    }
    example: "#[fixed(A: crank @ (l1, 0), plate @ (0, 0), angle = 0)]"
}

impl JointType for Fixed {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        let angle = a.formula(&self.angle);
        let mut rows = JointRows::between(&p, &q);
        rows.geometry.push((Role::Value, p.frame, vec![angle]));
        rows.residuals = coincidence(a, p.r, q.r);
        let turn = a.graph.sub(q.angle, p.angle);
        rows.residuals.push(("angle", RowMeaning::Angle, a.graph.sub(turn, angle)));
        rows
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        let Some(terms) = Terms::of(joint) else { return Vec::new() };
        vec![equals(terms.difference(), zero()), terms.turned_by(terms.scalar("c"))]
    }
}
