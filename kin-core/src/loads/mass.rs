//! A mass m with its centre at a point C of a body, and the moment of inertia J about it.
//!
//! ```text
//! along r_C:  m (g − r̈_C)        along φ:  −J φ̈
//! ```
//! Kinetic energy ½ m ṙ_C² + ½ J φ̇², potential energy −m g·r_C, which is 0 at the origin. Several masses of one body
//! add up. A field that varies in time has the applied power −m ġ·r_C. After Haug (1989), section 6.1.

use super::free_bodies::FreeBodies;
use super::load::{Acting, Exerted, LoadType, Work, load};
use crate::mechanism::{Dimension, Formula, OperandSlot, OperandType, Place};

load! {
    /// Operands of a mass.
    Mass {
        /// C, the centre of mass.
        centre: Place = OperandSlot::frame("c"),
        /// m.
        mass: Formula = OperandSlot::option("mass", OperandType::Constant).measured_in(Dimension::Derived([1, 0, 0])),
        /// J.
        inertia: Formula = OperandSlot::offset("inertia", Dimension::Derived([1, 2, 0])).taking(OperandType::Constant),
    }
    named: false,
    example: "#[mass(crank @ (l1/2, 0), mass = m1, inertia = j1)]"
}

impl LoadType for Mass {
    fn acts(&self, bodies: &mut FreeBodies<'_>) -> Acting {
        let [posed, free] = bodies.place(&self.centre);
        let (mass, inertia) = (bodies.formula(&self.mass), bodies.formula(&self.inertia));
        let [x, y, phi] = [posed.r[0], posed.r[1], posed.angle].map(|e| bodies.motion(e));
        let field = bodies.field;
        let field_rate = field.map(|g| bodies.motion(g).rate);
        let graph = &mut bodies.a.graph;
        let mut acting = Acting::nothing(graph.zero());
        acting.mass = Some((posed.frame, [mass, inertia]));
        acting.inertial = vec![(posed.r[0], mass), (posed.r[1], mass), (posed.angle, inertia)];
        let (a, v) = ([x.acceleration, y.acceleration], [x.rate, y.rate]);
        let mut inertial = [mass, mass, inertia];
        for (force, acceleration) in inertial.iter_mut().zip([a[0], a[1], phi.acceleration]) {
            let product = graph.mul(*force, acceleration);
            *force = graph.neg(product);
        }
        let weight = field.map(|g| graph.mul(mass, g));
        for c in 0..2 {
            let pull = graph.sub(field[c], a[c]);
            let force = graph.mul(mass, pull);
            acting.work.push(Work { posed: posed.r[c], free: free.r[c], force });
        }
        acting.work.push(Work { posed: posed.angle, free: free.angle, force: inertial[2] });
        let about = graph.plain_cross(posed.r, [inertial[0], inertial[1]]);
        acting.inertia = [inertial[0], inertial[1], graph.add(about, inertial[2])];
        acting.outside = [weight[0], weight[1], graph.plain_cross(posed.r, weight)];
        let (v_squared, turn_squared) = (graph.plain_dot(v, v), graph.square(phi.rate));
        let [linear, angular] = [graph.mul(mass, v_squared), graph.mul(inertia, turn_squared)];
        let (doubled_energy, half) = (graph.add(linear, angular), graph.number(0.5));
        if !weight.iter().all(|force| graph.is_zero(*force)) {
            acting.exerted = vec![Exerted::force(posed.frame, posed.r, weight)];
        }
        acting.kinetic = graph.mul(half, doubled_energy);
        let work = graph.plain_dot(weight, posed.r);
        acting.gravity = graph.neg(work);
        let varied = graph.plain_dot(field_rate, posed.r);
        let gained = graph.mul(mass, varied);
        acting.applied_power = graph.neg(gained);
        acting
    }
}
