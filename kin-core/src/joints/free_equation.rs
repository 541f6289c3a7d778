//! Free-form equations in positions.
//!
//! Row (1), in the unit of the sides:
//! ```text
//! left − right = 0
//! ```

use super::joint::{JointType, Reaction, joint};
use crate::constraint::{Assembly, JointRows};
use crate::mechanism::{Formula, OperandSlot, OperandType};

joint! {
    /// The sides of an equation.
    Constraint {
        /// The left side.
        left: Formula = OperandSlot::left(OperandType::Side),
        /// The right side.
        right: Formula = OperandSlot::right(OperandType::Side),
    }
    example: "#[constraint(close_x: l1*cos(phi1) + l2*cos(phi2) = d1)]"
}

impl JointType for Constraint {
    const REACTION: Reaction = Reaction::Generalized;

    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        JointRows::equation(a, &self.left, &self.right)
    }
}
