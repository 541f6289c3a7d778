//! Writes the terms of sums and the factors of products, for any notation.

use super::tree::FormulaTree;

/// The signs that a notation writes in sums.
pub(super) struct SumSigns {
    /// A minus sign in front of the first term.
    pub(super) first: &'static str,
    /// A plus sign between terms.
    pub(super) plus: &'static str,
    /// A minus sign between terms.
    pub(super) minus: &'static str,
}

impl SumSigns {
    /// The sign before the term at `index`.
    pub(super) fn before(&self, index: usize, minus: bool) -> &'static str {
        match (index, minus) {
            (0, false) => "",
            (0, true) => self.first,
            (_, false) => self.plus,
            (_, true) => self.minus,
        }
    }
}

/// True for a function of the language with an argument that may be written without brackets. Of other functions, f t
/// would be read as a product.
pub(super) fn is_known(function: &str) -> bool {
    matches!(function, "sin" | "cos" | "tan" | "asin" | "acos" | "atan" | "exp" | "ln")
}

/// The terms of a sum with their signs; `within` writes a formula, in brackets if it binds less tightly than given.
pub(super) fn terms(
    terms: &[(bool, FormulaTree)],
    signs: &SumSigns,
    within: impl Fn(&FormulaTree, u8) -> String,
) -> Vec<String> {
    let written_term = |(index, (minus, term)): (usize, &(bool, FormulaTree))| {
        format!("{}{}", signs.before(index, *minus), within(term, if *minus || index > 0 { 2 } else { 1 }))
    };
    terms.iter().enumerate().map(written_term).collect()
}

/// The factors of a product. A function without brackets around its argument (`is_open`) must be followed by functions
/// only; otherwise it is put in brackets.
pub(super) fn factors(
    factors: &[FormulaTree],
    is_open: impl Fn(&FormulaTree) -> bool,
    within: impl Fn(&FormulaTree, u8) -> String,
) -> Vec<String> {
    let closes = |index: usize| factors.get(index + 1).is_none_or(|next| matches!(next, FormulaTree::Call(..)));
    let written_factor = |(index, factor): (usize, &FormulaTree)| {
        within(factor, if is_open(factor) && !closes(index) { u8::MAX } else { 2 })
    };
    factors.iter().enumerate().map(written_factor).collect()
}
