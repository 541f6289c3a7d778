//! A spring with a damper between the points P and Q.
//!
//! ```text
//! tension  N = k (ℓ − ℓ₀) + c ℓ̇,  ℓ = |r_Q − r_P|        along ℓ:  −N
//! ```
//! Energy ½ k (ℓ − ℓ₀)², power of the damper −c ℓ̇². If k or ℓ₀ varies, the variation supplies the power
//! ½ k̇ (ℓ − ℓ₀)² − k (ℓ − ℓ₀) ℓ̇₀, which is part of the power of applied loads.

use super::elastic::{Elastic, stretched};
use super::free_bodies::FreeBodies;
use super::load::{Acting, Exerted, LoadType, load};
use crate::mechanism::{Dimension, Formula, OperandSlot, OperandType, Place};

load! {
    /// Operands of a spring.
    Spring {
        /// P.
        p: Place = OperandSlot::point("p"),
        /// Q.
        q: Place = OperandSlot::point("q"),
        /// k.
        stiffness: Formula = OperandSlot::offset("stiffness", Dimension::Derived([1, 0, -2])).taking(OperandType::Side),
        /// ℓ₀.
        free_length: Formula = OperandSlot::offset("free_length", Dimension::Length).taking(OperandType::Side),
        /// c.
        damping: Formula = OperandSlot::offset("damping", Dimension::Derived([1, 0, -1])).taking(OperandType::Side),
    }
    named: true,
    example: "#[spring(S: ground @ (0, 1), rocker @ (l3, 0), stiffness = k, free_length = l0)]"
}

impl LoadType for Spring {
    fn acts(&self, bodies: &mut FreeBodies<'_>) -> Acting {
        let length = bodies.both(|a| {
            let (p, q) = (a.place(&self.p), a.place(&self.q));
            a.distance(&p, &q)
        });
        let (stiffness, damping) = (&self.stiffness, &self.damping);
        let mut acting = stretched(bodies, &Elastic { length, stiffness, free: &self.free_length, damping });
        let [p, q] = [&self.p, &self.q].map(|end| bodies.place(end)[0]);
        if let Some(pull) = acting.spring.map(|spring| spring[2]) {
            let graph = &mut bodies.a.graph;
            let by_length = graph.div(pull, length[0]);
            let on_p = [0, 1].map(|c| {
                let along = graph.sub(q.r[c], p.r[c]);
                graph.mul(by_length, along)
            });
            let on_q = on_p.map(|force| graph.neg(force));
            acting.exerted = vec![Exerted::force(p.frame, p.r, on_p), Exerted::force(q.frame, q.r, on_q)];
        }
        acting
    }
}
