//! Absolute and relative angle of bodies.
//!
//! Row (1), in radians, not reduced modulo 2π:
//! ```text
//! φ − e = 0        or        φ_b − φ_a − e = 0
//! ```
//! After Haug (1989), section 3.2 and 3.3.

use super::joint::{JointType, joint};
use crate::constraint::{Assembly, Frame, RowMeaning, Rows};
use crate::mechanism::{BodyRef, Dimension, Formula, Slot};
use crate::vectors::{Equation, NamedJoint, Terms};
use crate::vocabulary::Role;

joint! {
    /// Operands of an absolute angle.
    Angle {
        /// The body.
        body: BodyRef = Slot::body("body"),
        /// The angle e.
        value: Formula = Slot::value(Dimension::Angle),
    }
    example: "#[angle(A: slider = 0)]"
}

joint! {
    /// Operands of a relative angle.
    RelativeAngle {
        /// The body a.
        a: BodyRef = Slot::body("a"),
        /// The body b.
        b: BodyRef = Slot::body("b"),
        /// The angle e.
        value: Formula = Slot::value(Dimension::Angle),
    }
    example: "#[relative_angle(A: crank, rocker = pi/2)]"
}

impl JointType for Angle {
    fn rows(&self, a: &mut Assembly<'_>) -> Rows {
        let frame = a.frame(&self.body);
        let phi = a.pose(&self.body)[2];
        let value = a.formula(&self.value);
        Rows {
            residuals: vec![("", RowMeaning::Angle, a.graph.sub(phi, value))],
            geometry: vec![(Role::Value, frame.unwrap_or(Frame::Ground), vec![value])],
            frames: [frame, None],
            ..Rows::default()
        }
    }
}

impl JointType for RelativeAngle {
    fn rows(&self, a: &mut Assembly<'_>) -> Rows {
        let frames = [a.frame(&self.a), a.frame(&self.b)];
        let (phi_a, phi_b) = (a.pose(&self.a)[2], a.pose(&self.b)[2]);
        let value = a.formula(&self.value);
        let turn = a.graph.sub(phi_b, phi_a);
        Rows {
            residuals: vec![("", RowMeaning::Angle, a.graph.sub(turn, value))],
            geometry: vec![(Role::Value, frames[0].unwrap_or(Frame::Ground), vec![value])],
            quantities: vec![("angle", turn)],
            frames,
            ..Rows::default()
        }
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        Terms::of(joint).map_or_else(Vec::new, |terms| vec![terms.turned_by(terms.scalar("e"))])
    }
}
