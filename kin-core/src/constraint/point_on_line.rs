//! Point on a line: Q of body j stays on a line of body i through P, or at a signed offset from it
//! (revolute–translational composite).
//!
//! Row (1), with u = A_i v̂, in units of length; a positive offset is to the left of the axis:
//! ```text
//! perp(u)·(r_Q − r_P) − e = 0
//! ```
//! Reports the stroke u·(r_Q − r_P). After Haug (1989), section 3.3.

use super::assembly::{Assembly, Rows};
use super::set::Role;
use super::translational::{across, along};
use crate::mechanism::{Axis, Formula, Place};

pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, q: &Place, axis: &Axis, offset: &Formula) -> Rows {
    let (p, q) = (a.place(p), a.place(q));
    let axis = a.axis(axis, &p);
    let offset = a.formula(offset);
    let mut rows = Rows::between(&p, &q);
    rows.geometry.push((Role::Axis, p.frame, axis.local.to_vec()));
    rows.geometry.push((Role::Value, p.frame, vec![offset]));
    let normal = across(a, &axis, &p, &q);
    rows.residuals = vec![("", a.graph.sub(normal, offset))];
    rows.quantities = vec![("stroke", along(a, &axis, &p, &q))];
    rows
}
