//! Knife edge: a point of a body can move only along a direction of the body, as a blade, skate or wheel does.
//!
//! Row (1) of velocity level, with ψ = φ_i + α and u = (cos ψ, sin ψ), in units of velocity:
//! ```text
//! u × ṙ_P = −ẋ_P sin ψ + ẏ_P cos ψ = 0
//! ```
//! α may depend on time, as for a steered wheel. Never singular by itself: if the origin of the body is free, its
//! coefficients in B are the unit vector perp(u). After Neimark and Fufaev, Dynamics of Nonholonomic Systems (1972),
//! chapter 1.

use super::joint::{JointType, joint};
use super::nonholonomic::{Heading, velocity_row};
use crate::constraint::{Assembly, JointRows};
use crate::mechanism::{Dimension, Formula, OperandSlot, Place};
use crate::vectors::{Equation, NamedJoint, Terms, equals, zero};

joint! {
    /// Operands of a knife edge.
    KnifeEdge {
        /// The point P of body i.
        p: Place = OperandSlot::frame("p"),
        /// The angle α.
        angle: Formula = OperandSlot::offset("angle", Dimension::Angle),
    }
    example: "#[knife_edge(A: sleigh @ (0, 0), angle = 0)]"
}

impl JointType for KnifeEdge {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let heading = Heading::of(a, &self.p, &self.angle);
        let velocity = velocity_row(a, |a| {
            let v = heading.velocity(a);
            a.graph.cross(heading.psi, heading.u, v)
        });
        heading.rows(a, &self.angle, velocity)
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        Terms::of_first(joint).map_or_else(Vec::new, |terms| vec![equals(terms.rate_across(), zero())])
    }
}
