//! Scales of the columns of a small matrix, so that its margin does not depend on the units of its unknowns.
//!
//! Angles of bodies are in radians and have the scale 1. All lengths have one scale, the length of an arm: over the rows
//! that contain both kinds, the entries of lengths become as large as those of angles. Scalars may have any unit, the
//! parameter of a curve for example: each has a scale of its own, taken from the sizes that its entries have at any
//! configuration, since the column of a single unknown may vanish where the mechanism is at its limit.

use super::sizes::{DENOMINATOR_FLOOR, squared_size_anywhere};
use crate::expr::{ExprId, Graph};
use crate::vocabulary::UnknownKind;

/// Depth to which the terms of an entry are examined.
const DEPTH: usize = 8;

/// The square of the factor of every column; `None` for 1.
pub(super) fn squared_scales(graph: &mut Graph, matrix: &[Vec<ExprId>], kinds: &[UnknownKind]) -> Vec<Option<ExprId>> {
    let columns = |wanted: UnknownKind| -> Vec<usize> {
        kinds.iter().enumerate().filter(|(_, kind)| **kind == wanted).map(|(column, _)| column).collect()
    };
    let [angles, lengths, scalars] = [UnknownKind::Angle, UnknownKind::Length, UnknownKind::Scalar].map(columns);
    let mut scales = vec![None; kinds.len()];
    if let Some(unit) = ratio(graph, matrix, [&angles, &lengths], &scales) {
        lengths.iter().for_each(|&column| scales[column] = Some(unit));
    }
    // Scalars are compared with bodies or lengths; without these, with the first scalar.
    let references: Vec<usize> = angles.into_iter().chain(lengths).collect();
    let (references, rest) = match scalars.split_first() {
        Some((first, rest)) if references.is_empty() => (vec![*first], rest),
        _ => (references, scalars.as_slice()),
    };
    for &scalar in rest {
        scales[scalar] = ratio_of_sizes(graph, matrix, (&references, scalar), (kinds, &scales));
    }
    scales
}

/// The rows that contain entries in both lists of columns, with these entries.
fn shared_rows<'m>(
    graph: &'m Graph,
    matrix: &'m [Vec<ExprId>],
    columns: [&'m [usize]; 2],
) -> impl Iterator<Item = [Vec<(usize, ExprId)>; 2]> + 'm {
    let entries = move |row: &Vec<ExprId>| {
        columns.map(|columns| {
            columns.iter().map(|&k| (k, row[k])).filter(|&(_, entry)| !graph.is_zero(entry)).collect::<Vec<_>>()
        })
    };
    matrix.iter().map(entries).filter(|entries| entries.iter().all(|entries| !entries.is_empty()))
}

/// Over the rows that contain both, the sum of the squared entries in the first columns, which are scaled, divided by that
/// in the second; `None` if no row contains both.
fn ratio(
    graph: &mut Graph,
    matrix: &[Vec<ExprId>],
    columns: [&[usize]; 2],
    scales: &[Option<ExprId>],
) -> Option<ExprId> {
    let rows: Vec<_> = shared_rows(graph, matrix, columns).collect();
    let mut sums = [graph.zero(); 2];
    for row in &rows {
        for (total, entries) in sums.iter_mut().zip(row) {
            let squares = sum_of_squares(graph, entries, scales);
            *total = graph.add(*total, squares);
        }
    }
    let [above, below] = sums;
    if graph.is_zero(above) {
        return None;
    }
    let square = graph.div(above, below);
    Some(graph.opaque(square))
}

/// As [`ratio`] for a single column, with the sizes of its entries at any configuration, and of the first columns, too,
/// where these are scalars.
fn ratio_of_sizes(
    graph: &mut Graph,
    matrix: &[Vec<ExprId>],
    (references, scalar): (&[usize], usize),
    (kinds, scales): (&[UnknownKind], &[Option<ExprId>]),
) -> Option<ExprId> {
    let scalar_column = [scalar];
    let rows: Vec<_> = shared_rows(graph, matrix, [references, &scalar_column]).collect();
    let (mut above, mut below) = (graph.zero(), graph.number(DENOMINATOR_FLOOR));
    for [of_others, of_scalar] in &rows {
        let squares = match of_others.as_slice() {
            &[(other, entry)] if kinds[other] == UnknownKind::Scalar => squared_size_anywhere(graph, entry, DEPTH),
            entries => sum_of_squares(graph, entries, scales),
        };
        above = graph.add(above, squares);
        for &(_, entry) in of_scalar {
            let size = squared_size_anywhere(graph, entry, DEPTH);
            below = graph.add(below, size);
        }
    }
    if graph.is_zero(above) {
        return None;
    }
    let square = graph.div(above, below);
    Some(graph.opaque(square))
}

/// The sum of the squares of entries in scaled columns.
fn sum_of_squares(graph: &mut Graph, entries: &[(usize, ExprId)], scales: &[Option<ExprId>]) -> ExprId {
    let mut sum = graph.zero();
    for &(column, entry) in entries {
        let mut square = graph.mul(entry, entry);
        if let Some(scale) = scales[column] {
            square = graph.mul(scale, square);
        }
        sum = graph.add(sum, square);
    }
    sum
}
