//! Distances of points in rows, as those between the points of a rope.
//!
//! The gradient of a distance |v| contains the unit vector v/|v|, whose direction has no value where the points coincide,
//! and which turns by up to |∂v/∂xₖ|/|v| per unit of a coordinate xₖ:
//!
//! ```text
//! wₖ² = Σ |∂v/∂xₖ|²/|v|²
//! ```
//!
//! The sum comprises all distances in the rows. If one point moves straight through another, the unit vector does not turn
//! but jumps; nevertheless w grows without bounds towards that place, so that steps of a motion end there. The sum
//! Σ 1/|v|² of every row shows which row it is.

use super::sizes::sum_of_squares;
use crate::constraint::{ConstraintRow, ConstraintSet};
use crate::expr::{ExprId, Graph, Node, total_derivatives};
use crate::vocabulary::Function;
use std::collections::{BTreeMap, BTreeSet};

/// Adds w² of every coordinate on which a distance in the rows depends, except for angles that are iterated, whose limits
/// the determinant of their group shows. Returns Σ 1/|v|² of every row, and nothing if there are no distances.
pub(super) fn add_turns(
    graph: &mut Graph,
    ConstraintSet { rows, distances, .. }: &ConstraintSet,
    iterated_angles: &BTreeSet<u32>,
    squares: &mut BTreeMap<u32, ExprId>,
) -> Vec<ExprId> {
    let mut sizes = BTreeMap::new();
    if distances.is_empty() {
        return Vec::new();
    }
    for id in graph.reachable(rows.iter().map(|row| row.phi)).into_iter().filter(|id| distances.contains(id)) {
        let Node::Call(Function::Sqrt, square) = graph.node(id) else { continue };
        let (mut vector, mut constant) = (Vec::new(), graph.zero());
        if !add_components(graph, square, &mut vector, &mut constant) {
            continue;
        }
        let size = sum_of_squares(graph, &vector);
        let size = graph.add(size, constant);
        let mut changes: BTreeMap<u32, Vec<ExprId>> = BTreeMap::new();
        for jet in total_derivatives(graph, &vector) {
            jet.gradient.iter().for_each(|&(k, entry)| changes.entry(k).or_default().push(entry));
        }
        if !changes.is_empty() {
            sizes.insert(id, size);
        }
        for (k, change) in changes.into_iter().filter(|(k, _)| !iterated_angles.contains(k)) {
            let change = sum_of_squares(graph, &change);
            let turn = graph.div(change, size);
            let sum = squares.get(&k).copied().unwrap_or_else(|| graph.zero());
            squares.insert(k, graph.add(sum, turn));
        }
    }
    if sizes.is_empty() {
        return Vec::new();
    }
    let closeness = |row: &ConstraintRow| {
        let (zero, one) = (graph.zero(), graph.number(1.0));
        let sizes: Vec<ExprId> = graph.reachable([row.phi]).iter().filter_map(|id| sizes.get(id).copied()).collect();
        sizes.into_iter().fold(zero, |sum, size| {
            let share = graph.div(one, size);
            graph.add(sum, share)
        })
    };
    rows.iter().map(closeness).collect()
}

/// Adds the components of v where an expression is |v|², a sum of squares and constants; false where it is not.
fn add_components(graph: &mut Graph, square: ExprId, vector: &mut Vec<ExprId>, constant: &mut ExprId) -> bool {
    match graph.node(square) {
        Node::Add(a, b) => add_components(graph, a, vector, constant) && add_components(graph, b, vector, constant),
        Node::Mul(a, b) if a == b => {
            vector.push(a);
            true
        }
        _ if graph.depends(square).is_static() => {
            *constant = graph.add(*constant, square);
            true
        }
        _ => false,
    }
}
