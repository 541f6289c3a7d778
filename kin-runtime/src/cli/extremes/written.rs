//! Extremes as text and as csv.

use super::record::{MotionRecord, QuantityRange};
use super::search::Extreme;
use crate::cli::vary::Choice;
use crate::model::Model;
use crate::present::number::{plain, rounded};
use crate::present::table::Table;

/// The names of the driven quantities, which are the same for all extremes.
fn driver_names(motions: &[MotionRecord]) -> Vec<String> {
    let mut extremes = motions.iter().flat_map(|motion| &motion.extremes).filter_map(|range| range.least.as_ref());
    extremes.next().map_or_else(Vec::new, |extreme| extreme.drivers.names().cloned().collect())
}

pub(super) fn text(motions: &[MotionRecord], model: &Model, degrees: bool) -> String {
    let angles = if degrees { ", angles in degrees" } else { "" };
    let mut out = String::new();
    for motion in motions {
        let [from, to] = [motion.from, motion.to].map(|t| t.map_or_else(String::new, rounded));
        let varied = motion.varied.as_ref().map_or_else(String::new, |varied| {
            varied.iter().map(|(name, value)| format!(", {name} = {}", rounded(*value))).collect()
        });
        if !out.is_empty() {
            out.push('\n');
        }
        out += &format!("{}{varied}, extremes from t = {from} to t = {to}{angles}\n", model.name);
        if motion.extremes.is_empty() {
            out += "\n  nothing changes\n";
        }
        for (heading, side) in [
            ("least", (|range| range.least.as_ref()) as fn(&QuantityRange) -> Option<&Extreme>),
            ("greatest", |range| range.greatest.as_ref()),
        ] {
            let rows: Vec<(&QuantityRange, &Extreme)> =
                motion.extremes.iter().filter_map(|range| Some((range, side(range)?))).collect();
            if rows.is_empty() {
                continue;
            }
            let mut table = Table::new()
                .words("quantity", rows.iter().map(|(range, _)| range.quantity.as_str()))
                .right(heading, rows.iter().map(|(_, extreme)| rounded(extreme.value)))
                .words("unit", rows.iter().map(|(range, _)| range.unit.as_deref().unwrap_or("")))
                .right("at t", rows.iter().map(|(_, extreme)| rounded(extreme.t)));
            for (k, name) in driver_names(std::slice::from_ref(motion)).iter().enumerate() {
                let value = |extreme: &Extreme| extreme.drivers.iter().nth(k).map_or(f64::NAN, |(_, value)| *value);
                table = table.right(name, rows.iter().map(|(_, extreme)| rounded(value(extreme))));
            }
            // Most extremes are between instants, which is therefore not mentioned.
            let shown = |extreme: &Extreme| if extreme.place == "between instants" { "" } else { extreme.place };
            table = table.words("", rows.iter().map(|(_, extreme)| shown(extreme)));
            out += &format!("\n{}", table.render());
        }
    }
    out
}

pub(super) fn csv(motions: &[MotionRecord], choice: &Choice, model: &Model) -> String {
    let drivers = driver_names(motions);
    let mut header: Vec<String> = choice.pairs(model).map(|(name, _)| name.to_owned()).collect();
    header.extend(["quantity", "unit"].map(str::to_owned));
    for side in ["least", "greatest"] {
        header.extend([side.to_owned(), format!("{side}_t")]);
        header.extend(drivers.iter().map(|name| format!("{side}_{name}")));
        header.push(format!("{side}_where"));
    }
    let mut out = header.join(",") + "\n";
    for motion in motions {
        for range in &motion.extremes {
            let varied = choice.pairs(model).map(|(name, _)| {
                let parameters = motion.varied.as_ref().unwrap_or(&motion.parameters);
                parameters.iter().find(|(other, _)| *other == name).map_or_else(String::new, |(_, value)| plain(*value))
            });
            let mut cells: Vec<String> = varied.collect();
            cells.extend([range.quantity.clone(), range.unit.clone().unwrap_or_default()]);
            for extreme in [&range.least, &range.greatest] {
                match extreme {
                    None => cells.extend(std::iter::repeat_n(String::new(), 3 + drivers.len())),
                    Some(extreme) => {
                        cells.extend([plain(extreme.value), plain(extreme.t)]);
                        cells.extend(extreme.drivers.iter().map(|(_, value)| plain(*value)));
                        cells.push(extreme.place.to_owned());
                    }
                }
            }
            out += &(cells.join(",") + "\n");
        }
    }
    out
}
