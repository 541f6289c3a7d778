//! Which scalar coordinates scale as lengths do, so that they can share the scale of lengths.

use super::set::{ConstraintSet, CoordinateKind};
use crate::expr::{ExprId, IdMap, Node, Symbol};
use crate::vocabulary::Function;

/// Marks the scalars that scale as lengths do: those that no function of the rows has in its argument, and no rotation.
pub(crate) fn mark_scalars(set: &mut ConstraintSet) {
    let graph = &set.graph;
    let mut is_argument = vec![false; set.coordinates.len()];
    // True for expressions inside of an argument; an expression may be visited first outside of one, then inside.
    let mut visited: IdMap<bool> = IdMap::default();
    let roots = set.rows.iter().flat_map(|row| [Some(row.phi), row.velocity.map(|velocity| velocity.eta)]);
    let mut open: Vec<(ExprId, bool)> = roots.flatten().map(|root| (root, false)).collect();
    while let Some((id, inside)) = open.pop() {
        if visited.get(id).is_some_and(|before| *before || !inside) {
            continue;
        }
        visited.insert(id, inside);
        let node = graph.node(id);
        let angle = match node {
            Node::RotX(rotation) | Node::RotY(rotation) => Some(rotation.angle),
            Node::Dot(turning) | Node::Cross(turning) => Some(turning.angle),
            _ => None,
        };
        let is_function = match node {
            Node::Symbol(Symbol::Coordinate(k)) => {
                if let Some(is_argument) = is_argument.get_mut(k as usize) {
                    *is_argument |= inside;
                }
                false
            }
            Node::Call(function, _) => !matches!(function, Function::Sqrt | Function::Abs),
            Node::Supplied(..) => true,
            _ => false,
        };
        node.for_each_operand(|operand| open.push((operand, inside || is_function || angle == Some(operand))));
    }
    for (coordinate, is_argument) in set.coordinates.iter_mut().zip(is_argument) {
        coordinate.scales_with_length |= coordinate.kind == CoordinateKind::Scalar && !is_argument;
    }
}
