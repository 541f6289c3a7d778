//! Knife edge: a point of a body moves along a direction of the body only, as a blade, skate or wheel does.
//!
//! Row (1) of velocity level, with ψ = φ_i + α and u = (cos ψ, sin ψ), in units of velocity:
//! ```text
//! u × ṙ_P = −ẋ_P sin ψ + ẏ_P cos ψ = 0
//! ```
//! α may depend on time: a wheel that is steered. Never singular by itself, for B has the unit vector perp(u) in the
//! columns of a free origin. After Neimark and Fufaev, Dynamics of Nonholonomic Systems (1972), chapter 1.

use super::assembly::{Assembly, Rows};
use super::nonholonomic::{Heading, velocity_row};
use crate::mechanism::{Formula, Place};

pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, angle: &Formula) -> Rows {
    let heading = Heading::of(a, p, angle);
    let velocity = velocity_row(a, |a| {
        let v = heading.velocity(a);
        a.graph.cross(heading.psi, heading.u, v)
    });
    heading.rows(a, angle, velocity)
}
