//! Writes formulas as LaTeX.

use super::name::{BaseSymbol, Name};
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
fn known(function: &str) -> Option<&'static str> {
    Some(match function {
        "sin" => r"\sin",
        "cos" => r"\cos",
        "tan" => r"\tan",
        "asin" => r"\arcsin",
        "acos" => r"\arccos",
        "atan" => r"\arctan",
        "exp" => r"\exp",
        "ln" => r"\ln",
        _ => return None,
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

/// The base of a power, in brackets unless it is a single symbol.
fn powered(formula: &FormulaTree) -> String {
    match formula {
        FormulaTree::Number(_) | FormulaTree::Name(_) => write(formula),
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
        BaseSymbol::Greek("phi", _) => r"\varphi".to_owned(),
        BaseSymbol::Greek("epsilon", _) => r"\varepsilon".to_owned(),
        BaseSymbol::Greek(greek, _) => format!(r"\{greek}"),
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

/// A word in text mode, with special characters escaped.
fn upright(word: &str) -> String {
    word.replace('_', r"\_").replace('#', r"\#")
}
