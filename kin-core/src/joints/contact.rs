//! Where bodies touch: in which direction one presses on the other.

use crate::expr::{ExprId, Graph};
use crate::vocabulary::Function;

/// What the sign of a length may be divided by besides its size, so that of 0 there is a number, too.
const SMALLEST: f64 = 1e-30;

/// The normal of a contact, from the body of the first operand to that of the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Contact {
    pub(crate) normal: Normal,
    /// +1 or −1 for its side.
    pub(crate) side: ExprId,
    /// Whether the contact also carries a force along the line or disc that it lies on, as where nothing slips.
    pub(crate) sticks: bool,
}

/// How a normal is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Normal {
    /// The gradient of the first row by the place of the second body.
    Gradient,
    /// The same, which is of length 1.
    UnitGradient,
    /// To the left of the tangent along which a coordinate moves the rows.
    LeftOf(u32),
    /// The direction of an angle in the inertial frame.
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
