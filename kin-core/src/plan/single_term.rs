//! How near to 0 the coefficient of a single unknown angle is if it has only one term: the slope f′ of a cam's lift, for
//! example.
//!
//! Whether a sum is nearly 0 is judged by the [sizes](super::sizes) of its terms; for a single term that size is the term
//! itself, which says nothing. Its derivative f″ with respect to the angle does: the dead centre, where f′ = 0, is about
//! f′/f″ away. That is an angle, like the distances of other groups from their limits. For an unknown length or scalar,
//! f′/f″ has a unit, and there is nothing to compare it with.

use super::sizes::is_at_rest_or_coordinate;
use crate::expr::{ExprId, Graph, MAX_ORDER, Node, total_derivatives};
use crate::vocabulary::Function;

/// f″ for a coefficient f′ of one term; `None` for any other one, and where f″ is 0 or needs more derivatives of a function
/// than there are.
pub(super) fn slope_of_single_term(graph: &mut Graph, coefficient: ExprId, angle: u32) -> Option<ExprId> {
    if !is_single_term(graph, coefficient) {
        return None;
    }
    let jet = total_derivatives(graph, &[coefficient]).into_iter().next()?;
    let (_, slope) = jet.gradient.into_iter().find(|(k, _)| *k == angle)?;
    let is_known = |id: &ExprId| !matches!(graph.node(*id), Node::Supplied(_, order, _) if order > MAX_ORDER);
    (!graph.is_zero(slope) && graph.reachable([slope]).iter().all(is_known)).then_some(slope)
}

/// True for products and quotients of coordinates, powers and functions other than sine and cosine, whose size is 1.
fn is_single_term(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) | Node::Div(a, _) => is_single_term(graph, a),
        Node::Mul(a, b) => is_single_term(graph, a) && is_single_term(graph, b),
        // x − c is the position relative to c, which is measured as a whole, as in `squared_size_anywhere`.
        Node::Add(a, b) | Node::Sub(a, b) => [a, b].into_iter().all(|part| is_sum_of_positions(graph, part)),
        Node::RotX(_) | Node::RotY(_) | Node::Dot(_) | Node::Cross(_) => false,
        Node::Call(Function::Sin | Function::Cos, _) => false,
        _ => true,
    }
}

/// True for sums of coordinates and constants.
fn is_sum_of_positions(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) => is_sum_of_positions(graph, a),
        Node::Add(a, b) | Node::Sub(a, b) => is_sum_of_positions(graph, a) && is_sum_of_positions(graph, b),
        _ => is_at_rest_or_coordinate(graph, id),
    }
}
