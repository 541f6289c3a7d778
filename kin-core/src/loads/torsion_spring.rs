//! A torsion spring with a damper between the bodies a and b.
//!
//! ```text
//! couple on b  −k (α − α₀) − c α̇,  α = φ_b − φ_a, not wrapped        its reaction on a
//! ```
//! Energy ½ k (α − α₀)², power of the damper −c α̇².

use super::elastic::{Elastic, stretched};
use super::free_bodies::FreeBodies;
use super::load::{Acting, Exerted, LoadType, load};
use crate::mechanism::{BodyRef, Dimension, Formula, OperandSlot, OperandType};

load! {
    /// Operands of a torsion spring.
    TorsionSpring {
        /// a.
        a: BodyRef = OperandSlot::body("a"),
        /// b.
        b: BodyRef = OperandSlot::body("b"),
        /// k.
        stiffness: Formula = OperandSlot::offset("stiffness", Dimension::Derived([1, 2, -2])).taking(OperandType::Side),
        /// α₀.
        free_angle: Formula = OperandSlot::offset("free_angle", Dimension::Angle).taking(OperandType::Side),
        /// c.
        damping: Formula = OperandSlot::offset("damping", Dimension::Derived([1, 2, -1])).taking(OperandType::Side),
    }
    named: true,
    example: "#[torsion_spring(S: ground, rocker, stiffness = k, free_angle = a0)]"
}

impl LoadType for TorsionSpring {
    fn acts(&self, bodies: &mut FreeBodies<'_>) -> Acting {
        let (a, b) = (bodies.angle(&self.a), bodies.angle(&self.b));
        let length = [0, 1].map(|view| bodies.a.graph.sub(b[view], a[view]));
        let (stiffness, damping) = (&self.stiffness, &self.damping);
        let mut acting = stretched(bodies, &Elastic { length, stiffness, free: &self.free_angle, damping });
        // The couple on b takes the place of the tension of a spring between points.
        if let (Some(spring), Some(work)) = (&mut acting.spring, acting.work.first()) {
            spring[2] = work.force;
            let couple = work.force;
            let [on_a, on_b] = [&self.a, &self.b].map(|body| bodies.a.frame(body));
            let back = bodies.a.graph.neg(couple);
            let couples = [on_a.zip(Some(back)), on_b.zip(Some(couple))];
            acting.exerted = couples.into_iter().flatten().map(|(on, couple)| Exerted::couple(on, couple)).collect();
        }
        acting
    }
}
