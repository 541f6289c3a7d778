//! How far a mechanism moves: tables for people, and records for JSON.

use super::json::{Record, record};
use super::number::{Style, rounded};
use super::table::Table;
use super::text::section;
use crate::model::Model;
use crate::ranges::{Range, RangeLimit, Ranges};

/// All limits, for JSON: a record for every driver that can go no further, or a single one without a driver.
pub(crate) fn records(all: &Ranges) -> Vec<Record> {
    let of_drivers = |limit: &RangeLimit| {
        let drivers = limit.drivers.iter().map(|&(name, value)| (Some(name), value));
        let none = limit.drivers.is_empty().then_some((None, None));
        drivers.chain(none).map(|driver| record(limit, driver)).collect::<Vec<_>>()
    };
    all.limits.iter().flat_map(of_drivers).collect()
}

/// A driver at a limit, with the value of the coordinate that it drives.
fn record(limit: &RangeLimit, (driver, value): (Option<&str>, Option<f64>)) -> Record {
    record! {
        driver: driver,
        value: value,
        t: limit.t.midpoint(),
        // The limit is between these two instants.
        interval: limit.t,
        mode: limit.name(),
        joints: limit.joints,
        kind: kind(limit),
        q: (!limit.q.is_empty()).then_some(&limit.q),
        certified: limit.proven,
    }
}

fn kind(limit: &RangeLimit) -> String {
    let unknown = if limit.proven { "limit" } else { "undecided" };
    limit.kind.map_or_else(|| unknown.to_owned(), |kind| kind.to_string())
}

/// Ranges and limits.
pub(crate) fn text(model: &Model, [from, to]: [f64; 2], all: &Ranges) -> String {
    let ranges = Table::new()
        .right("circuit", all.ranges.iter().map(|range| (range.circuit + 1).to_string()))
        .words("modes", all.ranges.iter().map(Range::name))
        .numbers("from", all.ranges.iter().map(|range| range.from))
        .numbers("to", all.ranges.iter().map(|range| range.to));
    let drivers = |limit: &RangeLimit| {
        let value = |value: Option<f64>| value.map_or_else(String::new, |x| format!(" = {}", rounded(x)));
        limit.drivers.iter().map(|&(name, x)| format!("{name}{}", value(x))).collect::<Vec<_>>().join(", ")
    };
    let enclosed = all.limits.iter().filter(|limit| limit.is_enclosed());
    let style = Style::of(enclosed.map(|limit| limit.t.midpoint()));
    let t = |limit: &RangeLimit| match limit.is_enclosed() {
        true => style.write(limit.t.midpoint()),
        false => format!("{} … {}", rounded(limit.t.lower()), rounded(limit.t.upper())),
    };
    let limits = Table::new()
        .right("t", all.limits.iter().map(t))
        .words("kind", all.limits.iter().map(kind))
        .words("joints", all.limits.iter().map(|limit| limit.joints.join(", ")))
        .words("drivers", all.limits.iter().map(drivers))
        .words("modes", all.limits.iter().map(RangeLimit::name))
        .words("proven", all.limits.iter().map(|limit| if limit.proven { "yes" } else { "no" }));
    let nothing = match (all.ranges.is_empty(), all.is_complete()) {
        (false, _) => "",
        (true, true) => "\nIt closes nowhere.\n",
        (true, false) => "\nIt is nowhere proven to close, and undecided near the limits below.\n",
    };
    let heading = format!("{} from t = {} to t = {}\n{nothing}", model.name, rounded(from), rounded(to));
    [heading, section("Ranges", &ranges), section("Limits", &limits)].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::PlannedFourBar;
    use crate::mechanism::Mechanism;
    use crate::planned::LimitKind;
    use crate::scalar::Interval;

    fn limit(t: Interval, kind: Option<LimitKind>, proven: bool) -> RangeLimit {
        RangeLimit { t, modes: Vec::new(), joints: Vec::new(), drivers: Vec::new(), kind, q: Vec::new(), proven }
    }

    /// A wide interval is not printed as the number in its middle, and what is not proven is no end of anything.
    #[test]
    fn what_is_undecided_has_its_interval() {
        let limits = vec![
            limit(Interval::new(70.25, 100.0), None, false),
            limit(Interval::new(1.5, 1.5 + 1e-9), Some(LimitKind::DeadCentre), true),
        ];
        let all = Ranges { ranges: Vec::new(), limits, circuits: 0, searched: Vec::new() };
        let text = text(PlannedFourBar::model(), [0.0, 100.0], &all);
        let lines: Vec<&str> = text.lines().collect();
        let has = |parts: [&str; 2]| lines.iter().any(|line| parts.iter().all(|part| line.contains(part)));
        assert!(has(["70.25 … 100", "undecided"]) && has(["1.500000", "dead centre"]), "{text}");
        assert_eq!(["undecided", "dead centre"], [0, 1].map(|k| kind(&all.limits[k])));
    }
}
