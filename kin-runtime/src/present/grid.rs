//! Motion over time as rows of numbers.

use std::io::{self, Write};

use super::number::plain;
use super::table::Table;

/// One column: its name and its numbers.
pub(crate) type Column = (String, Vec<f64>);

/// One header line, then a row per instant; numbers read back as the same `f64`.
pub(crate) struct CsvRows<W: Write> {
    writer: csv::Writer<W>,
}

impl<W: Write> CsvRows<W> {
    /// Writes the header.
    pub(crate) fn new<'n>(names: impl IntoIterator<Item = &'n str>, out: W) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(names).map_err(io_error)?;
        Ok(Self { writer })
    }

    /// Writes a row.
    pub(crate) fn row(&mut self, numbers: impl IntoIterator<Item = f64>) -> io::Result<()> {
        self.writer.write_record(numbers.into_iter().map(exact)).map_err(io_error)
    }

    /// Writes buffered rows.
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// The error of the system, so that callers can distinguish its kinds.
fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// A number for another program; an empty cell for NaN, for example for an undetermined force.
pub(crate) fn exact(value: f64) -> String {
    if value.is_finite() { plain(value) } else { String::new() }
}

/// Width of a table beside t, in columns of text.
const COLUMNS: usize = 86;

/// Splits columns into tables that fit the width; groups of `together` columns, such as a value with its rate and
/// acceleration, stay in one table.
fn side_by_side(columns: &[Column], together: usize) -> Vec<&[Column]> {
    let width = |part: &[Column]| part.iter().map(|(name, _)| name.chars().count().max(9) + 2).sum::<usize>();
    let mut parts = Vec::new();
    let mut rest = columns;
    while !rest.is_empty() {
        let fits = |n: &usize| rest.get(..*n).is_some_and(|part| width(part) <= COLUMNS);
        let more = (2 * together..=rest.len()).step_by(together);
        let (part, remaining) = rest.split_at(more.take_while(fits).last().unwrap_or(together).min(rest.len()));
        parts.push(part);
        rest = remaining;
    }
    parts
}

/// Tables below one another, each starting with the first column, t.
pub(crate) fn text(columns: &[Column], together: usize) -> String {
    let Some((t, rest)) = columns.split_first() else { return String::new() };
    let exact = t.1.iter().map(|v| plain(*v)).collect::<Vec<_>>();
    let short = exact.iter().all(|text| text.len() <= 10 && !text.contains('e'));
    let instants = padded(&exact);
    side_by_side(rest, together)
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

/// Decimals padded with zeros, so that their decimal points are aligned.
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
        let parts: Vec<usize> = side_by_side(&columns, 3).iter().map(|p| p.len()).collect();
        assert_eq!(parts, [6, 6]);
        let long: Vec<Column> = (0..6).map(|k| (format!("a_coordinate_with_a_long_name_{k}"), Vec::new())).collect();
        assert_eq!(side_by_side(&long, 3).iter().map(|p| p.len()).collect::<Vec<_>>(), [3, 3]);
    }
}
