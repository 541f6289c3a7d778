//! How far a group turns when one of the lengths that it is iterated on changes.
//!
//! The steps of a motion are limited by the angle that bodies turn. Where a plan iterates on lengths, as for a platform
//! on three cylinders, bodies may move far without turning. The weight of such a length x converts its change to radians:
//!
//! ```text
//! w² = Σᵢ Σⱼ (∂²fᵢ/∂x∂xⱼ)² / Σⱼ (∂fᵢ/∂xⱼ)²
//! ```
//!
//! Here fᵢ are the residuals of the iteration and xⱼ all its unknowns that are lengths. (∂fᵢ/∂xⱼ) is the normal of the
//! curve on which residual i holds a point, so w bounds the angle by which the normals turn. For a cylinder from a
//! fixed pin, w is one over its length.

use super::closures::LEAST;
use super::tree::{Block, Core, Part, SolutionMethod};
use crate::constraint::{Coordinate, CoordinateKind};
use crate::expr::{ExprId, Graph, Jet, Symbol, total_derivatives};
use crate::mechanism::Component;
use crate::vocabulary::Function;
use std::collections::BTreeMap;

/// The weights of all coordinates at a configuration: 1 for angles, 1/(1 + |q|) for scalar coordinates, whose meaning is
/// unknown, w for lengths that are iterated on, and 0 for other lengths. `None` where w is 0 for all of them.
pub(super) fn weights(graph: &mut Graph, tree: &Block, coordinates: &[Coordinate]) -> Option<Vec<ExprId>> {
    let mut found = BTreeMap::new();
    of_block(graph, tree, coordinates, &mut found);
    if found.is_empty() {
        return None;
    }
    let (zero, one) = (graph.zero(), graph.number(1.0));
    let of = |(k, coordinate): (u32, &Coordinate)| match coordinate.kind {
        CoordinateKind::Pose(_, Component::Phi) => one,
        CoordinateKind::Pose(..) => found.get(&k).copied().unwrap_or(zero),
        CoordinateKind::Scalar => {
            let q = graph.symbol(Symbol::Coordinate(k));
            let size = graph.call(Function::Abs, q);
            let size = graph.add(one, size);
            graph.div(one, size)
        }
    };
    Some((0..).zip(coordinates).map(of).collect())
}

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
    let is_length = |k: u32| core.coordinates.contains(&k) && coordinates[k as usize].kind.is_length();
    let lengths: Vec<u32> = core.coordinates.iter().copied().filter(|&k| is_length(k)).collect();
    let mut turns: BTreeMap<u32, ExprId> = lengths.iter().map(|&k| (k, graph.zero())).collect();
    for jet in total_derivatives(graph, residuals) {
        let normal: Vec<ExprId> = jet.gradient.iter().filter(|(k, _)| is_length(*k)).map(|(_, entry)| *entry).collect();
        let size = sum_of_squares(graph, &normal);
        if graph.is_zero(size) {
            continue;
        }
        let least = graph.number(LEAST);
        let size = graph.add(size, least);
        let changes = total_derivatives(graph, &normal);
        for (k, turn) in &mut turns {
            let by_k = |jet: &Jet| jet.gradient.iter().find(|(of, _)| of == k).map(|(_, entry)| *entry);
            let change: Vec<ExprId> = changes.iter().filter_map(by_k).collect();
            let change = sum_of_squares(graph, &change);
            let share = graph.div(change, size);
            *turn = graph.add(*turn, share);
        }
    }
    for (k, square) in turns {
        if !graph.is_zero(square) {
            found.insert(k, graph.call(Function::Sqrt, square));
        }
    }
}

fn sum_of_squares(graph: &mut Graph, entries: &[ExprId]) -> ExprId {
    let zero = graph.zero();
    entries.iter().fold(zero, |sum, &entry| {
        let square = graph.square(entry);
        graph.add(sum, square)
    })
}
