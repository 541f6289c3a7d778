//! All closures of a mechanism: tables for people, and records for JSON.

use super::json::{Record, record};
use super::number::magnitude;
use super::table::Table;
use super::text::{count, section};
use crate::assembly::{Assemblies, Assembly, Undecided};
use crate::certificate::Certificate;
use crate::model::Model;

/// Largest number of closures in a text.
const MAX_LISTED_CLOSURES: usize = 64;
/// Largest number of undecided cases that are listed one by one.
const MAX_LISTED_DOUBTS: usize = 8;

/// All closures, for JSON.
pub(crate) fn records(all: &Assemblies) -> Vec<Record> {
    let record = |(name, assembly): (String, &Assembly)| {
        let certificate = assembly.certificate.as_ref();
        record! {
            mode: name,
            q: assembly.q,
            q_dot: assembly.q_dot,
            q_ddot: assembly.q_ddot,
            certified: certificate.is_ok(),
            radius: certificate.ok().map(Certificate::radius),
            isolation: certificate.ok().map(Certificate::isolation),
            why: certificate.err().map(ToString::to_string),
        }
    };
    all.names().into_iter().zip(&all.found).map(record).collect()
}

/// The closures, one in a column; of very many only the first.
pub(crate) fn text(model: &Model, all: &Assemblies) -> String {
    let number = |k: usize| (k + 1).to_string();
    let certified = |assembly: &Assembly| match &assembly.certificate {
        Ok(certificate) => magnitude(certificate.radius()),
        Err(_) => "no".to_owned(),
    };
    let listed = &all.found[..all.found.len().min(MAX_LISTED_CLOSURES)];
    let closures = Table::new()
        .right("", (0..listed.len()).map(number))
        .words("modes", all.names().into_iter().take(listed.len()))
        .right("certified within", listed.iter().map(certified));
    let names = model.coordinates.iter().map(|coordinate| coordinate.name);
    let coordinates =
        listed.iter().enumerate().fold(Table::new().words("coordinate", names), |table, (k, assembly)| {
            table.numbers(&number(k), assembly.q.iter().copied())
        });
    let found = match all.found.len() {
        0 if all.undecided.is_empty() => "\nIt does not close.\n".to_owned(),
        0 => "\nIt is undecided whether it closes.\n".to_owned(),
        k => {
            let is_unfinished = |undecided: &Undecided| matches!(undecided, Undecided::Unfinished { .. });
            let at_least = if all.undecided.iter().any(is_unfinished) { "at least " } else { "" };
            let some = match listed.len() {
                most if most < k => format!(" The first {most} are listed; --format json has all that were found."),
                _ => String::new(),
            };
            format!("\nIt closes in {at_least}{}.{some}\n", count(k, "way"))
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mechanism;
    use crate::certificate::Uncertified;
    use crate::fixture::PlannedFourBar;

    #[test]
    fn of_very_many_closures_the_first_are_listed() {
        let assembly = Assembly {
            q: vec![0.0; 9],
            q_dot: vec![0.0; 9],
            q_ddot: vec![0.0; 9],
            modes: Vec::new(),
            certificate: Err(Uncertified::Malformed),
        };
        let of =
            |count| Assemblies { found: vec![assembly.clone(); count], undecided: Vec::new(), searched: Vec::new() };
        let [few, many] = [64, 70].map(|count| text(PlannedFourBar::model(), &of(count)));
        assert!(few.contains("\nIt closes in 64 ways.\n") && few.contains("closure=64"), "{few}");
        assert!(
            many.contains("\nIt closes in 70 ways. The first 64 are listed; --format json has all that were found.\n")
        );
        assert!(many.contains("closure=64") && !many.contains("closure=65"), "{many}");
        assert_eq!(70, records(&of(70)).len());
        let unfinished = Assemblies { undecided: vec![Undecided::Unfinished { seen: 9 }], ..of(2) };
        assert!(text(PlannedFourBar::model(), &unfinished).contains("\nIt closes in at least 2 ways.\n"));
    }
}
