//! Belt or chain: two bodies rotate in the same sense, with the ratio given by their radii.
//!
//! Row (1), in units of length; φ_c = 0 for axles in the ground:
//! ```text
//! R_a(φ_a − φ_c) − R_b(φ_b − φ_c) − e = 0
//! ```
//! A crossed belt has radii of opposite sign. The belt does not slip, and only the ratio of the radii matters. The row
//! is that of a [`gear`](super::gear) with the sign of the second radius reversed.

use super::gear::{carrier_is_a_third_body, coupled, coupled_angles};
use super::joint::{JointType, Reaction, joint};
use crate::constraint::{Assembly, JointRows};
use crate::error::ModelError;
use crate::mechanism::{BodyRef, Dimension, Formula, Mechanism, OperandSlot, OperandType, Radii, Statement};
use crate::vectors::{Equation, NamedJoint};

joint! {
    /// Operands of a belt or chain.
    Belt {
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
    example: "#[belt(A: motor, spindle, radii = (r1, r2))]"
}

impl JointType for Belt {
    const REACTION: Reaction = Reaction::Couples;

    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        coupled(a, [&self.a, &self.b, &self.carrier], &self.radii, &self.offset, |a, [first, second]| {
            a.graph.sub(first, second)
        })
    }

    fn check(&self, joint: &Statement, mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
        carrier_is_a_third_body([self.a, self.b], self.carrier, joint, mechanism, errors);
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        coupled_angles(joint, " − ")
    }
}
