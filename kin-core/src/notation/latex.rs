//! Writes formulas as LaTeX.

use super::name::{BaseSymbol, Name, greek};
use super::parts::{self, SumSigns};
use super::tree::FormulaTree;

pub(super) fn write(formula: &FormulaTree) -> String {
    match formula {
        FormulaTree::Number(value) => number(*value),
        FormulaTree::Name(own) => name(own),
        FormulaTree::Minus(a) => format!("-{}", within(a, 2)),
        FormulaTree::Sum(parts) => terms(parts).concat(),
        FormulaTree::Product(factors) => parts::factors(factors, is_open, within).join(r"\,"),
        FormulaTree::Quotient(a, b) => format!(r"\frac{{{}}}{{{}}}", write(a), write(b)),
        FormulaTree::Power(a, n) => format!("{}^{{{}}}", powered(a), signed(*n)),
        FormulaTree::Call(function, primes, arguments) => call(function, *primes, arguments),
    }
}

/// The signs in sums.
pub(super) const SIGNS: SumSigns = SumSigns { first: "-", plus: " + ", minus: " - " };

/// The terms of a sum with their signs.
fn terms(parts: &[(bool, FormulaTree)]) -> Vec<String> {
    parts::terms(parts, &SIGNS, within)
}

/// True for a function whose argument is written without brackets.
fn is_open(formula: &FormulaTree) -> bool {
    match formula {
        FormulaTree::Call(function, 0, arguments) => {
            known(function).is_some() && matches!(arguments[..], [FormulaTree::Name(_)])
        }
        _ => false,
    }
}

/// The LaTeX command of a function, if there is one.
fn known(function: &str) -> Option<String> {
    parts::is_known(function).then(|| match function {
        "asin" | "acos" | "atan" => format!(r"\arc{}", &function[1..]),
        _ => format!(r"\{function}"),
    })
}

fn call(function: &str, primes: usize, arguments: &[FormulaTree]) -> String {
    let list = arguments.iter().map(write).collect::<Vec<_>>().join(", ");
    match (function, known(function)) {
        ("sqrt", _) => format!(r"\sqrt{{{list}}}"),
        ("abs", _) => format!(r"\left|{list}\right|"),
        (_, Some(known)) if primes == 0 && matches!(arguments, [FormulaTree::Name(_)]) => {
            match list.starts_with('\\') {
                true => format!("{known}{list}"),
                false => format!("{known} {list}"),
            }
        }
        (_, Some(known)) => format!(r"{known}\left({list}\right)"),
        _ => format!(r"\operatorname{{{}}}{}\left({list}\right)", upright(function), "'".repeat(primes)),
    }
}

fn within(formula: &FormulaTree, least: u8) -> String {
    if formula.strength() < least { bracketed(formula) } else { write(formula) }
}

/// The base of a power, in brackets unless it is a single symbol or a number without a power of ten.
fn powered(formula: &FormulaTree) -> String {
    match formula {
        FormulaTree::Name(own) => name(own),
        FormulaTree::Number(value) if !number(*value).contains('^') => number(*value),
        _ => bracketed(formula),
    }
}

fn bracketed(formula: &FormulaTree) -> String {
    format!(r"\left({}\right)", write(formula))
}

fn signed(value: f64) -> String {
    if value < 0.0 { format!("-{}", number(-value)) } else { number(value) }
}

/// A number with all digits; very large or small numbers with a power of ten.
fn number(value: f64) -> String {
    let plain = value.to_string();
    if plain.len() <= 18 {
        return plain;
    }
    match format!("{value:e}").split_once('e') {
        Some((digits, power)) => format!(r"{digits}\cdot 10^{{{power}}}"),
        None => plain,
    }
}

pub(super) fn name(name: &Name) -> String {
    let letter = match &name.base {
        BaseSymbol::Letter(letter) => letter.to_string(),
        BaseSymbol::Greek(name, _) => command(name),
        BaseSymbol::Word(word) => format!(r"\mathrm{{{}}}", upright(word)),
    };
    let dotted = match name.order {
        0 => letter,
        1 => format!(r"\dot{{{letter}}}"),
        _ => format!(r"\ddot{{{letter}}}"),
    };
    if name.index.is_empty() {
        return dotted;
    }
    let index = name.index.iter().map(|index| match index.bytes().all(|b| b.is_ascii_digit()) {
        true => index.clone(),
        false => format!(r"\mathrm{{{}}}", upright(index)),
    });
    format!("{dotted}_{{{}}}", index.collect::<Vec<_>>().join(","))
}

/// The command for a Greek letter.
pub(crate) fn command(greek: &str) -> String {
    match greek {
        "phi" | "epsilon" => format!(r"\var{greek}"),
        _ => format!(r"\{greek}"),
    }
}

/// A word in upright letters, with commands for Greek letters and special characters.
pub(crate) fn upright(word: &str) -> String {
    let mut out = String::new();
    for c in word.chars() {
        match (c, greek(c)) {
            (_, Some(name)) => out.push_str(&format!("{{{}}}", command(name))),
            ('_' | '#', None) => out.extend(['\\', c]),
            (_, None) => out.push(c),
        }
    }
    out
}
