//! Writes vector equations in every notation.

use super::equation::{EquationPiece, Letter};
use crate::notation::{Notation, escaped, upright};

/// Writes an equation in a notation.
pub(crate) fn write(pieces: &[EquationPiece], notation: Notation) -> String {
    let texts: Vec<(bool, String)> =
        pieces.iter().map(|piece| (!matches!(piece, EquationPiece::Op(_)), written_piece(piece, notation))).collect();
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

fn written_piece(piece: &EquationPiece, notation: Notation) -> String {
    match piece {
        EquationPiece::Vector(letter) | EquationPiece::Scalar(letter) => symbol(letter, "", notation),
        EquationPiece::Transposed(letter) => symbol(letter, "ᵀ", notation),
        EquationPiece::Squared(letter) => symbol(letter, "²", notation),
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

fn symbol(letter: &Letter, mark: &str, notation: Notation) -> String {
    let prime = if letter.primed { "′" } else { "" };
    let above = letter.above.as_deref().unwrap_or_default();
    match notation {
        Notation::Unicode => {
            let index = letter.index.as_ref().map_or_else(String::new, |index| format!("_{index}"));
            let above = if above.is_empty() { String::new() } else { format!("^{above}") };
            format!("{}{prime}{index}{above}{mark}", letter.letter)
        }
        Notation::Latex => {
            let base = match letter.letter {
                "φ" => r"\varphi".to_owned(),
                "v̂" => r"\hat{\mathbf{v}}".to_owned(),
                "ṙ" => r"\dot{\mathbf{r}}".to_owned(),
                base if letter.bold => format!(r"\mathbf{{{base}}}"),
                base => base.to_owned(),
            };
            let mut upper: Vec<String> = Vec::new();
            upper.extend(letter.primed.then(|| r"\prime".to_owned()));
            upper.extend((!above.is_empty()).then(|| format!(r"\mathrm{{{}}}", upright(above))));
            upper.extend((!mark.is_empty()).then(|| latex_mark(mark).to_owned()));
            let index = letter.index.as_ref().map_or_else(String::new, |i| format!(r"_{{\mathrm{{{}}}}}", upright(i)));
            let upper = if upper.is_empty() { String::new() } else { format!("^{{{}}}", upper.join(r"\,")) };
            format!("{base}{index}{upper}")
        }
        Notation::MathMl => {
            let base = match letter.letter {
                "v̂" => accented('v', '^'),
                "ṙ" => accented('r', '˙'),
                base if letter.bold => format!("<mi>{}</mi>", base.chars().map(bold).collect::<String>()),
                base => format!("<mi>{base}</mi>"),
            };
            let index = letter
                .index
                .as_ref()
                .map_or_else(String::new, |i| format!("<mi mathvariant=\"normal\">{}</mi>", escaped(i)));
            let upper = escaped(&format!("{prime}{above}{mark}"));
            match (index.is_empty(), upper.is_empty()) {
                (true, true) => base,
                (false, true) => format!("<msub>{base}{index}</msub>"),
                (true, false) => format!("<msup>{base}<mtext>{upper}</mtext></msup>"),
                _ => format!("<msubsup>{base}{index}<mtext>{upper}</mtext></msubsup>"),
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
