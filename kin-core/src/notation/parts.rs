//! Terms of sums and factors of products, in whatever notation, and sums over several lines.

use super::tree::Formula;
use super::{Notation, latex, mathml, unicode};

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

impl Formula {
    /// The formula in a notation, broken before the signs of its terms where it would take more than so many columns as
    /// plain text.
    pub fn lines(&self, notation: Notation, width: usize) -> Vec<String> {
        let Self::Sum(parts) = self else { return vec![self.write(notation)] };
        let terms = match notation {
            Notation::Unicode => unicode::terms(parts),
            Notation::Latex => latex::terms(parts),
            Notation::MathMl => mathml::terms(parts),
        };
        let (mut lines, mut taken) = (vec![String::new()], 0);
        for (term, plain) in terms.iter().zip(unicode::terms(parts)) {
            let columns = plain.chars().count();
            if taken > 0 && taken + columns > width {
                lines.push(String::new());
                taken = 0;
            }
            taken += columns;
            if let Some(line) = lines.last_mut() {
                line.push_str(term);
            }
        }
        lines
    }
}
