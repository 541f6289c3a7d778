//! Gear: two bodies roll on one another with fixed axles, or with axles that a carrier moves.
//!
//! Row (1), in units of length; φ_c = 0 for axles in the ground:
//! ```text
//! R_a(φ_a − φ_c) + R_b(φ_b − φ_c) − e = 0
//! ```
//! External gears have radii of one sign and turn against one another; the ring of an internal pair has the negative
//! one and turns with its pinion. Only the ratio counts, so that numbers of teeth do as well. The row says nothing of
//! the axles: revolute joints on the carrier put them where they belong. Never singular while a radius is not 0; with
//! R_a + R_b = 0 the carrier drops out. After Haug (1989), section 3.3; relative to the carrier it is Willis' equation.

use super::assembly::{Assembly, Rows};
use super::set::{Frame, Role};
use crate::expr::ExprId;
use crate::mechanism::{BodyRef, Formula, Radii};

/// The bodies of a gear pair or of a belt.
#[derive(Clone, Copy)]
pub(super) struct Pair<'m> {
    pub(super) a: &'m BodyRef,
    pub(super) b: &'m BodyRef,
    pub(super) radii: &'m Radii,
    pub(super) carrier: &'m BodyRef,
}

pub(super) fn rows(a: &mut Assembly<'_>, pair: Pair<'_>, offset: &Formula) -> Rows {
    coupled(a, pair, offset, |a, [first, second]| a.graph.add(first, second))
}

/// R_a(φ_a − φ_c) and R_b(φ_b − φ_c), joined by `join`, minus the offset.
pub(super) fn coupled(
    a: &mut Assembly<'_>,
    pair: Pair<'_>,
    offset: &Formula,
    join: impl FnOnce(&mut Assembly<'_>, [ExprId; 2]) -> ExprId,
) -> Rows {
    let [i, j, carrier] = [pair.a, pair.b, pair.carrier].map(|body| a.frame(body));
    let turned = [pair.a, pair.b, pair.carrier].map(|body| a.pose(body)[2]);
    let radii = [&pair.radii.i, &pair.radii.j].map(|radius| a.radius(radius));
    let offset = a.formula(offset);
    let arcs = [0, 1].map(|k| {
        let angle = a.graph.sub(turned[k], turned[2]);
        a.graph.mul(radii[k], angle)
    });
    let whole = join(a, arcs);
    let frame = |frame: Option<Frame>| frame.unwrap_or(Frame::Ground);
    Rows {
        residuals: vec![("", a.graph.sub(whole, offset))],
        geometry: vec![
            (Role::Radius, frame(i), vec![radii[0]]),
            (Role::Radius, frame(j), vec![radii[1]]),
            (Role::Value, frame(carrier), vec![offset]),
        ],
        frames: [i, j],
        ..Rows::default()
    }
}
