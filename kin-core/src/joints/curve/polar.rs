//! A point on a curve in polar form: Q of body j is at the distance ρ(θ) from P of body i, in the direction θ of body
//! i.
//!
//! Row (1), a length:
//! ```text
//! |w| − ρ(θ) = 0,   w = A_iᵀ(r_Q − r_P),   θ = atan2(w_y, w_x)
//! ```
//! |w| equals |r_Q − r_P|, which does not depend on the rotation. θ is in (−π, π] and jumps by 2π when Q crosses the
//! negative x axis of body i; since ρ is 2π-periodic, the row is continuous. Singular at w = 0, where θ is undefined;
//! there is no contact where ρ is not positive. After Haug (1989), section 3.4 (cam with a point follower).

use super::relative::{draw, in_theta, seen};
use crate::constraint::{Assembly, JointRows, PlacedPoint, RowMeaning};
use crate::error::Origin;
use crate::expr::Symbol;
use crate::mechanism::Formula;

pub(super) fn rows(
    a: &mut Assembly<'_>,
    p: &PlacedPoint,
    q: &PlacedPoint,
    radius: &Formula,
    origin: Origin,
) -> JointRows {
    let mut rows = JointRows::between(p, q);
    let distance = a.distance(p, q);
    let [x, y] = seen(a, p, q);
    let theta = a.graph.atan2(y, x);
    let s = a.graph.symbol(Symbol::ARGUMENT);
    let (rho, cos, sin) = (in_theta(a, radius, s), a.graph.cos(s), a.graph.sin(s));
    // Literal radii have been checked by a rule before; here the radius may become a number by constant folding.
    if let Some(value) = a.graph.literal(rho).filter(|value| *value <= 0.0) {
        a.degenerate(origin, "this polar radius", format_args!("is {value} everywhere; it is positive"));
    }
    let drawn = [a.graph.mul(rho, cos), a.graph.mul(rho, sin)];
    draw(a, p, drawn);
    let radius = in_theta(a, radius, theta);
    rows.residuals = vec![("", RowMeaning::Other, a.graph.sub(distance, radius))];
    rows.quantities = vec![("distance", distance)];
    rows
}
