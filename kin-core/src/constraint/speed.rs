//! Speed: the velocity of a point of a body along a direction of the body is prescribed. It drives.
//!
//! Row (1) of velocity level, with ψ = φ_i + α and u = (cos ψ, sin ψ), in units of velocity:
//! ```text
//! u · ṙ_P − f = ẋ_P cos ψ + ẏ_P sin ψ − f = 0
//! ```
//! Says nothing of the velocity across u: see `knife_edge` for that.

use super::assembly::{Assembly, Rows};
use super::nonholonomic::{Heading, velocity_row};
use super::set::Role;
use crate::mechanism::{Formula, Place};

pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, angle: &Formula, value: &Formula) -> Rows {
    let heading = Heading::of(a, p, angle);
    let value = a.formula(value);
    let velocity = velocity_row(a, |a| {
        let v = heading.velocity(a);
        let along = a.graph.dot(heading.psi, heading.u, v);
        a.graph.sub(along, value)
    });
    let mut rows = heading.rows(a, angle, velocity);
    rows.geometry.push((Role::Value, heading.p.frame, vec![value]));
    rows
}
