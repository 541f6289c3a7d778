//! Motion over time as rows of numbers.

use super::number::plain;
use super::table::Table;
use crate::model::Model;
use crate::motion::Motion;
use crate::state::State;

/// One column: its name and its numbers.
pub(crate) type Column = (String, Vec<f64>);

/// `t`, then every coordinate with its rate and acceleration; behind them, where `motions` are given (one per state),
/// points, defines and joint quantities.
pub(crate) fn columns(model: &Model, states: &[State], motions: &[Motion]) -> Vec<Column> {
    let mut columns: Vec<Column> = vec![("t".to_owned(), states.iter().map(|s| s.t).collect())];
    for (k, coordinate) in model.coordinates.iter().enumerate() {
        let mut push = |suffix: &str, part: fn(&State) -> &[f64]| {
            let values = states.iter().map(|s| part(s).get(k).copied().unwrap_or(f64::NAN)).collect();
            columns.push((format!("{}{suffix}", coordinate.name), values));
        };
        push("", |s| &s.q);
        push("_dot", |s| &s.q_dot);
        push("_ddot", |s| &s.q_ddot);
    }
    if motions.len() == states.len() {
        reported(model, motions, &mut columns);
    }
    columns
}

/// Points, defines and joint quantities.
fn reported(model: &Model, motions: &[Motion], columns: &mut Vec<Column>) {
    let mut push = |name: String, value: &dyn Fn(&Motion) -> Option<[f64; 3]>| {
        for (place, suffix) in ["", "_dot", "_ddot"].into_iter().enumerate() {
            let number = |m| value(m).and_then(|v| v.get(place).copied()).unwrap_or(f64::NAN);
            columns.push((format!("{name}{suffix}"), motions.iter().map(number).collect()));
        }
    };
    for (k, point) in model.points.iter().enumerate() {
        push(format!("{}.x", point.name), &|m| m.points.get(k).map(|p| [p.r[0], p.v[0], p.a[0]]));
        push(format!("{}.y", point.name), &|m| m.points.get(k).map(|p| [p.r[1], p.v[1], p.a[1]]));
    }
    for (k, define) in model.defines.iter().enumerate() {
        push(define.name.to_owned(), &|m| m.defines.get(k).map(|r| [r.value, r.rate, r.acceleration]));
    }
    for (j, joint) in model.joints.iter().enumerate() {
        for (k, quantity) in joint.quantities.iter().enumerate() {
            let rates = |m: &Motion| m.joints.get(j).and_then(|r| r.get(k)).copied();
            let name = format!("{}.{}", joint.name, quantity.name);
            push(name, &|m| rates(m).map(|r| [r.value, r.rate, r.acceleration]));
        }
    }
}

/// One header line, then one row per state; numbers read back as the same `f64`. `written` is told every row.
pub(crate) fn csv(
    model: &Model,
    states: &[State],
    motions: &[Motion],
    written: &dyn Fn(usize),
) -> Result<String, String> {
    let columns = columns(model, states, motions);
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |e: csv::Error| format!("cannot write csv: {e}");
    writer.write_record(columns.iter().map(|c| &c.0)).map_err(failed)?;
    for i in 0..states.len() {
        let row = columns.iter().map(|c| c.1.get(i).copied().map(exact).unwrap_or_default());
        writer.write_record(row).map_err(failed)?;
        written(i + 1);
    }
    let bytes = writer.into_inner().map_err(|e| format!("cannot write csv: {e}"))?;
    String::from_utf8(bytes).map_err(|e| format!("cannot write csv: {e}"))
}

/// A number for another program.
fn exact(value: f64) -> String {
    if value.is_finite() { plain(value) } else { value.to_string() }
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
