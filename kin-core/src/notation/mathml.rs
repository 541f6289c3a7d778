//! Presentation MathML, which browsers show without a script and without a network.

use super::name::{Base, Name};
use super::tree::Formula;

pub(super) fn write(formula: &Formula) -> String {
    match formula {
        Formula::Number(value) => format!("<mn>{value}</mn>"),
        Formula::Name(own) => name(own),
        Formula::Minus(a) => format!("<mrow><mo>−</mo>{}</mrow>", within(a, 2)),
        Formula::Sum(terms) => {
            let mut out = String::from("<mrow>");
            for (place, (minus, term)) in terms.iter().enumerate() {
                match (place, minus) {
                    (0, false) => {}
                    (_, false) => out.push_str("<mo>+</mo>"),
                    (_, true) => out.push_str("<mo>−</mo>"),
                }
                out.push_str(&within(term, if *minus || place > 0 { 2 } else { 1 }));
            }
            out + "</mrow>"
        }
        Formula::Product(factors) => {
            let factors: Vec<String> = factors.iter().map(|factor| within(factor, 2)).collect();
            // An invisible sign of multiplication, with the distance that a reader expects.
            format!("<mrow>{}</mrow>", factors.join("<mo>&#x2062;</mo><mspace width=\"0.15em\"/>"))
        }
        Formula::Quotient(a, b) => format!("<mfrac>{}{}</mfrac>", write(a), write(b)),
        Formula::Power(a, n) => {
            let n =
                if *n < 0.0 { format!("<mrow><mo>−</mo><mn>{}</mn></mrow>", -n) } else { format!("<mn>{n}</mn>") };
            format!("<msup>{}{n}</msup>", within(a, 5))
        }
        Formula::Call(function, primes, arguments) => call(function, *primes, arguments),
    }
}

fn call(function: &str, primes: usize, arguments: &[Formula]) -> String {
    let list = arguments.iter().map(write).collect::<Vec<_>>().join("<mo>,</mo>");
    match function {
        "sqrt" => return format!("<msqrt>{list}</msqrt>"),
        "abs" => return format!("<mrow><mo>|</mo>{list}<mo>|</mo></mrow>"),
        _ => {}
    }
    let function = format!("<mi>{}{}</mi><mo>&#x2061;</mo>", escaped(function), "′".repeat(primes));
    match arguments {
        [Formula::Name(_)] if primes == 0 => format!("<mrow>{function}<mspace width=\"0.15em\"/>{list}</mrow>"),
        _ => format!("<mrow>{function}<mo>(</mo>{list}<mo>)</mo></mrow>"),
    }
}

fn within(formula: &Formula, least: u8) -> String {
    match formula.strength() < least {
        true => format!("<mrow><mo>(</mo>{}<mo>)</mo></mrow>", write(formula)),
        false => write(formula),
    }
}

pub(super) fn name(name: &Name) -> String {
    let letter = match &name.base {
        Base::Letter(letter) | Base::Greek(_, letter) => format!("<mi>{letter}</mi>"),
        Base::Word(word) => format!("<mi>{}</mi>", escaped(word)),
    };
    let dotted = match name.order {
        0 => letter,
        1 => format!("<mover accent=\"true\">{letter}<mo>˙</mo></mover>"),
        _ => format!("<mover accent=\"true\">{letter}<mo>¨</mo></mover>"),
    };
    if name.index.is_empty() {
        return dotted;
    }
    let index = name.index.iter().map(|index| match index.bytes().all(|b| b.is_ascii_digit()) {
        true => format!("<mn>{index}</mn>"),
        false => format!("<mi mathvariant=\"normal\">{}</mi>", escaped(index)),
    });
    format!("<msub>{dotted}<mrow>{}</mrow></msub>", index.collect::<Vec<_>>().join("<mo>,</mo>"))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
