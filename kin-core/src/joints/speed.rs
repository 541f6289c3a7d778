//! Speed: prescribes the velocity of a point of a body along a direction of the body. It is a driving row.
//!
//! Row (1) of velocity level, with ψ = φ_i + α and u = (cos ψ, sin ψ), in units of velocity:
//! ```text
//! u · ṙ_P − f = ẋ_P cos ψ + ẏ_P sin ψ − f = 0
//! ```
//! It does not restrict the velocity across u; see `knife_edge` for that.

use super::joint::{JointType, joint};
use super::nonholonomic::{Heading, velocity_row};
use crate::constraint::{Assembly, JointRows};
use crate::mechanism::{Dimension, Formula, OperandSlot, OperandType, Place};
use crate::vocabulary::Role;

joint! {
    /// Operands of a prescribed speed.
    Speed {
        /// The point P of body i.
        p: Place = OperandSlot::frame("p"),
        /// The angle α.
        angle: Formula = OperandSlot::offset("angle", Dimension::Angle),
        /// The prescribed speed f.
        value: Formula = OperandSlot::option("value", OperandType::Signal).measured_in(Dimension::Speed),
    }
    example: "#[speed(A: sleigh @ (0, 0), angle = 0, value = v)]"
}

impl JointType for Speed {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let heading = Heading::of(a, &self.p, &self.angle);
        let value = a.formula(&self.value);
        let velocity = velocity_row(a, |a| {
            let v = heading.velocity(a);
            let along = a.graph.dot(heading.psi, heading.u, v);
            a.graph.sub(along, value)
        });
        let mut rows = heading.rows(a, &self.angle, velocity);
        rows.geometry.push((Role::Value, heading.p.frame, vec![value]));
        rows
    }
}
