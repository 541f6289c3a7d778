//! Writes formulas as Presentation MathML, which browsers display without scripts or network access.

use super::markup::escaped;
use super::name::{BaseSymbol, Name};
use super::parts::{self, SumSigns};
use super::tree::FormulaTree;

pub(super) fn write(formula: &FormulaTree) -> String {
    match formula {
        FormulaTree::Number(value) => format!("<mn>{value}</mn>"),
        FormulaTree::Name(own) => name(own),
        FormulaTree::Minus(a) => format!("<mrow><mo>−</mo>{}</mrow>", within(a, 2)),
        FormulaTree::Sum(parts) => format!("<mrow>{}</mrow>", terms(parts).concat()),
        FormulaTree::Product(factors) => {
            // A function of a single name is written without brackets, as in the other notations.
            let factors = parts::factors(factors, is_open, within);
            // An invisible multiplication sign and the usual space.
            format!("<mrow>{}</mrow>", factors.join("<mo>&#x2062;</mo><mspace width=\"0.15em\"></mspace>"))
        }
        FormulaTree::Quotient(a, b) => format!("<mfrac>{}{}</mfrac>", write(a), write(b)),
        FormulaTree::Power(a, n) => {
            let n =
                if *n < 0.0 { format!("<mrow><mo>−</mo><mn>{}</mn></mrow>", -n) } else { format!("<mn>{n}</mn>") };
            match a.as_ref() {
                // The exponent is placed above the index, not behind it.
                FormulaTree::Name(own) => powered(own, Some(&n)),
                _ => format!("<msup>{}{n}</msup>", within(a, 5)),
            }
        }
        FormulaTree::Call(function, primes, arguments) => call(function, *primes, arguments),
    }
}

/// The signs in sums.
pub(super) const SIGNS: SumSigns = SumSigns { first: "<mo>−</mo>", plus: "<mo>+</mo>", minus: "<mo>−</mo>" };

/// The terms of a sum with their signs.
fn terms(parts: &[(bool, FormulaTree)]) -> Vec<String> {
    parts::terms(parts, &SIGNS, within)
}

/// True for a function whose argument is written without brackets.
fn is_open(formula: &FormulaTree) -> bool {
    match formula {
        FormulaTree::Call(function, 0, arguments) => {
            parts::is_known(function) && matches!(arguments[..], [FormulaTree::Name(_)])
        }
        _ => false,
    }
}

fn call(function: &str, primes: usize, arguments: &[FormulaTree]) -> String {
    let list = arguments.iter().map(write).collect::<Vec<_>>().join("<mo>,</mo>");
    match function {
        "sqrt" => return format!("<msqrt>{list}</msqrt>"),
        "abs" => return format!("<mrow><mo>|</mo>{list}<mo>|</mo></mrow>"),
        _ => {}
    }
    let is_open = primes == 0 && parts::is_known(function);
    let function = format!("<mi>{}{}</mi><mo>&#x2061;</mo>", escaped(function), "′".repeat(primes));
    match arguments {
        [FormulaTree::Name(_)] if is_open => {
            format!("<mrow>{function}<mspace width=\"0.15em\"></mspace>{list}</mrow>")
        }
        _ => format!("<mrow>{function}<mo>(</mo>{list}<mo>)</mo></mrow>"),
    }
}

fn within(formula: &FormulaTree, least: u8) -> String {
    match formula.strength() < least {
        true => format!("<mrow><mo>(</mo>{}<mo>)</mo></mrow>", write(formula)),
        false => write(formula),
    }
}

pub(super) fn name(name: &Name) -> String {
    powered(name, None)
}

/// A name with an optional exponent.
fn powered(name: &Name, power: Option<&str>) -> String {
    let letter = match &name.base {
        BaseSymbol::Letter(letter) | BaseSymbol::Greek(_, letter) => format!("<mi>{letter}</mi>"),
        BaseSymbol::Word(word) => format!("<mi>{}</mi>", escaped(word)),
    };
    let dotted = match name.order {
        0 => letter,
        // As an accent the dot would touch the letter if no mathematical font is installed.
        1 => format!("<mover>{letter}<mo scriptlevel=\"0\" stretchy=\"false\">˙</mo></mover>"),
        _ => format!("<mover>{letter}<mo scriptlevel=\"0\" stretchy=\"false\">¨</mo></mover>"),
    };
    if name.index.is_empty() {
        return power.map_or(dotted.clone(), |power| format!("<msup>{dotted}{power}</msup>"));
    }
    let index = name.index.iter().map(|index| match index.bytes().all(|b| b.is_ascii_digit()) {
        true => format!("<mn>{index}</mn>"),
        false => format!("<mi mathvariant=\"normal\">{}</mi>", escaped(index)),
    });
    let index = format!("<mrow>{}</mrow>", index.collect::<Vec<_>>().join("<mo>,</mo>"));
    match power {
        None => format!("<msub>{dotted}{index}</msub>"),
        Some(power) => format!("<msubsup>{dotted}{index}{power}</msubsup>"),
    }
}
