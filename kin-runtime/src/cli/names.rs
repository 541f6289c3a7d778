//! Finding what a user named, and saying what would have been right.

use super::failure::Failure;
use crate::present::table::wrapped;

/// At most so many names are listed in an error.
const LISTED: usize = 24;

/// What kind of names are looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Parameter,
    Coordinate,
    Input,
    Mode,
    #[cfg(feature = "plot")]
    Quantity,
    #[cfg(feature = "equations")]
    Joint,
}

impl Kind {
    fn singular(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            Self::Coordinate => "coordinate",
            Self::Input => "input",
            Self::Mode => "mode",
            #[cfg(feature = "plot")]
            Self::Quantity => "quantity",
            #[cfg(feature = "equations")]
            Self::Joint => "joint",
        }
    }
}

impl Kind {
    fn plural(self) -> String {
        match self {
            #[cfg(feature = "plot")]
            Self::Quantity => "quantities".to_owned(),
            other => format!("{}s", other.singular()),
        }
    }
}

/// The place of `name` among `names`.
pub(super) fn find(option: &str, kind: Kind, name: &str, names: &[&str]) -> Result<usize, Failure> {
    if let Some(place) = names.iter().position(|n| *n == name) {
        return Ok(place);
    }
    let what = kind.singular();
    if names.is_empty() {
        return Err(Failure::option(option, format!("`{name}`: this mechanism has no {}", kind.plural())));
    }
    let mut text = format!("no {what} named `{name}`");
    if let Some(element) = names.iter().find(|n| n.strip_prefix(name).is_some_and(|rest| rest.starts_with('['))) {
        text.push_str(&format!("; it is an array: name its elements, `{element}`"));
    } else if let Some(near) = nearest(name, names) {
        text.push_str(&format!("; did you mean `{near}`?"));
    }
    text.push('\n');
    text.push_str(&listing(&format!("  {}: ", kind.plural()), names));
    Err(Failure::option(option, text))
}

/// The names, wrapped, without a final line break.
pub(super) fn listing(lead: &str, names: &[&str]) -> String {
    let shown = names.iter().take(LISTED).map(|n| (*n).to_owned());
    let rest = names.len().saturating_sub(LISTED);
    let more = (rest > 0).then(|| format!("… and {rest} more (`info --format json` has them all)"));
    wrapped(lead, shown.chain(more), 96).trim_end().to_owned()
}

/// The most similar name, when one is similar enough to be what was meant.
fn nearest<'n>(name: &str, names: &[&'n str]) -> Option<&'n str> {
    let lower = name.to_lowercase();
    names
        .iter()
        .map(|n| (distance(&lower, &n.to_lowercase()), *n))
        .filter(|(d, n)| *d <= n.chars().count().max(3) / 3)
        .min_by_key(|(d, _)| *d)
        .map(|(_, n)| n)
}

/// Levenshtein's distance with a swap of neighbours as one edit.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, y) in b.iter().enumerate() {
            let at = |v: &[usize], k: usize| v.get(k).copied().unwrap_or(usize::MAX / 2);
            let mut best = (at(&above, j) + usize::from(x != y)).min(at(&above, j + 1) + 1).min(at(&row, j) + 1);
            let swapped = i > 0 && j > 0 && a.get(i - 1) == Some(y) && b.get(j - 1) == Some(x);
            if swapped {
                best = best.min(at(&before, j - 1) + 1);
            }
            row.push(best);
        }
        before = std::mem::replace(&mut above, row);
    }
    above.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: &[&str] = &["crank.x", "crank.phi", "coupler.phi", "l[0]", "l[1]"];

    fn message(name: &str) -> String {
        find("--set", Kind::Parameter, name, NAMES).map_or_else(|e| e.to_string(), |i| format!("found {i}"))
    }

    #[test]
    fn finds_and_suggests() {
        assert_eq!(message("crank.phi"), "found 1");
        assert!(message("crnak.phi").starts_with("--set: no parameter named `crnak.phi`; did you mean `crank.phi`?\n"));
        assert!(message("Crank.Phi").contains("did you mean `crank.phi`?"));
        assert!(!message("something").contains("did you mean"));
        assert!(message("something").ends_with("\n  parameters: crank.x, crank.phi, coupler.phi, l[0], l[1]"));
        assert!(message("l").contains("it is an array: name its elements, `l[0]`"));
    }

    #[test]
    fn says_so_when_there_are_none() {
        let error = find("--input", Kind::Input, "u", &[]);
        assert_eq!(error, Err(Failure::Usage("--input: `u`: this mechanism has no inputs".into())));
    }

    #[test]
    fn edits_are_counted() {
        assert_eq!(distance("crank", "crank"), 0);
        assert_eq!(distance("crnak", "crank"), 1);
        assert_eq!(distance("crk", "crank"), 2);
        assert_eq!(distance("", "abc"), 3);
    }
}
