//! What can be plotted: the columns of a motion, their units, and which of them tell something.

use super::degrees;
use crate::model::Model;
use crate::motion::Motion;
use crate::present::animation::ColumnInfo;
use crate::present::forces::column_units;
use crate::present::grid::{names, row};
use crate::present::units::Units;
use crate::state::State;

/// Names and units of the columns besides t: each with its rate and its acceleration, but for forces.
pub(super) fn column_infos(model: &Model, units: Units, names: &[String]) -> Vec<ColumnInfo> {
    let of_forces = column_units(model);
    let with_rates = names.len() - of_forces.len();
    let info = |(k, name): (usize, &String)| {
        let base = name.trim_end_matches("_ddot").trim_end_matches("_dot");
        let unit = match k.checked_sub(with_rates) {
            None => units.derivative(units.measure(base), k % 3),
            Some(place) => of_forces[place].map(str::to_owned),
        };
        ColumnInfo { unit, name: name.clone() }
    };
    names.iter().enumerate().map(info).collect()
}

/// The numbers of all columns, t first.
pub(super) fn shown_columns(model: &Model, states: &[State], motions: &[Motion], degrees: bool) -> Vec<Vec<f64>> {
    let mut columns: Vec<Vec<f64>> = vec![Vec::with_capacity(states.len()); names(model, true).len()];
    let mut numbers = Vec::new();
    for (state, motion) in states.iter().zip(motions) {
        let (state, motion) = (degrees::state(model, state, degrees), degrees::motion(model, motion, degrees));
        row(&state, Some(&motion), &mut numbers);
        columns.iter_mut().zip(&numbers).for_each(|(column, value)| column.push(*value));
    }
    columns
}

/// Two columns that tell something at first: a point's or a coordinate's that is not simply driven, and its rate.
pub(super) fn shown(model: &Model, columns: &[Vec<f64>]) -> Vec<usize> {
    let bends = |k: usize| columns.get(k).map_or(0.0, |values| bend(values));
    let points = 3 * model.coordinates.len()..3 * (model.coordinates.len() + 2 * model.points.len());
    let coordinates = (0..3 * model.coordinates.len()).rev();
    let mut candidates = points.chain(coordinates).filter(|k| k % 3 == 0 && *k < columns.len());
    let first = candidates.clone().next();
    candidates.find(|&k| bends(k) > 1e-9).or(first).map_or_else(Vec::new, |k| vec![k, k + 1])
}

/// How far the values are at most from the line between the first and the last of them.
pub(super) fn bend(values: &[f64]) -> f64 {
    let (first, last) = (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0));
    let count = (values.len().max(2) - 1) as f64;
    let line = |i: usize| first + (last - first) * i as f64 / count;
    values.iter().enumerate().map(|(i, x)| (x - line(i)).abs()).fold(0.0, f64::max)
}
