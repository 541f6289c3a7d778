//! Screw: rotation of a spindle moves a carriage along its axis, in proportion to the angle.
//!
//! Row (1), where u = A_i v̂ belongs to the guide i and φ_b to the rotating body, in units of length:
//! ```text
//! u·(r_Q − r_P) − p/(2π) (φ_b − φ_i) − e = 0
//! ```
//! p is the lead: the distance by which one turn moves Q along the axis. With a positive lead counter-clockwise
//! rotation of b moves Q along the axis, with a negative one against it. In the plane, b stands for the rotation of
//! the spindle: the rotor of a motor, a handwheel, a gear in front of a bevel gear. A translational joint keeps the
//! carriage on its guide, and a revolute joint or a held origin keeps b in place. The row is that of a
//! [rack](super::RackPinion) with the radius p/(2π). Reports the stroke u·(r_Q − r_P).

use super::joint::{JointType, Reaction, joint};
use super::rack_pinion::{guide_does_not_turn, stroke_by_angle};
use crate::constraint::{Assembly, JointRows};
use crate::error::ModelError;
use crate::mechanism::{
    Axis, BodyRef, Dimension, Formula, Mechanism, OperandSlot, OperandType, Place, Statement, Value,
};

joint! {
    /// Operands of a screw.
    Screw {
        /// The point P of the guide, body i.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of the carriage, body j.
        q: Place = OperandSlot::point("q"),
        /// The direction v in body i.
        axis: Axis = OperandSlot::option("axis", OperandType::Axis),
        /// The lead p, the stroke per turn.
        lead: Value = OperandSlot::option("lead", OperandType::Signal).measured_in(Dimension::LengthPerTurn),
        /// The rotating body b.
        nut: BodyRef = OperandSlot::option("nut", OperandType::Body),
        /// The offset e.
        offset: Formula = OperandSlot::offset("offset", Dimension::Length),
    }
    example: "#[screw(N: ground @ (0, 0), carriage @ (0, 0), axis = (1, 0), lead = p, nut = motor)]"
}

impl JointType for Screw {
    const REACTION: Reaction = Reaction::OnSecondAndCouples;

    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let lead = a.nonzero(&self.lead, "this lead", "a lead is positive, or negative where the stroke is reversed");
        let turns = a.graph.number(0.5 * core::f64::consts::FRAC_1_PI);
        let by_radian = a.graph.mul(lead, turns);
        stroke_by_angle(a, [&self.p, &self.q], &self.axis, &self.nut, by_radian, &self.offset)
    }

    fn check(&self, joint: &Statement, mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
        guide_does_not_turn(self.p.body, self.nut, "nut", joint, mechanism, errors);
    }
}
