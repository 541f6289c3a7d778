//! Terms of sums and factors of products, in whatever notation.

use super::tree::Formula;

/// What a notation writes of sums.
pub(super) struct Signs {
    /// A minus in front of the first term.
    pub(super) first: &'static str,
    /// Between terms.
    pub(super) plus: &'static str,
    /// Between terms.
    pub(super) minus: &'static str,
}

/// The terms of a sum, each with its sign; `within` writes a formula, in brackets where it binds less tightly.
pub(super) fn terms(terms: &[(bool, Formula)], signs: &Signs, within: impl Fn(&Formula, u8) -> String) -> Vec<String> {
    let one = |(place, (minus, term)): (usize, &(bool, Formula))| {
        let sign = match (place, minus) {
            (0, false) => "",
            (0, true) => signs.first,
            (_, false) => signs.plus,
            (_, true) => signs.minus,
        };
        format!("{sign}{}", within(term, if *minus || place > 0 { 2 } else { 1 }))
    };
    terms.iter().enumerate().map(one).collect()
}

/// The factors of a product. A function whose argument has no brackets (`is_open`) is followed by functions only, or it
/// stands in brackets.
pub(super) fn factors(
    factors: &[Formula],
    is_open: impl Fn(&Formula) -> bool,
    within: impl Fn(&Formula, u8) -> String,
) -> Vec<String> {
    let closes = |place: usize| factors.get(place + 1).is_none_or(|next| matches!(next, Formula::Call(..)));
    let one = |(place, factor): (usize, &Formula)| {
        within(factor, if is_open(factor) && !closes(place) { u8::MAX } else { 2 })
    };
    factors.iter().enumerate().map(one).collect()
}
