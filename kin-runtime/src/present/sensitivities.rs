//! Sensitivities as tables for people: which dimension matters most, and the deviations that tolerances cause.

use super::table::Table;
use super::text::section;
use crate::sensitivities::{Deviation, Sensitivities, Sensitivity};

/// A quantity with a function that gives its derivative with respect to a parameter.
type Quantity<'a> = (String, Box<dyn Fn(&Sensitivity) -> f64 + 'a>);

/// Coordinates, coordinates of points, and defines.
pub(crate) fn quantities(found: &Sensitivities) -> Vec<Quantity<'_>> {
    let model = found.model;
    let mut all: Vec<Quantity<'_>> = Vec::new();
    for (k, coordinate) in model.coordinates.iter().enumerate() {
        all.push((coordinate.name.to_owned(), Box::new(move |by| by.q[k])));
    }
    for (k, point) in model.points.iter().enumerate() {
        for (axis, letter) in ["x", "y"].into_iter().enumerate() {
            all.push((format!("{}.{letter}", point.name), Box::new(move |by| by.points[k].r[axis])));
        }
    }
    for (k, define) in model.defines.iter().enumerate() {
        all.push((define.name.to_owned(), Box::new(move |by| by.defines[k].value)));
    }
    all
}

/// The effect of one percent of each dimension, the most important dimension first: on every point or, if there is
/// none, on the coordinates.
pub(crate) fn text(found: &Sensitivities, values: &[f64]) -> String {
    let model = found.model;
    let percent = |k: usize| 0.01 * values.get(k).copied().unwrap_or(0.0);
    let ranked = |size: &dyn Fn(&Sensitivity) -> f64| {
        let mut order: Vec<(usize, f64)> =
            found.by.iter().enumerate().map(|(k, by)| (k, size(by) * percent(k).abs())).collect();
        order.sort_by(|a, b| b.1.total_cmp(&a.1));
        order
    };
    let mut out = String::new();
    for (index, point) in model.points.iter().enumerate() {
        let order = ranked(&|by| by.points[index].r[0].hypot(by.points[index].r[1]));
        let changes = |axis: usize| order.iter().map(move |&(k, _)| found.by[k].points[index].r[axis]);
        let table = Table::new()
            .words("parameter", order.iter().map(|&(k, _)| found.by[k].parameter))
            .numbers("value", order.iter().map(|&(k, _)| values.get(k).copied().unwrap_or(f64::NAN)))
            .numbers("∂x", changes(0))
            .numbers("∂y", changes(1))
            .numbers("1 % moves it by", order.iter().map(|&(_, size)| size));
        out += &section(&format!("Point {}: which dimension matters most", point.name), &table);
    }
    let mut table = Table::new()
        .words("parameter", found.by.iter().map(|by| by.parameter))
        .numbers("value", (0..found.by.len()).map(|k| values.get(k).copied().unwrap_or(f64::NAN)));
    for (k, coordinate) in model.coordinates.iter().enumerate() {
        if found.by.iter().any(|by| by.q[k] != 0.0) {
            table = table.numbers(&format!("∂{}", coordinate.name), found.by.iter().map(|by| by.q[k]));
        }
    }
    out + &section("Coordinates by each parameter", &table)
}

/// The deviations that tolerances cause, without those that are zero.
pub(crate) fn deviations(found: &Sensitivities, tolerances: &[f64]) -> Vec<(String, Deviation)> {
    let all = quantities(found).into_iter();
    let all = all.map(|(name, derivative)| (name, found.deviation(tolerances, |by| derivative(by))));
    all.filter(|(_, deviation)| deviation.worst > 0.0).collect()
}

/// [`deviations`] as a table.
pub(crate) fn tolerance_text(deviations: &[(String, Deviation)]) -> String {
    let table = Table::new()
        .words("quantity", deviations.iter().map(|(name, _)| name.clone()))
        .numbers("worst case", deviations.iter().map(|(_, deviation)| deviation.worst))
        .numbers("root sum of squares", deviations.iter().map(|(_, deviation)| deviation.root_sum_square));
    section("Deviations for these tolerances", &table)
}
