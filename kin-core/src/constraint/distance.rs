//! Distance: P and Q keep a distance, as if joined by a massless link (revolute–revolute composite).
//!
//! Row (1), in units of length squared:
//! ```text
//! |r_Q − r_P|² − e² = 0
//! ```
//! Singular when P and Q coincide: the gradient of the square vanishes there, so e must not be 0; use a revolute
//! joint for that. Reports the distance. After Haug (1989), section 3.2.

#[cfg(test)]
mod equidistant;

use super::assembly::{Assembly, Rows};
use super::placed::PlacedPoint;
use super::set::Role;
use crate::error::Origin;
use crate::expr::ExprId;
use crate::mechanism::{Formula, Function, Place};

pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, q: &Place, length: &Formula, origin: Origin) -> Rows {
    let (p, q) = (a.place(p), a.place(q));
    let length = a.formula(length);
    between(a, &p, &q, length, origin)
}

/// |r_Q − r_P|² − e².
pub(super) fn between(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint, length: ExprId, origin: Origin) -> Rows {
    // A number only once names are followed and numbers folded; plain ones have their own rule.
    match a.graph.literal(length) {
        Some(0.0) => {
            a.degenerate(
                origin,
                "this length",
                "is 0, whose row has no gradient; points that coincide are joined with `revolute`",
            );
        }
        Some(value) if value < 0.0 => {
            a.degenerate(origin, "this length", format_args!("is {value}; a length is positive"));
        }
        _ => {}
    }
    let mut rows = Rows::between(p, q);
    rows.geometry.push((Role::Value, p.frame, vec![length]));
    let square = square_of_distance(a, p, q);
    let target = a.graph.square(length);
    rows.residuals = vec![("", a.graph.sub(square, target))];
    rows.quantities = vec![("distance", a.graph.call(Function::Sqrt, square))];
    rows
}

/// |r_Q − r_P|.
pub(super) fn length(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint) -> ExprId {
    let square = square_of_distance(a, p, q);
    a.graph.call(Function::Sqrt, square)
}

fn square_of_distance(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint) -> ExprId {
    let d = [a.graph.sub(q.r[0], p.r[0]), a.graph.sub(q.r[1], p.r[1])];
    let (x, y) = (a.graph.square(d[0]), a.graph.square(d[1]));
    a.graph.add(x, y)
}
