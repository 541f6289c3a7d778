//! What a misspelt name may have meant.

use strsim::damerau_levenshtein;

/// Largest number of names that are listed if none is similar.
const LISTED: usize = 12;

/// The message that a name is unknown, with the most similar known name or, if they are few, all known names.
pub(crate) fn unknown<'a>(noun: &str, name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    let far = name.chars().count().max(3) / 3;
    let near = known.iter().map(|other| (damerau_levenshtein(name, other), other)).min();
    match near {
        Some((distance, other)) if distance <= far => format!("no {noun} named `{name}`; did you mean `{other}`?"),
        _ if known.is_empty() => format!("no {noun} named `{name}`; there are none"),
        _ => {
            let more = if known.len() > LISTED { ", …" } else { "" };
            format!("no {noun} named `{name}`; there are {}{more}", known[..known.len().min(LISTED)].join(", "))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_suggested_and_otherwise_what_there_is() {
        let names = ["crank.phi", "rocker.phi"];
        let say = |name| unknown("quantity", name, names.into_iter());
        assert_eq!(say("roker.phi"), "no quantity named `roker.phi`; did you mean `rocker.phi`?");
        assert_eq!(say("zzz"), "no quantity named `zzz`; there are crank.phi, rocker.phi");
    }
}
