//! Absolute x or y of a point.
//!
//! Row (1), in units of length:
//! ```text
//! x_P − e = 0        or        y_P − e = 0
//! ```
//! After Haug (1989), section 3.2.

use super::assembly::{Assembly, Rows};
use super::set::Role;
use crate::mechanism::{Component, Formula, Place};

pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, component: Component, value: &Formula) -> Rows {
    let p = a.place(p);
    let value = a.formula(value);
    let coordinate = p.r[usize::from(component != Component::X)];
    Rows {
        residuals: vec![("", a.graph.sub(coordinate, value))],
        geometry: vec![(Role::P, p.frame, p.local.to_vec()), (Role::Value, p.frame, vec![value])],
        frames: [Some(p.frame), None],
        ..Rows::default()
    }
}
