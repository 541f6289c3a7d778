//! A force F on a body at a point P; its components are given in the inertial frame, or in the frame of a body b, with
//! which the force then turns.
//!
//! ```text
//! along r_P:  F, or A_b F        power  F·ṙ_P
//! ```

use super::free_bodies::FreeBodies;
use super::load::{Acting, Exerted, LoadType, Work, load};
use crate::mechanism::{BodyRef, Dimension, OperandSlot, OperandType, Place, Vector};

load! {
    /// Operands of a force.
    Force {
        /// P.
        point: Place = OperandSlot::frame("p"),
        /// F.
        force: Vector = OperandSlot::operand("force", OperandType::Vector).measured_in(Dimension::Derived([1, 1, -2])),
        /// The body whose frame the components are in.
        frame: BodyRef = OperandSlot::option("frame", OperandType::Carrier),
    }
    named: true,
    example: "#[force(load: coupler @ (l2, 0), (0, -f))]"
}

impl LoadType for Force {
    fn acts(&self, bodies: &mut FreeBodies<'_>) -> Acting {
        let [posed, free] = bodies.place(&self.point);
        let components = [bodies.formula(&self.force.x), bodies.formula(&self.force.y)];
        let angle = bodies.angle(&self.frame)[0];
        let force = bodies.a.graph.rotate(angle, components);
        let rates = posed.r.map(|e| bodies.motion(e).rate);
        let graph = &mut bodies.a.graph;
        let mut acting = Acting::nothing(graph.zero());
        acting.work = (0..2).map(|c| Work { posed: posed.r[c], free: free.r[c], force: force[c] }).collect();
        acting.outside = [force[0], force[1], graph.plain_cross(posed.r, force)];
        acting.exerted = vec![Exerted::force(posed.frame, posed.r, force)];
        acting.applied_power = graph.plain_dot(force, rates);
        acting
    }
}
