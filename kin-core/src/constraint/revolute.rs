//! Revolute joint: P of body i and Q of body j are one point.
//!
//! Rows (2), in the inertial frame, in units of length:
//! ```text
//! x:  x_Q − x_P = 0
//! y:  y_Q − y_P = 0        r = r_i + A_i s′
//! ```
//! Reports the relative angle φ_j − φ_i. Never singular by itself. After Haug (1989), section 3.3.

use super::assembly::{Assembly, Rows};
use crate::expr::ExprId;
use crate::mechanism::Place;

pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, q: &Place) -> Rows {
    let (p, q) = (a.place(p), a.place(q));
    let mut rows = Rows::between(&p, &q);
    rows.residuals = coincidence(a, p.r, q.r);
    rows.quantities = vec![("angle", a.graph.sub(q.angle, p.angle))];
    rows
}

/// r_Q − r_P, two rows.
pub(super) fn coincidence(a: &mut Assembly<'_>, p: [ExprId; 2], q: [ExprId; 2]) -> Vec<(&'static str, ExprId)> {
    vec![("x", a.graph.sub(q[0], p[0])), ("y", a.graph.sub(q[1], p[1]))]
}
