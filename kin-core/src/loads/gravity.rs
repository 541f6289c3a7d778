//! Gravity: a field g = (g_x, g_y) in the inertial frame, an acceleration, that exerts the force m g on every mass m.

use super::free_bodies::FreeBodies;
use super::load::{Acting, LoadType, load};
use crate::mechanism::{Dimension, Formula, OperandSlot, OperandType};

load! {
    /// Components of the field.
    Gravity {
        /// g_x.
        x: Formula = OperandSlot::operand("x", OperandType::Signal).measured_in(Dimension::Derived([0, 1, -2])),
        /// g_y.
        y: Formula = OperandSlot::operand("y", OperandType::Signal).measured_in(Dimension::Derived([0, 1, -2])),
    }
    named: false,
    example: "#[gravity(0, -9.81)]"
}

impl LoadType for Gravity {
    fn acts(&self, bodies: &mut FreeBodies<'_>) -> Acting {
        bodies.field = [bodies.formula(&self.x), bodies.formula(&self.y)];
        Acting::nothing(bodies.a.graph.zero())
    }
}
