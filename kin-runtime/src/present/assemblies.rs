//! All closures of a mechanism: tables for people, and records for JSON.

use super::json::{Record, record};
use super::number::magnitude;
use super::table::Table;
use super::text::{count, section};
use crate::assembly::{Assemblies, Assembly, Undecided};
use crate::certificate::Certificate;
use crate::model::Model;

/// Largest number of undecided cases that are listed one by one.
const MAX_LISTED_DOUBTS: usize = 8;

/// All closures, for JSON.
pub(crate) fn records(all: &Assemblies) -> Vec<Record> {
    let record = |(k, assembly): (usize, &Assembly)| {
        let certificate = assembly.certificate.as_ref();
        record! {
            mode: all.name(k),
            q: assembly.q,
            q_dot: assembly.q_dot,
            q_ddot: assembly.q_ddot,
            certified: certificate.is_ok(),
            radius: certificate.ok().map(Certificate::radius),
            isolation: certificate.ok().map(Certificate::isolation),
            why: certificate.err().map(ToString::to_string),
        }
    };
    all.found.iter().enumerate().map(record).collect()
}

/// All closures, one in a column.
pub(crate) fn text(model: &Model, all: &Assemblies) -> String {
    let number = |k: usize| (k + 1).to_string();
    let certified = |assembly: &Assembly| match &assembly.certificate {
        Ok(certificate) => magnitude(certificate.radius()),
        Err(_) => "no".to_owned(),
    };
    let closures = Table::new()
        .right("", (0..all.found.len()).map(number))
        .words("modes", (0..all.found.len()).map(|k| all.name(k)))
        .right("certified within", all.found.iter().map(certified));
    let names = model.coordinates.iter().map(|coordinate| coordinate.name);
    let coordinates =
        all.found.iter().enumerate().fold(Table::new().words("coordinate", names), |table, (k, assembly)| {
            table.numbers(&number(k), assembly.q.iter().copied())
        });
    let found = match all.found.len() {
        0 if all.undecided.is_empty() => "\nIt does not close.\n".to_owned(),
        0 => "\nIt is undecided whether it closes.\n".to_owned(),
        k => format!("\nIt closes in {}.\n", count(k, "way")),
    };
    let searched = Table::new()
        .words("searched", all.searched.iter().map(|(name, _)| *name))
        .numbers("from", all.searched.iter().map(|(_, x)| x.lower()))
        .numbers("to", all.searched.iter().map(|(_, x)| x.upper()));
    let coordinates = if all.found.is_empty() { String::new() } else { section("Configurations", &coordinates) };
    [found, section("Closures", &closures), coordinates, section("Search", &searched)].concat()
}

/// The cases that are not proven, line by line.
pub(crate) fn doubts(all: &Assemblies) -> String {
    let uncertified = all.found.iter().enumerate();
    let uncertified = uncertified.filter_map(|(k, assembly)| Some((k, assembly.certificate.as_ref().err()?)));
    let lines = uncertified.map(|(k, why)| format!("  closure {} is not certified: {why}", k + 1));
    let lines: Vec<String> =
        lines.chain(all.undecided.iter().map(|undecided: &Undecided| format!("  undecided: {undecided}"))).collect();
    let more = lines.len().saturating_sub(MAX_LISTED_DOUBTS);
    let text = lines.into_iter().take(MAX_LISTED_DOUBTS).collect::<Vec<_>>().join("\n");
    if more > 0 { format!("{text}\n  and {more} more") } else { text }
}
