//! Writes vector equations in every notation.

use super::equation::{EquationPiece, Letter};
use crate::notation::{Notation, escaped};

/// Writes an equation in a notation.
pub(crate) fn write(pieces: &[EquationPiece], notation: Notation) -> String {
    let texts: Vec<(bool, String)> =
        pieces.iter().map(|piece| (!matches!(piece, EquationPiece::Op(_)), one(piece, notation))).collect();
    let mut out = String::new();
    for (index, (symbol, text)) in texts.iter().enumerate() {
        // Adjacent factors are separated by a small space.
        if *symbol && index > 0 && texts[index - 1].0 {
            out.push_str(match notation {
                Notation::Unicode => " ",
                Notation::Latex => r"\,",
                Notation::MathMl => "<mspace width=\"0.15em\"></mspace>",
            });
        }
        out.push_str(text);
    }
    out
}

fn one(piece: &EquationPiece, notation: Notation) -> String {
    match piece {
        EquationPiece::Vector(own) | EquationPiece::Scalar(own) => symbol(own, "", notation),
        EquationPiece::Transposed(own) => symbol(own, "ᵀ", notation),
        EquationPiece::Squared(own) => symbol(own, "²", notation),
        EquationPiece::Marked(inner, mark) => {
            let inner = write(inner, notation);
            match notation {
                Notation::Unicode => format!("({inner}){mark}"),
                Notation::Latex => format!(r"\left({inner}\right)^{{{}}}", latex_mark(mark)),
                Notation::MathMl => {
                    format!("<msup><mrow><mo>(</mo>{inner}<mo>)</mo></mrow><mtext>{}</mtext></msup>", mark)
                }
            }
        }
        EquationPiece::Op(text) => match notation {
            Notation::Unicode => (*text).to_owned(),
            Notation::Latex => text.replace('−', "-").replace('Δ', r"\Delta ").replace('φ', r"\varphi"),
            Notation::MathMl => text
                .trim()
                .chars()
                .map(|c| match c.is_alphanumeric() {
                    true if c.is_ascii_digit() => format!("<mn>{c}</mn>"),
                    true => format!("<mi>{c}</mi>"),
                    false => format!("<mo>{c}</mo>"),
                })
                .collect(),
        },
    }
}

fn latex_mark(mark: &str) -> &'static str {
    match mark {
        "⊥ᵀ" => r"\perp\mathsf{T}",
        "ᵀ" => r"\mathsf{T}",
        "²" => "2",
        _ => "",
    }
}

fn symbol(own: &Letter, mark: &str, notation: Notation) -> String {
    let prime = if own.primed { "′" } else { "" };
    let above = own.above.as_deref().unwrap_or_default();
    match notation {
        Notation::Unicode => {
            let index = own.index.as_ref().map_or_else(String::new, |index| format!("_{index}"));
            let above = if above.is_empty() { String::new() } else { format!("^{above}") };
            format!("{}{prime}{index}{above}{mark}", own.letter)
        }
        Notation::Latex => {
            let letter = match own.letter {
                "φ" => r"\varphi".to_owned(),
                "v̂" => r"\hat{\mathbf{v}}".to_owned(),
                "ṙ" => r"\dot{\mathbf{r}}".to_owned(),
                letter if own.bold => format!(r"\mathbf{{{letter}}}"),
                letter => letter.to_owned(),
            };
            let escape = |text: &str| text.replace('_', r"\_");
            let mut upper: Vec<String> = Vec::new();
            upper.extend(own.primed.then(|| r"\prime".to_owned()));
            upper.extend((!above.is_empty()).then(|| format!(r"\mathrm{{{}}}", escape(above))));
            upper.extend((!mark.is_empty()).then(|| latex_mark(mark).to_owned()));
            let index = own.index.as_ref().map_or_else(String::new, |i| format!(r"_{{\mathrm{{{}}}}}", escape(i)));
            let upper = if upper.is_empty() { String::new() } else { format!("^{{{}}}", upper.join(r"\,")) };
            format!("{letter}{index}{upper}")
        }
        Notation::MathMl => {
            let letter = match own.letter {
                "v̂" => accented('v', '^'),
                "ṙ" => accented('r', '˙'),
                letter if own.bold => format!("<mi>{}</mi>", letter.chars().map(bold).collect::<String>()),
                letter => format!("<mi>{letter}</mi>"),
            };
            let index = own
                .index
                .as_ref()
                .map_or_else(String::new, |i| format!("<mi mathvariant=\"normal\">{}</mi>", escaped(i)));
            let upper = escaped(&format!("{prime}{above}{mark}"));
            match (index.is_empty(), upper.is_empty()) {
                (true, true) => letter,
                (false, true) => format!("<msub>{letter}{index}</msub>"),
                (true, false) => format!("<msup>{letter}<mtext>{upper}</mtext></msup>"),
                _ => format!("<msubsup>{letter}{index}<mtext>{upper}</mtext></msubsup>"),
            }
        }
    }
}

/// A bold letter for vectors and matrices; in MathML Core bold letters are separate Unicode characters.
fn bold(letter: char) -> char {
    let (first, start) = if letter.is_ascii_uppercase() { ('A', 0x1d400) } else { ('a', 0x1d41a) };
    let place = u32::from(letter).wrapping_sub(u32::from(first));
    if letter.is_ascii_alphabetic() { char::from_u32(start + place).unwrap_or(letter) } else { letter }
}

fn accented(letter: char, accent: char) -> String {
    format!("<mover><mi>{}</mi><mo scriptlevel=\"0\" stretchy=\"false\">{accent}</mo></mover>", bold(letter))
}
