//! Distance: P and Q keep a given distance, as if joined by a massless link (revolute–revolute composite).
//!
//! Row (1), in units of length squared:
//! ```text
//! |r_Q − r_P|² − e² = 0
//! ```
//! Singular if P and Q coincide, because the gradient of the square vanishes there. So e must not be 0; a revolute
//! joint makes points coincide. Reports the distance. After Haug (1989), section 3.2.

use super::joint::{JointType, joint};
use crate::constraint::{Assembly, JointRows, PlacedPoint, RowMeaning};
use crate::mechanism::{Function, OperandSlot, OperandType, Place, Value};
use crate::vectors::{Equation, NamedJoint, Terms, equals};
use crate::vocabulary::Role;

joint! {
    /// Operands of a distance.
    Distance {
        /// The point P of body i.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of body j.
        q: Place = OperandSlot::frame("q"),
        /// The length e.
        length: Value = OperandSlot::option("length", OperandType::Signal).positive(),
    }
    example: "#[distance(A: crank @ (l1, 0), rocker @ (0, 0), length = l2)]"
}

impl JointType for Distance {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        between(a, &p, &q, &self.length)
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        let Some(terms) = Terms::of(joint) else { return Vec::new() };
        vec![equals(terms.square_of_d(), terms.squared("e")), terms.d_is_difference()]
    }
}

/// The row |r_Q − r_P|² − e².
pub(super) fn between(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint, length: &Value) -> JointRows {
    let length = a.length(length);
    let mut rows = JointRows::between(p, q);
    rows.geometry.push((Role::Value, p.frame, vec![length]));
    let square = a.square_of_distance(p, q);
    let target = a.graph.square(length);
    rows.residuals = vec![("", RowMeaning::SquaredDistance, a.graph.sub(square, target))];
    rows.quantities = vec![("distance", a.graph.call(Function::Sqrt, square))];
    rows
}
