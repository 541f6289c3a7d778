//! How fast the gradients of the rows of a group turn as a coordinate changes.
//!
//! The steps of a motion are limited by the angle that bodies turn. Where a plan solves for lengths or for scalar
//! coordinates, by iteration or in closed form, bodies may move far without turning, and on a wavy curve the direction of
//! contact turns faster than the bodies. The factor w of such a coordinate converts its change to radians:
//!
//! ```text
//! w² = Σᵢ 1/ρᵢ²,   ρᵢ² = Σ_u Dᵢᵤ/Nᵢᵤ
//! Dᵢᵤ = Σⱼ (∂fᵢ/∂xⱼ)²,   Nᵢᵤ = Σₖ Σⱼ (∂²fᵢ/∂xₖ∂xⱼ)²
//! ```
//!
//! Here fᵢ are the residuals of an iteration, or the rows of a closed form none of whose unknowns is an angle; k counts
//! the coordinates of the kind for which w is computed, j the unknowns of a kind u (kinds are lengths, angles, and every
//! scalar by itself), so that ρ has the unit of xₖ whatever the other units are. The gradient of fᵢ turns by about 1/ρᵢ
//! per unit of xₖ. For a cylinder from a fixed pin ρ is of the order of its length; for a single unknown 1/ρ is |f″/f′|,
//! so that steps become shorter towards a limit. The sum over u comprises the kinds that occur in fᵢ; if Nᵢᵤ is
//! identically 0 for one of them, ρᵢ is infinite and the row does not count. Where there is a curve or a closed form,
//! coordinates that other steps of the plan give have such a factor, too: a cam that is driven turns the gradient of its
//! contact, and a carriage that of a link. If a coordinate occurs in several groups, their squares are added.

use super::curves::has_curves;
use super::distances::add_turns;
use super::sizes::DENOMINATOR_FLOOR;
use super::sizes::sum_of_squares;
use super::tree::{Block, BlockPart, Core, SolutionMethod};
use crate::constraint::{ConstraintSet, Coordinate, CoordinateKind};
use crate::expr::{ExprId, Graph, Jet, Symbol, total_derivatives};
use crate::mechanism::Component;
use crate::vocabulary::Function;
use std::collections::{BTreeMap, BTreeSet};

/// Kinds of unknowns by their unit; the unit of a scalar is not known, so every scalar is a kind by itself.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum UnitOfUnknown {
    Length,
    Angle,
    Scalar(u32),
}

/// How the gradients of rows turn.
pub(super) struct GradientTurns {
    /// w of every coordinate; empty where it is 0 for all of them.
    pub(super) by_coordinates: Vec<ExprId>,
    /// See [`SolutionPlan::looks_within`](super::SolutionPlan::looks_within).
    pub(super) looks_within: bool,
    /// See [`SolutionPlan::closeness`](super::SolutionPlan::closeness).
    pub(super) closeness: Vec<ExprId>,
}

/// What the cores of a plan give.
#[derive(Default)]
struct Found {
    /// w² of the coordinates that turn gradients.
    squares: BTreeMap<u32, ExprId>,
    /// Whether gradients of a closed form turn with time or with an input, or with a coordinate.
    by_time: bool,
    by_coordinate: bool,
    iterates: bool,
    /// The angles for which the plan iterates.
    iterated_angles: BTreeSet<u32>,
}

/// w of all coordinates at a configuration. It is 0 for coordinates that turn no gradient, and for angles unless the group
/// has a curve or they move the points of a distance (see [`distances`](super::distances)).
pub(super) fn turns(graph: &mut Graph, tree: &Block, set: &ConstraintSet) -> GradientTurns {
    let (mut found, coordinates) = (Found::default(), &set.coordinates);
    of_block(graph, tree, coordinates, &mut found);
    let Found { mut squares, by_time, by_coordinate, iterates, iterated_angles } = found;
    let closeness = add_turns(graph, set, &iterated_angles, &mut squares);
    let zero = graph.zero();
    let turn = |(k, _): (u32, &Coordinate)| squares.get(&k).map_or(zero, |&square| graph.call(Function::Sqrt, square));
    let by_coordinates = if squares.is_empty() { Vec::new() } else { (0..).zip(coordinates).map(turn).collect() };
    GradientTurns { by_coordinates, looks_within: by_time || by_coordinate && iterates, closeness }
}

const fn unit(k: u32, coordinate: &Coordinate) -> UnitOfUnknown {
    match coordinate.kind {
        CoordinateKind::Pose(_, Component::Phi) => UnitOfUnknown::Angle,
        CoordinateKind::Pose(..) => UnitOfUnknown::Length,
        CoordinateKind::Scalar => UnitOfUnknown::Scalar(k),
    }
}

/// Adds w² of the coordinates of a block.
fn of_block(graph: &mut Graph, block: &Block, coordinates: &[Coordinate], found: &mut Found) {
    for part in &block.parts {
        match part {
            BlockPart::Core(core) => of_core(graph, core, coordinates, found),
            BlockPart::Block(block) => of_block(graph, block, coordinates, found),
            BlockPart::Pair(pair) => of_block(graph, &pair.inner, coordinates, found),
        }
    }
}

