//! A couple τ on a body, counter-clockwise; with two bodies it acts on the second, and its reaction on the first.
//!
//! ```text
//! along φ_b:  τ        along φ_b − φ_a:  τ        power  τ φ̇_b, or τ (φ̇_b − φ̇_a)
//! ```

use super::free_bodies::FreeBodies;
use super::load::{Acting, Exerted, LoadType, Work, load};
use crate::mechanism::{BodyRef, Dimension, Formula, OperandSlot, OperandType};

load! {
    /// Operands of a couple.
    Torque {
        /// b; or a and b.
        bodies: Vec<BodyRef> = OperandSlot::operand("b", OperandType::Bodies),
        /// τ.
        torque: Formula = OperandSlot::right(OperandType::SideOfRates).measured_in(Dimension::Derived([1, 2, -2])),
    }
    named: true,
    example: "#[torque(load: rocker = -c*dot(rocker.phi))]"
}

impl LoadType for Torque {
    fn acts(&self, bodies: &mut FreeBodies<'_>) -> Acting {
        let force = bodies.formula(&self.torque);
        let angles: Vec<[_; 2]> = self.bodies.iter().map(|body| bodies.angle(body)).collect();
        let zero = bodies.a.graph.zero();
        let mut acting = Acting::nothing(zero);
        let ([posed, free], from_outside) = match angles.as_slice() {
            [b] => (*b, true),
            [a, b] => ([0, 1].map(|view| bodies.a.graph.sub(b[view], a[view])), false),
            _ => return acting,
        };
        let rate = bodies.motion(posed).rate;
        let frames: Vec<_> = self.bodies.iter().filter_map(|body| bodies.a.frame(body)).collect();
        let graph = &mut bodies.a.graph;
        // A couple between two bodies has its reaction on a body or on the ground, so it is no load from outside.
        if from_outside {
            acting.outside[2] = force;
        }
        acting.work.push(Work { posed, free, force });
        let back = graph.neg(force);
        let couples = frames.into_iter().rev().zip([force, back]);
        acting.exerted = couples.map(|(on, couple)| Exerted::couple(on, couple)).collect();
        acting.applied_power = graph.mul(force, rate);
        acting
    }
}
