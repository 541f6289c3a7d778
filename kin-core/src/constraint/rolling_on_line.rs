//! Rolling on a line: a disc of body j, centred at Q, rolls without slipping on a line of body i through P.
//!
//! Rows (2), with u = A_i v̂ and d = r_Q − r_P, in units of length:
//! ```text
//! normal:  perp(u)·d − R = 0
//! roll:    u·d + R(φ_j − φ_i) − e = 0
//! ```
//! A positive radius is a disc to the left of the axis, which turns clockwise where it rolls along the axis; a negative
//! one lies to the right. Differentiated, the second row says that the point of the disc that touches the line has the
//! velocity of the line there. Never singular while R is not 0. Reports the stroke u·d of the centre. After Nikravesh
//! (1988), section 4.2.

use super::assembly::{Assembly, Rows};
use super::set::Role;
use super::translational::{across, along};
use crate::mechanism::{Axis, Formula, Place, Radius};

pub(super) fn rows(a: &mut Assembly<'_>, [p, q]: [&Place; 2], axis: &Axis, radius: &Radius, offset: &Formula) -> Rows {
    let (p, q) = (a.place(p), a.place(q));
    let axis = a.axis(axis, &p);
    let (radius, offset) = (a.radius(radius), a.formula(offset));
    let mut rows = Rows::between(&p, &q);
    rows.geometry.push((Role::Axis, p.frame, axis.local.to_vec()));
    rows.geometry.push((Role::Radius, q.frame, vec![radius]));
    rows.geometry.push((Role::Value, p.frame, vec![offset]));
    let (height, stroke) = (across(a, &axis, &p, &q), along(a, &axis, &p, &q));
    let turn = a.graph.sub(q.angle, p.angle);
    let arc = a.graph.mul(radius, turn);
    let rolled = a.graph.add(stroke, arc);
    rows.residuals = vec![("normal", a.graph.sub(height, radius)), ("roll", a.graph.sub(rolled, offset))];
    rows.quantities = vec![("stroke", stroke)];
    rows
}
