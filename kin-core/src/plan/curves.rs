//! Curves: functions whose course between two configurations the configurations themselves do not show.
//!
//! Vectors that rotate with a body, and products of lengths with them, change no faster than the body turns, and the
//! steps of a motion are limited by the turns of bodies. A function of a coordinate, of time or of an input may rise and
//! fall between two places at which it has the same value and the same rates, as sin³(8θ) does between θ = 0 and θ = π/8.

use super::tree::{Block, Core, Part, SolutionMethod};
use crate::constraint::ConstraintRow;
use crate::expr::{Depends, ExprId, Graph, Node, Symbol};
use std::collections::BTreeSet;

/// True if an expression depends on what `varies` in another way than by sums, products and rotated vectors.
fn curves_with(
    graph: &Graph,
    expressions: impl IntoIterator<Item = ExprId>,
    mut varies: impl FnMut(ExprId) -> bool,
) -> bool {
    graph.reachable(expressions).into_iter().any(|id| match graph.node(id) {
        Node::Call(_, a) | Node::Supplied(_, _, a) | Node::Powf(a, _) => varies(a),
        Node::Powi(a, n) => n.abs() > 2 && varies(a),
        Node::Div(_, b) => varies(b),
        Node::Atan2(y, x) => varies(y) || varies(x),
        _ => false,
    })
}

/// True if an expression has curves over coordinates.
pub(super) fn has_curves(graph: &Graph, expressions: &[ExprId]) -> bool {
    curves_with(graph, expressions.iter().copied(), |id| graph.depends(id).on(Depends::COORDINATE))
}

/// True if the plan iterates on rows with curves.
pub(super) fn iterates_on_curves(graph: &Graph, block: &Block) -> bool {
    any_core(block, &mut |core| match &core.method {
        SolutionMethod::Newton { residuals } => has_curves(graph, residuals),
        _ => false,
    })
}

/// True if a row contains a curve over time, over an input, or over a coordinate for which the plan does not iterate on
/// that row. `sources` are the rows that each row of the plan combines; without a plan no row is iterated.
pub(super) fn known_values_curve(
    graph: &Graph,
    rows: &[ConstraintRow],
    plan: Option<(&Block, &[BTreeSet<usize>])>,
) -> bool {
    let (mut iterated, mut found) = (BTreeSet::new(), false);
    if let Some((tree, sources)) = plan {
        any_core(tree, &mut |core| {
            if let SolutionMethod::Newton { residuals } = &core.method {
                iterated.extend(core.rows.iter().flat_map(|&row| &sources[row]).copied());
                found |= curves_with(graph, residuals.iter().copied(), |id| depends_on_known(graph, id, core));
            }
            found
        });
    }
    let varies = |id: ExprId| graph.depends(id).on(RHEONOMIC.or(Depends::COORDINATE));
    let closed = rows.iter().enumerate().filter(|(row, _)| !iterated.contains(row)).map(|(_, row)| row.phi);
    found || curves_with(graph, closed, varies)
}

const RHEONOMIC: Depends = Depends::TIME.or(Depends::INPUT);

/// True if an expression depends on time, on an input, or on a coordinate that the core does not give.
fn depends_on_known(graph: &Graph, id: ExprId, core: &Core) -> bool {
    let is_known =
        |id: ExprId| matches!(graph.node(id), Node::Symbol(Symbol::Coordinate(k)) if !core.coordinates.contains(&k));
    graph.depends(id).on(RHEONOMIC) || graph.reachable([id]).into_iter().any(is_known)
}

/// True if the condition holds for a core of the block.
fn any_core(block: &Block, condition: &mut dyn FnMut(&Core) -> bool) -> bool {
    block.parts.iter().any(|part| match part {
        Part::Core(core) => condition(core),
        Part::Block(block) => any_core(block, condition),
        Part::Pair(pair) => any_core(&pair.inner, condition),
    })
}
