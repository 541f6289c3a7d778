//! Writes formulas as plain text: φ̇_crank, l₁/2, products separated by spaces.

use super::name::{BaseSymbol, Name};
use super::parts::{self, SumSigns};
use super::tree::FormulaTree;

pub(super) fn write(formula: &FormulaTree) -> String {
    match formula {
        FormulaTree::Number(value) => value.to_string(),
        FormulaTree::Name(own) => name(own),
        FormulaTree::Minus(a) => format!("−{}", within(a, 2)),
        FormulaTree::Sum(parts) => terms(parts).concat(),
        FormulaTree::Product(factors) => product(factors, false),
        FormulaTree::Quotient(a, b) => format!("{}/{}", within(a, 4), within(b, 4)),
        FormulaTree::Power(a, n) => match superscript(*n) {
            Some(n) => format!("{}{n}", within(a, 5)),
            None => format!("{}^{n}", within(a, 5)),
        },
        FormulaTree::Call(function, primes, arguments) => call(function, *primes, arguments),
    }
}

/// The signs in sums.
pub(super) const SIGNS: SumSigns = SumSigns { first: "−", plus: " + ", minus: " − " };

/// The terms of a sum with their signs.
fn terms(parts: &[(bool, FormulaTree)]) -> Vec<String> {
    parts::terms(parts, &SIGNS, within)
}

/// A product, to which more factors are added behind it if `goes_on`. A fraction is put in brackets unless it is the last
/// factor, because a factor behind a slash would seem to be part of the denominator.
pub(super) fn product(factors: &[FormulaTree], goes_on: bool) -> String {
    let mut texts = parts::factors(factors, is_open, within);
    let before = factors.len().saturating_sub(usize::from(!goes_on));
    for (text, factor) in texts.iter_mut().zip(factors).take(before) {
        if matches!(factor, FormulaTree::Quotient(..)) {
            *text = format!("({text})");
        }
    }
    texts.join(" ")
}

/// True for functions that are written as `sin φ` instead of `sin(φ)`.
fn is_open(formula: &FormulaTree) -> bool {
    match formula {
        FormulaTree::Call(function, 0, arguments) => is_trigonometric(function) && is_short(arguments),
        _ => false,
    }
}

fn is_trigonometric(function: &str) -> bool {
    matches!(function, "sin" | "cos" | "tan")
}

fn is_short(arguments: &[FormulaTree]) -> bool {
    matches!(arguments, [FormulaTree::Name(_)])
}

fn call(function: &str, primes: usize, arguments: &[FormulaTree]) -> String {
    let list = arguments.iter().map(write).collect::<Vec<_>>().join(", ");
    match function {
        "sqrt" => format!("√({list})"),
        "abs" => format!("|{list}|"),
        _ if primes == 0 && is_trigonometric(function) && is_short(arguments) => format!("{function} {list}"),
        _ => format!("{function}{}({list})", "′".repeat(primes)),
    }
}

/// The formula, in brackets if it binds less tightly than `least`.
fn within(formula: &FormulaTree, least: u8) -> String {
    // The slash of a quotient would capture the argument of a function without brackets.
    let loose = formula.strength() < least || least > 3 && is_open(formula);
    if loose { format!("({})", write(formula)) } else { write(formula) }
}

pub(super) fn name(name: &Name) -> String {
    let letter = match &name.base {
        BaseSymbol::Letter(letter) | BaseSymbol::Greek(_, letter) => letter.to_string(),
        BaseSymbol::Word(word) => word.clone(),
    };
    let mut out = dotted(letter, name.order);
    let digits = name.index.iter().take_while(|index| index.bytes().all(|b| b.is_ascii_digit())).count();
    let small: Vec<String> = name.index[..digits].iter().map(|index| subscript(index)).collect();
    out.push_str(&small.join(","));
    if digits < name.index.len() {
        out.push('_');
        let owner: Vec<String> = name.index[digits..]
            .iter()
            .enumerate()
            .map(|(place, index)| if place == 0 { index.clone() } else { subscript(index) })
            .collect();
        out.push_str(&owner.concat());
    }
    out
}

/// A letter with dots; precomposed characters are preferred, because many fonts place combining dots badly.
fn dotted(letter: String, order: usize) -> String {
    match (letter.as_str(), order) {
        (_, 0) => letter,
        ("x", 1) => "ẋ".to_owned(),
        ("x", _) => "ẍ".to_owned(),
        ("y", 1) => "ẏ".to_owned(),
        ("y", _) => "ÿ".to_owned(),
        (_, 1) => letter + "\u{307}",
        _ => letter + "\u{308}",
    }
}

fn subscript(digits: &str) -> String {
    let small = |c: char| c.to_digit(10).and_then(|d| char::from_u32(0x2080 + d)).unwrap_or(c);
    digits.chars().map(small).collect()
}

fn superscript(n: f64) -> Option<String> {
    let small = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    (n.fract() == 0.0 && n.abs() < 1e6).then(|| {
        let text = n.to_string();
        text.chars().map(|c| c.to_digit(10).map_or('⁻', |d| small[d as usize])).collect()
    })
}
