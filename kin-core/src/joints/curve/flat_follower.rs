//! Flat-faced follower on a cam: the straight face of body j touches a convex cam of body i, given by its support
//! function h(θ): the distance from P of the tangent whose outward normal has the direction θ in body i.
//!
//! Row (1), a length:
//! ```text
//! n·(r_Q − r_P) − h(θ) = 0,   n = perp(A_j v̂),   θ = φ_j + arg(perp v̂) − φ_i
//!
//!      ═══●═══════════ face of j, along A_j v̂       Q is any point of the face,
//!         Q     ╷                                   n points from the cam to the face:
//!               │ h(θ)                              v is chosen so that the cam
//!               ●───▶ θ = 0, x axis of i            lies to the right of it.
//!               P
//! ```
//! The tangent with the normal n has the distance h from P for any contact point, so a single row expresses both
//! contact and tangency. θ is linear in φ_j − φ_i and not reduced modulo 2π. A circle around P has h = r; a circle
//! with its centre at (e, 0) has h = r + e cos θ. The contact point is at h n + h′ perp(n) from P, and h + h″ > 0 is
//! the cam's radius of curvature. After Santaló, *Integral Geometry and Geometric Probability*, chapter 1 (support
//! functions), and Norton, *Cam Design and Manufacturing Handbook* (flat-faced followers).

use super::relative::{draw, in_theta};
use crate::constraint::{Assembly, JointRows, PlacedAxis, RowMeaning};
use crate::expr::{ExprId, Symbol, partial};
use crate::joints::contact::{Contact, Normal};
use crate::joints::joint::{JointType, joint};
use crate::mechanism::{Axis, Formula, OperandSlot, OperandType, Place};
use crate::vocabulary::Role;

joint! {
    /// Operands of a flat-faced follower on a cam.
    FlatFollower {
        /// The point P of body i, the centre of the support function.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of body j, on its face.
        q: Place = OperandSlot::frame("q"),
        /// The direction v of the face in body j.
        axis: Axis = OperandSlot::option("axis", OperandType::Axis),
        /// The support function h.
        support: Formula = OperandSlot::option("support", OperandType::Support),
    }
    example: "#[flat_follower(A: cam @ (0, 0), follower @ (0, 0), axis = (1, 0), support(theta) = r + e*cos(theta))]"
}

impl JointType for FlatFollower {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        let axis = a.axis(&self.axis, &q);
        let mut rows = JointRows::between(&p, &q);
        rows.geometry.push((Role::Axis, q.frame, axis.local.to_vec()));
        // perp(u)·(r_Q − r_j) is the constant perp(v̂)·s′_Q.
        let d = [a.graph.sub(q.base[0], p.r[0]), a.graph.sub(q.base[1], p.r[1])];
        let (moving, constant) = (a.graph.cross(axis.angle, axis.u, d), a.graph.plain_cross(axis.local, q.local));
        let lift = a.graph.add(moving, constant);
        let turn = a.graph.sub(q.angle, p.angle);
        let direction = direction(a, &axis);
        let theta = a.graph.add(turn, direction);
        // The contact point h n + h′ perp(n).
        let s = a.graph.symbol(Symbol::ARGUMENT);
        let h = in_theta(a, &self.support, s);
        let [slope] = partial(&mut a.graph, [h], Symbol::ARGUMENT);
        let (cos, sin) = (a.graph.cos(s), a.graph.sin(s));
        let minus_sin = a.graph.neg(sin);
        let contact = [[cos, minus_sin], [sin, cos]].map(|row| a.graph.plain_dot([h, slope], row));
        draw(a, &p, contact);
        let support = in_theta(a, &self.support, theta);
        rows.residuals = vec![("", RowMeaning::Other, a.graph.sub(lift, support))];
        rows.quantities = vec![("theta", theta)];
        rows
    }

    /// The cam presses the face along n.
    fn contact(&self, a: &mut Assembly<'_>) -> Option<Contact> {
        Some(Contact::smooth(&mut a.graph, Normal::UnitGradient))
    }
}

/// The angle of perp(v̂) in body j, in (−π, π].
fn direction(a: &mut Assembly<'_>, axis: &PlacedAxis) -> ExprId {
    let [x, y] = axis.local;
    let minus_y = a.graph.neg(y);
    match (a.graph.literal(x), a.graph.literal(minus_y)) {
        // The literal pair never contains −0, which would turn π into −π.
        (Some(x), Some(minus_y)) => a.graph.number(x.atan2(minus_y)),
        _ => a.graph.atan2(x, minus_y),
    }
}
