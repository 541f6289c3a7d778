//! Writes formulas as plain text: φ̇_crank, l₁/2, products separated by spaces.

use super::name::{Base, Name};
use super::parts::{self, Signs};
use super::tree::Formula;

pub(super) fn write(formula: &Formula) -> String {
    match formula {
        Formula::Number(value) => value.to_string(),
        Formula::Name(own) => name(own),
        Formula::Minus(a) => format!("−{}", within(a, 2)),
        Formula::Sum(parts) => terms(parts).concat(),
        Formula::Product(factors) => product(factors),
        Formula::Quotient(a, b) => format!("{}/{}", within(a, 4), within(b, 4)),
        Formula::Power(a, n) => match superscript(*n) {
            Some(n) => format!("{}{n}", within(a, 5)),
            None => format!("{}^{n}", within(a, 5)),
        },
        Formula::Call(function, primes, arguments) => call(function, *primes, arguments),
    }
}

/// The signs in sums.
pub(super) const SIGNS: Signs = Signs { first: "−", plus: " + ", minus: " − " };

/// The terms of a sum with their signs.
fn terms(parts: &[(bool, Formula)]) -> Vec<String> {
    parts::terms(parts, &SIGNS, within)
}

/// A product. A fraction is put in brackets unless it is the last factor, because a factor behind a slash would seem
/// to be part of the denominator.
fn product(factors: &[Formula]) -> String {
    let mut texts = parts::factors(factors, is_open, within);
    let before = factors.len().saturating_sub(1);
    for (text, factor) in texts.iter_mut().zip(factors).take(before) {
        if matches!(factor, Formula::Quotient(..)) {
            *text = format!("({text})");
        }
    }
    texts.join(" ")
}

/// True for functions that are written as `sin φ` instead of `sin(φ)`.
fn is_open(formula: &Formula) -> bool {
    match formula {
        Formula::Call(function, 0, arguments) => is_trigonometric(function) && is_short(arguments),
        _ => false,
    }
}

fn is_trigonometric(function: &str) -> bool {
    matches!(function, "sin" | "cos" | "tan")
}

fn is_short(arguments: &[Formula]) -> bool {
    matches!(arguments, [Formula::Name(_)])
}

fn call(function: &str, primes: usize, arguments: &[Formula]) -> String {
    let list = arguments.iter().map(write).collect::<Vec<_>>().join(", ");
    match function {
        "sqrt" => format!("√({list})"),
        "abs" => format!("|{list}|"),
        _ if primes == 0 && is_trigonometric(function) && is_short(arguments) => format!("{function} {list}"),
        _ => format!("{function}{}({list})", "′".repeat(primes)),
    }
}

/// The formula, in brackets if it binds less tightly than `least`.
fn within(formula: &Formula, least: u8) -> String {
    // The slash of a quotient would capture the argument of a function without brackets.
    let loose = formula.strength() < least || least > 3 && is_open(formula);
    if loose { format!("({})", write(formula)) } else { write(formula) }
}

pub(super) fn name(name: &Name) -> String {
    let letter = match &name.base {
        Base::Letter(letter) | Base::Greek(_, letter) => letter.to_string(),
        Base::Word(word) => word.clone(),
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
