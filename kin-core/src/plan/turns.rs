//! How fast the gradients of the rows of a group turn as one of its unknowns changes.
//!
//! The steps of a motion are limited by the angle that bodies turn. Where a plan iterates on lengths or on scalar
//! coordinates, bodies may move far without turning, and on a wavy curve the direction of contact turns faster than the
//! bodies. The factor w of such an unknown converts its change to radians:
//!
//! ```text
//! w² = Σᵢ 1/ρᵢ²,   ρᵢ² = Σ_u Dᵢᵤ/Nᵢᵤ
//! Dᵢᵤ = Σⱼ (∂fᵢ/∂xⱼ)²,   Nᵢᵤ = Σₖ Σⱼ (∂²fᵢ/∂xₖ∂xⱼ)²
//! ```
//!
//! Here fᵢ are the residuals of the iteration, k counts the coordinates of the kind for which w is computed, j the unknowns
//! of a kind u (kinds are lengths, angles, and every scalar by itself), so that ρ has the unit of xₖ whatever the other
//! units are. The gradient of fᵢ turns by about 1/ρᵢ per unit of xₖ. For a cylinder from a fixed pin ρ is of the order
//! of its length; for a single unknown 1/ρ is |f″/f′|, so that steps become shorter towards a limit. The sum over u
//! comprises the kinds that occur in fᵢ; if Nᵢᵤ is identically 0 for one of them, ρᵢ is infinite and the row does not
//! count. Where there is a curve, coordinates that other steps of the plan give have such a factor, too: a cam that
//! is driven turns the gradient of its contact. If a coordinate occurs in several groups, their squares are added.

use super::closures::LEAST;
use super::tree::{Block, Core, Part, SolutionMethod};
use crate::constraint::{Coordinate, CoordinateKind};
use crate::expr::{Depends, ExprId, Graph, Jet, Node, total_derivatives};
use crate::mechanism::Component;
use crate::vocabulary::Function;
use std::collections::BTreeMap;

/// Kinds of unknowns by their unit; the unit of a scalar is not known, so every scalar is a kind by itself.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Unit {
    Length,
    Angle,
    Scalar(u32),
}

/// w of all coordinates at a configuration. It is 0 for coordinates that do not occur in an iteration, and for angles
/// unless the group has a curve; empty where it is 0 for all coordinates.
pub(super) fn turns(graph: &mut Graph, tree: &Block, coordinates: &[Coordinate]) -> Vec<ExprId> {
    let mut squares = BTreeMap::new();
    of_block(graph, tree, coordinates, &mut squares);
    if squares.is_empty() {
        return Vec::new();
    }
    let zero = graph.zero();
    let of = |(k, _): (u32, &Coordinate)| squares.get(&k).map_or(zero, |&square| graph.call(Function::Sqrt, square));
    (0..).zip(coordinates).map(of).collect()
}

const fn unit(k: u32, coordinate: &Coordinate) -> Unit {
    match coordinate.kind {
        CoordinateKind::Pose(_, Component::Phi) => Unit::Angle,
        CoordinateKind::Pose(..) => Unit::Length,
        CoordinateKind::Scalar => Unit::Scalar(k),
    }
}

/// True if the plan iterates on rows with curves.
pub(super) fn iterates_on_curves(graph: &Graph, block: &Block) -> bool {
    block.parts.iter().any(|part| match part {
        Part::Core(Core { method: SolutionMethod::Newton { residuals }, .. }) => has_curves(graph, residuals),
        Part::Core(_) => false,
        Part::Block(block) => iterates_on_curves(graph, block),
        Part::Pair(pair) => iterates_on_curves(graph, &pair.inner),
    })
}

/// Adds w² of the coordinates of a block.
fn of_block(graph: &mut Graph, block: &Block, coordinates: &[Coordinate], found: &mut BTreeMap<u32, ExprId>) {
    for part in &block.parts {
        match part {
            Part::Core(core) => of_core(graph, core, coordinates, found),
            Part::Block(block) => of_block(graph, block, coordinates, found),
            Part::Pair(pair) => of_block(graph, &pair.inner, coordinates, found),
        }
    }
}

