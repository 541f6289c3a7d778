//! Absolute angle of a body, and relative angle of two bodies.
//!
//! Row (1), in radians, not reduced modulo 2π:
//! ```text
//! φ − e = 0        or        φ_b − φ_a − e = 0
//! ```
//! After Haug (1989), sections 3.2 and 3.3.

use super::joint::{JointType, joint};
use crate::constraint::{Assembly, Frame, JointRows, RowMeaning};
use crate::mechanism::{BodyRef, Dimension, Formula, OperandSlot};
use crate::vectors::{Equation, NamedJoint, Terms};
use crate::vocabulary::Role;

joint! {
    /// Operands of an absolute angle.
    Angle {
        /// The body.
        body: BodyRef = OperandSlot::body("body"),
        /// The angle e.
        value: Formula = OperandSlot::value(Dimension::Angle),
    }
    example: "#[angle(A: slider = 0)]"
}

joint! {
    /// Operands of a relative angle.
    RelativeAngle {
        /// The body a.
        a: BodyRef = OperandSlot::body("a"),
        /// The body b.
        b: BodyRef = OperandSlot::body("b"),
        /// The angle e.
        value: Formula = OperandSlot::value(Dimension::Angle),
    }
    example: "#[relative_angle(A: crank, rocker = pi/2)]"
}

impl JointType for Angle {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let frame = a.frame(&self.body);
        let phi = a.pose(&self.body)[2];
        let value = a.formula(&self.value);
        JointRows {
            residuals: vec![("", RowMeaning::Angle, a.graph.sub(phi, value))],
            geometry: vec![(Role::Value, frame.unwrap_or(Frame::Ground), vec![value])],
            frames: [frame, None],
            ..JointRows::default()
        }
    }
}

impl JointType for RelativeAngle {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let frames = [a.frame(&self.a), a.frame(&self.b)];
        let (phi_a, phi_b) = (a.pose(&self.a)[2], a.pose(&self.b)[2]);
        let value = a.formula(&self.value);
        let turn = a.graph.sub(phi_b, phi_a);
        JointRows {
            residuals: vec![("", RowMeaning::Angle, a.graph.sub(turn, value))],
            geometry: vec![(Role::Value, frames[0].unwrap_or(Frame::Ground), vec![value])],
            quantities: vec![("angle", turn)],
            frames,
            ..JointRows::default()
        }
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        Terms::of(joint).map_or_else(Vec::new, |terms| vec![terms.turned_by(terms.scalar("e"))])
    }
}
