//! Quantities for tables and diagrams: those requested by name, and those shown by default.

use super::failure::{Failure, Ledger};
use super::names::find_quantity;
use crate::measure::Measure;
use crate::model::{CoordinateKind, Model};
use crate::present::animation::ColumnInfo;
use crate::present::units::ResultUnits;

/// The quantities with these names; all names that are unknown or repeated are reported at once.
pub(super) fn quantities(model: &'static Model, names: &[String]) -> Result<Vec<Measure>, Failure> {
    let mut ledger = Ledger::default();
    let found: Vec<Measure> = names.iter().filter_map(|name| ledger.take(find_quantity(model, "WHAT", name))).collect();
    for (k, measure) in found.iter().enumerate() {
        let is_same = |other: &&Measure| other.name() == measure.name();
        // A third time is no further mistake.
        if found[..k].iter().filter(is_same).count() == 1 {
            ledger.fault("WHAT", format!("`{}` is named twice", measure.name()));
        }
    }
    ledger.close(Some(found))
}

/// Names and units of quantities.
pub(super) fn column_infos(units: ResultUnits, measures: &[Measure]) -> Vec<ColumnInfo> {
    let info = |measure: &Measure| ColumnInfo { unit: units.of_measure(measure), name: measure.name().to_owned() };
    measures.iter().map(info).collect()
}

/// The two columns that are plotted by default: the first coordinate of a point that is not linear in time or, if there
/// is none, the last such coordinate of q; and its rate.
pub(super) fn shown(model: &Model, columns: &[Vec<f64>]) -> Vec<usize> {
    let kind = |k: usize| model.coordinates.get(k / 3).map(|coordinate| coordinate.kind);
    let is_length =
        |k: usize| kind(k).is_none_or(|kind| matches!(kind, CoordinateKind::Pose { .. }) && !kind.is_angle());
    let points = 3 * model.coordinates.len()..3 * (model.coordinates.len() + 2 * model.points.len());
    let coordinates = (0..3 * model.coordinates.len()).rev();
    let mut candidates = points.chain(coordinates).filter(|k| k % 3 == 0 && *k < columns.len());
    let first = candidates.clone().next();
    let largest = |k: usize| columns[k].iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let size = candidates.clone().filter(|&k| is_length(k)).map(largest).fold(0.0, f64::max);
    // Lengths are compared with the largest of all, angles with a radian, other scalars with themselves.
    let unit = |k: usize| match kind(k) {
        _ if is_length(k) => size,
        Some(CoordinateKind::Scalar) => largest(k),
        _ => 1.0,
    };
    candidates.find(|&k| bend(&columns[k]) > 1e-9 * unit(k)).or(first).map_or_else(Vec::new, |k| vec![k, k + 1])
}

/// The largest distance of the values from the straight line between the first and the last of them.
pub(super) fn bend(values: &[f64]) -> f64 {
    let (first, last) = (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0));
    let count = (values.len().max(2) - 1) as f64;
    let line = |i: usize| first + (last - first) * i as f64 / count;
    values.iter().enumerate().map(|(i, x)| (x - line(i)).abs()).fold(0.0, f64::max)
}
