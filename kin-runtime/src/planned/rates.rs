//! The sizes of rates in radians, which compare coordinates of different units.

use crate::model::{Component, CoordinateKind, Model};

/// The largest rate of an angle, of a scalar, or of the turn of a row with a length, in radians. `turns` are the turns of
/// rows per unit of every coordinate, or empty.
pub(crate) fn largest_angle(model: &Model, turns: &[f64], rates: &[f64]) -> f64 {
    largest_of(model, turns, &mut (0..rates.len()), rates)
}

/// As [`largest_angle`], of some coordinates.
pub(super) fn largest_of(model: &Model, turns: &[f64], indices: &mut dyn Iterator<Item = usize>, rates: &[f64]) -> f64 {
    indices.map(|k| turning(model, turns, rates, k)).fold(0.0, f64::max)
}

/// The size of a rate, in radians. Not inlined, because LLVM 22 crashes when it vectorises the loop around it.
#[inline(never)]
pub(super) fn turning(model: &Model, turns: &[f64], rates: &[f64], k: usize) -> f64 {
    let turn = turns.get(k).copied().unwrap_or(0.0);
    let weight = match model.coordinates[k].kind {
        CoordinateKind::Pose { component: Component::Phi, .. } => 1.0,
        CoordinateKind::Pose { .. } => turn,
        // The unit of a scalar is not known; it may be so large that the rows turn faster.
        CoordinateKind::Scalar => f64::max(1.0, turn),
    };
    (weight * rates[k]).abs()
}

/// True for an angle or a scalar.
pub(super) fn is_angle(model: &Model, k: usize) -> bool {
    !model.coordinates[k].kind.is_length()
}
