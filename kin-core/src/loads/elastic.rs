//! The common part of springs along lengths and along angles.

use super::free_bodies::FreeBodies;
use super::load::{Acting, Work};
use crate::expr::ExprId;
use crate::mechanism::Formula;

/// A spring with a damper along a length or an angle.
pub(super) struct Elastic<'f> {
    /// The length or angle in both views of [`FreeBodies`].
    pub(super) length: [ExprId; 2],
    pub(super) stiffness: &'f Formula,
    pub(super) free: &'f Formula,
    pub(super) damping: &'f Formula,
}

/// The action of a spring; for the formulas see [`Spring`](super::Spring).
pub(super) fn stretched(bodies: &mut FreeBodies<'_>, elastic: &Elastic<'_>) -> Acting {
    let [k, free, c] = [elastic.stiffness, elastic.free, elastic.damping].map(|formula| bodies.formula(formula));
    let [length, of_free_bodies] = elastic.length;
    let [k_dot, free_dot, rate] = [k, free, length].map(|e| bodies.motion(e).rate);
    let graph = &mut bodies.a.graph;
    let mut acting = Acting::nothing(graph.zero());
    let stretch = graph.sub(length, free);
    let (pull, drag) = (graph.mul(k, stretch), graph.mul(c, rate));
    let tension = graph.add(pull, drag);
    let force = graph.neg(tension);
    acting.work.push(Work { posed: length, free: of_free_bodies, force });
    let (half, square) = (graph.number(0.5), graph.square(stretch));
    acting.elastic = graph.mul_all([half, k, square]);
    let loss = graph.mul(drag, rate);
    acting.damper_power = graph.neg(loss);
    let (stiffened, moved) = (graph.mul_all([half, k_dot, square]), graph.mul(pull, free_dot));
    acting.applied_power = graph.sub(stiffened, moved);
    acting.spring = Some([length, rate, tension, acting.elastic, acting.damper_power]);
    acting
}
