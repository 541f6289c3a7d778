//! Units in quotes, and what to write instead of an unknown one.

use kin_core::units;
use syn::parse::ParseStream;
use syn::{Error, LitStr, Result};

/// Parses a known unit, such as `"m"`.
pub(super) fn unit(input: ParseStream) -> Result<String> {
    let unit: LitStr = input
        .parse()
        .map_err(|error: Error| Error::new(error.span(), "a unit is written in quotes: `unit = \"m\"`"))?;
    units::parse(&unit.value())
        .map_err(|units::UnknownUnit(part)| Error::new(unit.span(), unknown(&unit.value(), &part)))?;
    Ok(unit.value())
}

/// The message for a text with an unknown part.
fn unknown(text: &str, part: &str) -> String {
    let forms = "units are written as in `m`, `mm`, `rad/s`, `m/s^2` or `N*m`; leave `unit` out for other quantities";
    if text.trim().is_empty() {
        return format!("this unit is empty; {forms}");
    }
    let has_fraction = |c: char| text.split(c).skip(1).any(|rest| rest.trim_start_matches('-').contains('.'));
    if has_fraction('^') {
        return format!("a power of a unit is an integer; {forms}");
    }
    match corrected(text) {
        Some(right) if part.is_empty() => format!("`{text}` is no unit; did you mean `{right}`?"),
        Some(right) => format!("no unit `{part}` is known; did you mean `{right}`?"),
        None if part.is_empty() => format!("a factor is missing in the unit `{text}`; {forms}"),
        None => format!("no unit `{part}` is known; {forms}"),
    }
}

/// The unit that is probably meant, if it is valid.
fn corrected(text: &str) -> Option<String> {
    let powers = text.trim().replace("**", "^");
    let whole = if powers.starts_with('/') { format!("1{powers}") } else { powers };
    let mut right = String::new();
    let mut word = String::new();
    for letter in whole.chars().chain(['\0']) {
        if letter.is_alphabetic() {
            word.push(letter);
            continue;
        }
        right.push_str(&symbol(&std::mem::take(&mut word)));
        right.push(letter);
    }
    right.pop();
    (right != text && units::parse(&right).is_ok()).then_some(right)
}

/// The symbol of a unit that is written out or in other cases; other words stay as they are.
fn symbol(word: &str) -> String {
    const WORDS: [(&str, &[&str]); 12] = [
        ("m", &["metre", "meter", "metres", "meters"]),
        ("mm", &["millimetre", "millimeter", "millimetres", "millimeters"]),
        ("s", &["sec", "secs", "second", "seconds"]),
        ("min", &["minute", "minutes"]),
        ("h", &["hr", "hour", "hours"]),
        ("kg", &["kilogram", "kilograms", "kgs"]),
        ("rad", &["radian", "radians", "rads"]),
        ("deg", &["degree", "degrees", "degs"]),
        ("N", &["newton", "newtons"]),
        ("Hz", &["hertz"]),
        ("in", &["inch", "inches"]),
        ("ft", &["foot", "feet"]),
    ];
    const CASES: [&str; 10] = ["m", "mm", "s", "kg", "rad", "deg", "rpm", "rev", "Hz", "kHz"];
    let lower = word.to_lowercase();
    if word.is_empty() || units::parse(word).is_ok() {
        return word.to_owned();
    }
    let written_out = WORDS.iter().find(|(_, words)| words.contains(&lower.as_str())).map(|(symbol, _)| *symbol);
    let in_other_case = || CASES.into_iter().find(|known| known.eq_ignore_ascii_case(word));
    written_out.or_else(in_other_case).unwrap_or(word).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_other_spellings_are_recognised() {
        for (written, right) in [
            ("m**2", "m^2"),
            ("/s", "1/s"),
            ("sec", "s"),
            ("RPM", "rpm"),
            ("Kg", "kg"),
            ("degree", "deg"),
            ("N*meters", "N*m"),
            ("radians/sec**2", "rad/s^2"),
        ] {
            assert_eq!(corrected(written).as_deref(), Some(right));
        }
        for unknown in ["furlong", "m//s", "10m", "apples/s", "m^1.5", ""] {
            assert_eq!(corrected(unknown), None, "{unknown}");
        }
        assert!(unknown("m^1.5", "5").starts_with("a power of a unit is an integer"));
        assert!(unknown("m//s", "").starts_with("a factor is missing in the unit `m//s`"));
        assert!(unknown("", "").starts_with("this unit is empty"));
        assert_eq!(unknown("/s", ""), "`/s` is no unit; did you mean `1/s`?");
    }
}