fn of_core(graph: &mut Graph, core: &Core, coordinates: &[Coordinate], found: &mut Found) {
    if let SolutionMethod::Newton { .. } = core.method {
        let is_angle = |k: &u32| unit(*k, &coordinates[*k as usize]) == UnitOfUnknown::Angle;
        found.iterated_angles.extend(core.coordinates.iter().copied().filter(is_angle));
    }
    let Some(TurningRows { residuals, known: with_known, curves }) = rows(graph, core, coordinates) else { return };
    let (residuals, is_closed) = (&residuals, !matches!(core.method, SolutionMethod::Newton { .. }));
    let jets = total_derivatives(graph, residuals);
    let is_unknown = |k: &u32| core.coordinates.contains(k);
    found.iterates |= !is_closed;
    let mut known: Vec<u32> = jets.iter().flat_map(|jet| &jet.gradient).map(|(k, _)| *k).collect();
    known.retain(|k| with_known && !is_unknown(k));
    known.sort_unstable();
    known.dedup();
    let mut members: BTreeMap<(bool, UnitOfUnknown), Vec<u32>> = BTreeMap::new();
    for k in core.coordinates.iter().copied().chain(known) {
        members.entry((is_unknown(&k), unit(k, &coordinates[k as usize]))).or_default().push(k);
    }
    let mut squares: BTreeMap<(bool, UnitOfUnknown), ExprId> = BTreeMap::new();
    for jet in jets {
        let mut gradient: BTreeMap<UnitOfUnknown, Vec<ExprId>> = BTreeMap::new();
        for &(k, entry) in jet.gradient.iter().filter(|(k, entry)| is_unknown(k) && !graph.is_zero(*entry)) {
            gradient.entry(unit(k, &coordinates[k as usize])).or_default().push(entry);
        }
        let with_time = |entry: &ExprId| graph.depends(*entry).is_rheonomic();
        found.by_time |= is_closed && gradient.values().flatten().any(with_time);
        let changes: Vec<(Vec<ExprId>, Vec<Jet>)> =
            gradient.into_values().map(|entries| (entries.clone(), total_derivatives(graph, &entries))).collect();
        for (&group, members) in members.iter().filter(|((_, unit), _)| *unit != UnitOfUnknown::Angle || curves) {
            if let Some(share) = turn(graph, &changes, members) {
                found.by_coordinate |= is_closed;
                let sum = squares.get(&group).copied().unwrap_or_else(|| graph.zero());
                squares.insert(group, graph.add(sum, share));
            }
        }
    }
    for (group, square) in squares {
        for &k in &members[&group] {
            let sum = found.squares.get(&k).copied().unwrap_or_else(|| graph.zero());
            found.squares.insert(k, graph.add(sum, square));
        }
    }
}

/// The rows of a core whose gradients may turn although no body does.
struct TurningRows {
    residuals: Vec<ExprId>,
    /// Whether they also turn with coordinates that other steps give.
    known: bool,
    curves: bool,
}

/// The rows of an iteration, and those of a closed form without an unknown angle; `None` for any other core.
fn rows(graph: &mut Graph, core: &Core, coordinates: &[Coordinate]) -> Option<TurningRows> {
    if let SolutionMethod::Newton { residuals } = &core.method {
        let curves = has_curves(graph, residuals);
        return Some(TurningRows { residuals: residuals.clone(), known: curves, curves });
    }
    if core.coordinates.iter().any(|&k| unit(k, &coordinates[k as usize]) == UnitOfUnknown::Angle) {
        return None;
    }
    let unknowns: Vec<ExprId> = core.coordinates.iter().map(|&k| graph.symbol(Symbol::Coordinate(k))).collect();
    let zero = graph.zero();
    let residuals = match &core.method {
        SolutionMethod::Linear { matrix, constant } => {
            let rows = matrix.iter().zip(constant);
            rows.map(|(row, &constant)| sum_of_products(graph, row, &unknowns, constant)).collect()
        }
        &SolutionMethod::Quadratic { a, b, c } => {
            let slope = sum_of_products(graph, &[a], &unknowns, b);
            vec![sum_of_products(graph, &[slope], &unknowns, c)]
        }
        SolutionMethod::Circle { e, l, k, n, m, .. } => {
            let line = sum_of_products(graph, n, &unknowns, *m);
            let inside = sum_of_products(graph, l, &unknowns, *k);
            let square = sum_of_products(graph, &unknowns, &unknowns, zero);
            let square = graph.mul(*e, square);
            vec![graph.add(square, inside), line]
        }
        SolutionMethod::Angle { .. } | SolutionMethod::Newton { .. } => return None,
    };
    Some(TurningRows { residuals, known: true, curves: false })
}

/// Σ aᵢ bᵢ + constant.
fn sum_of_products(graph: &mut Graph, a: &[ExprId], b: &[ExprId], constant: ExprId) -> ExprId {
    a.iter().zip(b).fold(constant, |sum, (&a, &b)| {
        let product = graph.mul(a, b);
        graph.add(sum, product)
    })
}

/// 1/ρ² of a row for the unknowns `by`; `None` where the row does not count. The row is given by the entries of its
/// gradient, unit by unit, with their derivatives.
fn turn(graph: &mut Graph, gradient: &[(Vec<ExprId>, Vec<Jet>)], by: &[u32]) -> Option<ExprId> {
    let least = graph.number(DENOMINATOR_FLOOR);
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
