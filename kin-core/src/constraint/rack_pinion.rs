//! Rack and pinion: a pinion whose axle the guide carries moves a rack along the guide.
//!
//! Row (1), with u = A_i v̂ of the guide i and φ_b of the pinion, in units of length:
//! ```text
//! u·(r_Q − r_P) − R(φ_b − φ_i) − e = 0
//! ```
//! Where the pinion turns counter-clockwise, a positive radius moves the rack along the axis: it meshes to the right of
//! the axle, looking along the axis. A rack to the left has a negative radius. A translational joint keeps the rack on
//! its guide, and a revolute joint the pinion on its axle. Never singular while R is not 0. Reports the stroke
//! u·(r_Q − r_P). After Haug (1989), section 3.3.

use super::assembly::{Assembly, Rows};
use super::set::{Frame, Role};
use super::translational::along;
use crate::mechanism::{Axis, BodyRef, Formula, Place, Radius};

pub(super) fn rows(
    a: &mut Assembly<'_>,
    [p, q]: [&Place; 2],
    axis: &Axis,
    (pinion, radius): (&BodyRef, &Radius),
    offset: &Formula,
) -> Rows {
    let (p, q) = (a.place(p), a.place(q));
    let axis = a.axis(axis, &p);
    let (wheel, turned) = (a.frame(pinion).unwrap_or(Frame::Ground), a.pose(pinion)[2]);
    let (radius, offset) = (a.radius(radius), a.formula(offset));
    let mut rows = Rows::between(&p, &q);
    rows.geometry.push((Role::Axis, p.frame, axis.local.to_vec()));
    rows.geometry.push((Role::Radius, wheel, vec![radius]));
    rows.geometry.push((Role::Value, p.frame, vec![offset]));
    let stroke = along(a, &axis, &p, &q);
    let angle = a.graph.sub(turned, p.angle);
    let arc = a.graph.mul(radius, angle);
    let whole = a.graph.sub(stroke, arc);
    rows.residuals = vec![("", a.graph.sub(whole, offset))];
    rows.quantities = vec![("stroke", stroke)];
    rows
}
