//! Motion over time as rows of numbers.

use std::io::{self, Write};

use super::forces;
use super::number::plain;
use super::table::Table;
use crate::model::Model;
use crate::motion::Motion;
use crate::state::State;

/// One column: its name and its numbers.
pub(crate) type Column = (String, Vec<f64>);

/// What the endings of names are for a value, its rate and its acceleration.
const SUFFIXES: [&str; 3] = ["", "_dot", "_ddot"];

/// The names of columns: `t`, then every coordinate with its rate and acceleration; behind them, where they are wanted,
/// points, defines and joint quantities, and what there is of forces, without rates.
pub(crate) fn names(model: &Model, reported: bool) -> Vec<String> {
    let mut bases: Vec<String> = model.coordinates.iter().map(|coordinate| coordinate.name.to_owned()).collect();
    if reported {
        bases.extend(model.points.iter().flat_map(|point| ["x", "y"].map(|axis| format!("{}.{axis}", point.name))));
        bases.extend(model.defines.iter().map(|define| define.name.to_owned()));
        for joint in model.joints {
            bases.extend(joint.quantities.iter().map(|quantity| format!("{}.{}", joint.name, quantity.name)));
        }
    }
    let all = bases.iter().flat_map(|base| SUFFIXES.map(|suffix| format!("{base}{suffix}")));
    let forces = if reported { forces::column_names(model) } else { Vec::new() };
    std::iter::once("t".to_owned()).chain(all).chain(forces).collect()
}

/// The numbers of one row, for [`names`] with what is reported where `motion` is there.
pub(crate) fn row(state: &State, motion: Option<&Motion>, out: &mut Vec<f64>) {
    out.clear();
    out.push(state.t);
    for ((q, q_dot), q_ddot) in state.q.iter().zip(&state.q_dot).zip(&state.q_ddot) {
        out.extend([*q, *q_dot, *q_ddot]);
    }
    let Some(motion) = motion else { return };
    for point in &motion.points {
        out.extend([point.r[0], point.v[0], point.a[0], point.r[1], point.v[1], point.a[1]]);
    }
    for rates in motion.defines.iter().chain(motion.joints.iter().flatten()) {
        out.extend([rates.value, rates.rate, rates.acceleration]);
    }
    forces::column_values(motion.model, motion.forces.as_ref(), out);
}

/// The columns of [`names`]; with what is reported where `motions` are given, one per state.
pub(crate) fn columns(model: &Model, states: &[State], motions: &[Motion]) -> Vec<Column> {
    let reported = motions.len() == states.len();
    let names = names(model, reported);
    let mut columns: Vec<Column> = names.into_iter().map(|name| (name, Vec::with_capacity(states.len()))).collect();
    let mut numbers = Vec::new();
    for (k, state) in states.iter().enumerate() {
        row(state, motions.get(k).filter(|_| reported), &mut numbers);
        columns.iter_mut().zip(&numbers).for_each(|((_, column), value)| column.push(*value));
    }
    columns
}

/// One header line, then a row per state; numbers read back as the same `f64`.
pub(crate) struct CsvRows<W: Write> {
    writer: csv::Writer<W>,
    numbers: Vec<f64>,
}

impl<W: Write> CsvRows<W> {
    /// Writes the header.
    pub(crate) fn new(model: &Model, reported: bool, out: W) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(names(model, reported)).map_err(io_error)?;
        Ok(Self { writer, numbers: Vec::new() })
    }

    /// Writes a row.
    pub(crate) fn row(&mut self, state: &State, motion: Option<&Motion>) -> io::Result<()> {
        row(state, motion, &mut self.numbers);
        self.writer.write_record(self.numbers.iter().copied().map(exact)).map_err(io_error)
    }

    /// Writes what waits in memory.
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// What the system said, for whoever asks for its kind.
fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// A number for another program. What is not determined, as the force of a joint with redundant rows, leaves its cell empty.
fn exact(value: f64) -> String {
    if value.is_finite() { plain(value) } else { String::new() }
}

/// Columns on the screen that a table may take beside t.
const COLUMNS: usize = 86;

/// Value, rate and acceleration together, as many as fit beside one another.
fn side_by_side(columns: &[Column]) -> Vec<&[Column]> {
    let width = |part: &[Column]| part.iter().map(|(name, _)| name.chars().count().max(9) + 2).sum::<usize>();
    let mut parts = Vec::new();
    let mut rest = columns;
    while !rest.is_empty() {
        let fits = |n: &usize| rest.get(..*n).is_some_and(|part| width(part) <= COLUMNS);
        let (part, others) =
            rest.split_at((6..=rest.len()).step_by(3).take_while(fits).last().unwrap_or(3).min(rest.len()));
        parts.push(part);
        rest = others;
    }
    parts
}

/// Tables below one another, each starting with t.
pub(crate) fn text(model: &Model, states: &[State], motions: &[Motion]) -> String {
    let columns = columns(model, states, motions);
    let Some((t, rest)) = columns.split_first() else { return String::new() };
    let exact = t.1.iter().map(|v| plain(*v)).collect::<Vec<_>>();
    let short = exact.iter().all(|text| text.len() <= 10 && !text.contains('e'));
    let instants = padded(&exact);
    side_by_side(rest)
        .into_iter()
        .map(|part| {
            let start = if short {
                Table::new().right("t", instants.iter().map(String::as_str))
            } else {
                Table::new().numbers("t", t.1.iter().copied())
            };
            let table = part.iter().fold(start, |table, (name, values)| table.numbers(name, values.iter().copied()));
            format!("\n{}", table.render())
        })
        .collect()
}

/// Decimals with zeros behind them, so that their points stand below one another.
fn padded(texts: &[String]) -> Vec<String> {
    let decimals = |t: &str| t.split_once('.').map_or(0, |(_, d)| d.len());
    let most = texts.iter().map(|t| decimals(t)).max().unwrap_or(0);
    let pad = |text: &String| {
        let point = if most > 0 && !text.contains('.') { "." } else { "" };
        format!("{text}{point}{}", "0".repeat(most - decimals(text).min(most)))
    };
    texts.iter().map(pad).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instants_stand_point_below_point() {
        let texts = ["0", "0.25", "-10.5"].map(str::to_owned);
        assert_eq!(padded(&texts), ["0.00", "0.25", "-10.50"]);
        assert_eq!(padded(&texts[..1]), ["0"]);
    }

    #[test]
    fn value_rate_and_acceleration_stay_together() {
        let columns: Vec<Column> = (0..12).map(|k| (format!("coordinate_{k}"), Vec::new())).collect();
        let parts: Vec<usize> = side_by_side(&columns).iter().map(|p| p.len()).collect();
        assert_eq!(parts, [6, 6]);
        let long: Vec<Column> = (0..6).map(|k| (format!("a_coordinate_with_a_long_name_{k}"), Vec::new())).collect();
        assert_eq!(side_by_side(&long).iter().map(|p| p.len()).collect::<Vec<_>>(), [3, 3]);
    }
}
