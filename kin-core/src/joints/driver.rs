//! Driving constraints.
//!
//! Row (1):
//! ```text
//! left − right = 0
//! ```
//! A driver whose left side is exactly `distance(P, Q)` is written |r_Q − r_P|² − f², which has no square root and
//! the same solutions for f > 0. If f contains coordinates it is no length that the driver prescribes, and the row is
//! left − right. After Haug (1989), section 3.5.

use super::distance;
use super::joint::{JointType, Reaction, joint};
use crate::constraint::{Assembly, JointRows};
use crate::mechanism::{Formula, OperandSlot, OperandType, Value, contains_coordinate};

joint! {
    /// The sides of a driving constraint.
    Driver {
        /// The left side.
        left: Formula = OperandSlot::left(OperandType::Side),
        /// The right side.
        right: Value = OperandSlot::right(OperandType::Side),
    }
    example: "#[driver(drive: crank.phi = phi0 + omega*t)]"
}

impl JointType for Driver {
    const REACTION: Reaction = Reaction::Generalized;

    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        if let Formula::Distance(p, q) = &self.left
            && !contains_coordinate(a.mechanism, &self.right.value)
        {
            let (p, q) = (a.place(p), a.place(q));
            return distance::between(a, &p, &q, &self.right);
        }
        JointRows::equation(a, &self.left, &self.right.value)
    }
}
