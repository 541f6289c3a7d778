//! Contacts of bodies: the direction of the normal force.

use crate::expr::{ExprId, Graph};
use crate::vocabulary::Function;

/// Added to |x| in the sign x/|x|, so that the sign of 0 is 0 and not NaN.
const SMALLEST: f64 = 1e-30;

/// The normal of a contact: the direction in which the body of the first operand presses on that of the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Contact {
    pub(crate) normal: Normal,
    /// The factor +1 or −1 by which `normal` is multiplied to point to the side of the second body.
    pub(crate) side: ExprId,
    /// Whether the contact also transmits a tangential force, because the bodies roll without slipping.
    pub(crate) sticks: bool,
}

/// How the normal is determined, up to its side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Normal {
    /// The gradient of the first row with respect to the origin of the second body, to be normalised.
    Gradient,
    /// The same gradient, which has length 1.
    UnitGradient,
    /// Perpendicular to the tangent of a curve, on its left; the tangent is minus the column of Φ_q that belongs to
    /// this coordinate, the parameter of the curve.
    LeftOf(u32),
    /// The direction with this angle in the inertial frame.
    Direction(ExprId),
}

impl Contact {
    /// A contact without friction, on the side to which the normal points.
    pub(super) fn smooth(graph: &mut Graph, normal: Normal) -> Self {
        Self { normal, side: graph.number(1.0), sticks: false }
    }
}

/// +1 for a positive length and −1 for a negative one.
pub(super) fn side(graph: &mut Graph, length: ExprId) -> ExprId {
    match graph.literal(length) {
        Some(length) => graph.number(if length < 0.0 { -1.0 } else { 1.0 }),
        None => {
            let (size, least) = (graph.call(Function::Abs, length), graph.number(SMALLEST));
            let size = graph.add(size, least);
            graph.div(length, size)
        }
    }
}