fn of_core(graph: &mut Graph, core: &Core, coordinates: &[Coordinate], found: &mut BTreeMap<u32, ExprId>) {
    let SolutionMethod::Newton { residuals } = &core.method else { return };
    let curves = has_curves(graph, residuals);
    let jets = total_derivatives(graph, residuals);
    let is_unknown = |k: &u32| core.coordinates.contains(k);
    let mut known: Vec<u32> = jets.iter().flat_map(|jet| &jet.gradient).map(|(k, _)| *k).collect();
    known.retain(|k| curves && !is_unknown(k));
    known.sort_unstable();
    known.dedup();
    let mut members: BTreeMap<(bool, Unit), Vec<u32>> = BTreeMap::new();
    for k in core.coordinates.iter().copied().chain(known) {
        members.entry((is_unknown(&k), unit(k, &coordinates[k as usize]))).or_default().push(k);
    }
    let mut squares: BTreeMap<(bool, Unit), ExprId> = BTreeMap::new();
    for jet in jets {
        let mut gradient: BTreeMap<Unit, Vec<ExprId>> = BTreeMap::new();
        for &(k, entry) in jet.gradient.iter().filter(|(k, entry)| is_unknown(k) && !graph.is_zero(*entry)) {
            gradient.entry(unit(k, &coordinates[k as usize])).or_default().push(entry);
        }
        let changes: Vec<(Vec<ExprId>, Vec<Jet>)> =
            gradient.into_values().map(|entries| (entries.clone(), total_derivatives(graph, &entries))).collect();
        for (&of, members) in members.iter().filter(|((_, unit), _)| *unit != Unit::Angle || curves) {
            if let Some(share) = turn(graph, &changes, members) {
                let sum = squares.get(&of).copied().unwrap_or_else(|| graph.zero());
                squares.insert(of, graph.add(sum, share));
            }
        }
    }
    for (of, square) in squares {
        for &k in &members[&of] {
            let sum = found.get(&k).copied().unwrap_or_else(|| graph.zero());
            found.insert(k, graph.add(sum, square));
        }
    }
}

/// True if a residual depends on coordinates in another way than by products of lengths and rotated vectors, whose
/// gradients turn no faster than the bodies.
fn has_curves(graph: &Graph, residuals: &[ExprId]) -> bool {
    let varies = |id: ExprId| graph.depends(id).on(Depends::COORDINATE);
    graph.reachable(residuals.iter().copied()).into_iter().any(|id| match graph.node(id) {
        Node::Call(_, a) | Node::Supplied(_, _, a) | Node::Powf(a, _) => varies(a),
        Node::Powi(a, n) => n.abs() > 2 && varies(a),
        Node::Div(_, b) => varies(b),
        Node::Atan2(y, x) => varies(y) || varies(x),
        _ => false,
    })
}

/// 1/ρ² of a row for the unknowns `by`; `None` where the row does not count. The row is given by the entries of its
/// gradient, unit by unit, with their derivatives.
fn turn(graph: &mut Graph, gradient: &[(Vec<ExprId>, Vec<Jet>)], by: &[u32]) -> Option<ExprId> {
    let least = graph.number(LEAST);
    let mut radius = graph.zero();
    for (entries, changes) in gradient {
        let by_members = changes.iter().flat_map(|jet| &jet.gradient).filter(|(k, _)| by.contains(k));
        let change: Vec<ExprId> = by_members.map(|(_, entry)| *entry).collect();
        let (size, change) = (sum_of_squares(graph, entries), sum_of_squares(graph, &change));
        if graph.is_zero(change) {
            return None;
        }
        let change = graph.add(change, least);
        let square = graph.div(size, change);
        radius = graph.add(radius, square);
    }
    let radius = graph.add(radius, least);
    let one = graph.number(1.0);
    Some(graph.div(one, radius))
}

/// Σ |e|². Over boxes, the square of an absolute value is never negative, while the product e·e of an interval around 0 is.
fn sum_of_squares(graph: &mut Graph, entries: &[ExprId]) -> ExprId {
    let zero = graph.zero();
    entries.iter().fold(zero, |sum, &entry| {
        let size = graph.call(Function::Abs, entry);
        let square = graph.square(size);
        graph.add(sum, square)
    })
}
