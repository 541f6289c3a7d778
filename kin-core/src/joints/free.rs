//! Free-form equations in positions.
//!
//! Row (1), in the unit of the sides:
//! ```text
//! left − right = 0
//! ```

use super::joint::{JointType, Reaction, joint};
use crate::constraint::{Assembly, Rows};
use crate::mechanism::{Formula, OperandType, Slot};

joint! {
    /// The sides of an equation.
    Constraint {
        /// The left side.
        left: Formula = Slot::left(OperandType::Side),
        /// The right side.
        right: Formula = Slot::right(OperandType::Side),
    }
    example: "#[constraint(close_x: l1*cos(phi1) + l2*cos(phi2) = d1)]"
}

impl JointType for Constraint {
    const REACTION: Reaction = Reaction::Generalized;

    fn rows(&self, a: &mut Assembly<'_>) -> Rows {
        Rows::equation(a, &self.left, &self.right)
    }
}
