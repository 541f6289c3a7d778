//! Writes formulas as LaTeX.

use super::name::{Base, Name};
use super::parts::{self, Signs};
use super::tree::Formula;

pub(super) fn write(formula: &Formula) -> String {
    match formula {
        Formula::Number(value) => number(*value),
        Formula::Name(own) => name(own),
        Formula::Minus(a) => format!("-{}", within(a, 2)),
        Formula::Sum(parts) => terms(parts).concat(),
        Formula::Product(factors) => parts::factors(factors, is_open, within).join(r"\,"),
        Formula::Quotient(a, b) => format!(r"\frac{{{}}}{{{}}}", write(a), write(b)),
        Formula::Power(a, n) => format!("{}^{{{}}}", powered(a), signed(*n)),
        Formula::Call(function, primes, arguments) => call(function, *primes, arguments),
    }
}

/// The signs in sums.
pub(super) const SIGNS: Signs = Signs { first: "-", plus: " + ", minus: " - " };

/// The terms of a sum with their signs.
fn terms(parts: &[(bool, Formula)]) -> Vec<String> {
    parts::terms(parts, &SIGNS, within)
}

/// True for a function whose argument is written without brackets.
fn is_open(formula: &Formula) -> bool {
    match formula {
        Formula::Call(function, 0, arguments) => {
            known(function).is_some() && matches!(arguments[..], [Formula::Name(_)])
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

fn call(function: &str, primes: usize, arguments: &[Formula]) -> String {
    let list = arguments.iter().map(write).collect::<Vec<_>>().join(", ");
    match (function, known(function)) {
        ("sqrt", _) => format!(r"\sqrt{{{list}}}"),
        ("abs", _) => format!(r"\left|{list}\right|"),
        (_, Some(known)) if primes == 0 && matches!(arguments, [Formula::Name(_)]) => match list.starts_with('\\') {
            true => format!("{known}{list}"),
            false => format!("{known} {list}"),
        },
        (_, Some(known)) => format!(r"{known}\left({list}\right)"),
        _ => format!(r"\operatorname{{{}}}{}\left({list}\right)", upright(function), "'".repeat(primes)),
    }
}

fn within(formula: &Formula, least: u8) -> String {
    if formula.strength() < least { bracketed(formula) } else { write(formula) }
}

/// The base of a power, in brackets unless it is a single symbol.
fn powered(formula: &Formula) -> String {
    match formula {
        Formula::Number(_) | Formula::Name(_) => write(formula),
        _ => bracketed(formula),
    }
}

fn bracketed(formula: &Formula) -> String {
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
        Base::Letter(letter) => letter.to_string(),
        Base::Greek("phi", _) => r"\varphi".to_owned(),
        Base::Greek("epsilon", _) => r"\varepsilon".to_owned(),
        Base::Greek(greek, _) => format!(r"\{greek}"),
        Base::Word(word) => format!(r"\mathrm{{{}}}", upright(word)),
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
