//! Revolute joint: P of body i and Q of body j coincide.
//!
//! Rows (2), in the inertial frame, in units of length:
//! ```text
//! x:  x_Q − x_P = 0
//! y:  y_Q − y_P = 0        r = r_i + A_i s′
//! ```
//! Reports the relative angle φ_j − φ_i. Never singular by itself. After Haug (1989), section 3.3.

use super::joint::{JointType, joint};
use crate::constraint::{Assembly, JointRows, RowMeaning};
use crate::expr::ExprId;
use crate::mechanism::{OperandSlot, Place};
use crate::vectors::{Equation, NamedJoint, Terms, equals, zero};

joint! {
    /// Operands of a revolute joint.
    Revolute {
        /// The point P of body i.
        p: Place = OperandSlot::point("p"),
        /// The point Q of body j.
        q: Place = OperandSlot::point("q"),
    }
    example: "#[revolute(A: crank @ (l1, 0), coupler @ (0, 0))]"
}

impl JointType for Revolute {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        let mut rows = JointRows::between(&p, &q);
        rows.residuals = coincidence(a, p.r, q.r);
        rows.quantities = vec![("angle", a.graph.sub(q.angle, p.angle))];
        rows
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        Terms::of(joint).map_or_else(Vec::new, |terms| vec![equals(terms.difference(), zero())])
    }
}

/// The two rows r_Q − r_P.
pub(super) fn coincidence(
    a: &mut Assembly<'_>,
    p: [ExprId; 2],
    q: [ExprId; 2],
) -> Vec<(&'static str, RowMeaning, ExprId)> {
    vec![
        ("x", RowMeaning::Coincidence(0), a.graph.sub(q[0], p[0])),
        ("y", RowMeaning::Coincidence(1), a.graph.sub(q[1], p[1])),
    ]
}
