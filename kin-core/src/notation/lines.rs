//! Breaks long formulas into lines, for any notation.

use super::parts::SumSigns;
use super::tree::FormulaTree;
use super::{Notation, latex, mathml, unicode};

/// The marks of a notation for formulas of several lines. The brackets have a fixed size, because brackets that grow
/// with their content must be closed in the same line.
struct Marks {
    open: &'static str,
    close: &'static str,
    times: &'static str,
    signs: SumSigns,
}

fn marks(notation: Notation) -> Marks {
    match notation {
        Notation::Unicode => Marks { open: "(", close: ")", times: " ", signs: unicode::SIGNS },
        Notation::Latex => Marks { open: r"\bigl(", close: r"\bigr)", times: r"\,", signs: latex::SIGNS },
        Notation::MathMl => Marks {
            open: "<mo stretchy=\"false\">(</mo>",
            close: "<mo stretchy=\"false\">)</mo>",
            times: "<mspace width=\"0.15em\"></mspace>",
            signs: mathml::SIGNS,
        },
    }
}

impl FormulaTree {
    /// The formula as lines of at most `width` columns, measured as plain text, if possible. Lines are broken before
    /// the signs of terms, also inside long sums that are part of the formula.
    pub fn lines(&self, notation: Notation, width: usize) -> Vec<String> {
        let [mut written, mut plain] = [Vec::new(), Vec::new()];
        self.pieces((notation, width), String::new(), &mut written);
        self.pieces((Notation::Unicode, width), String::new(), &mut plain);
        let (mut lines, mut taken) = (vec![String::new()], 0);
        for (piece, plain) in written.iter().zip(&plain) {
            let columns = plain.chars().count();
            if taken > 0 && taken + columns > width {
                lines.push(String::new());
                taken = 0;
            }
            taken += columns;
            if let Some(line) = lines.last_mut() {
                line.push_str(piece);
            }
        }
        lines
    }

    fn columns(&self) -> usize {
        self.write(Notation::Unicode).chars().count()
    }

    /// Splits the formula into pieces that are not broken; `lead` is put in front of the first one.
    fn pieces(&self, (notation, width): (Notation, usize), lead: String, out: &mut Vec<String>) {
        let marks = marks(notation);
        match self {
            Self::Sum(parts) if self.columns() > width / 2 => {
                let mut lead = lead;
                for (index, (minus, term)) in parts.iter().enumerate() {
                    let before = std::mem::take(&mut lead) + marks.signs.before(index, *minus);
                    match term.strength() < 2 {
                        true => out.push(format!("{before}{}{}{}", marks.open, term.write(notation), marks.close)),
                        false => term.pieces((notation, width), before, out),
                    }
                }
            }
            Self::Minus(inner) if inner.strength() >= 2 && self.columns() > width => {
                inner.pieces((notation, width), lead + marks.signs.first, out);
            }
            Self::Product(factors) if self.columns() > width => {
                let sums = (0..factors.len()).filter(|&k| matches!(factors[k], Self::Sum(_)));
                let longest = sums.max_by_key(|&k| factors[k].columns());
                let plain = |k: usize| !factors[..k].iter().any(|factor| matches!(factor, Self::Call(..)));
                let Some(k) = longest.filter(|&k| plain(k)) else { return out.push(lead + &self.write(notation)) };
                let product = |some: &[Self]| Self::Product(some.to_vec()).write(notation);
                let before = match (k, notation) {
                    (0, _) => String::new(),
                    (_, Notation::Unicode) => unicode::product(&factors[..k], true) + marks.times,
                    _ => product(&factors[..k]) + marks.times,
                };
                factors[k].pieces((notation, width), format!("{lead}{before}{}", marks.open), out);
                if let Some(last) = out.last_mut() {
                    last.push_str(marks.close);
                    if k + 1 < factors.len() {
                        last.push_str(marks.times);
                        last.push_str(&product(&factors[k + 1..]));
                    }
                }
            }
            _ => out.push(lead + &self.write(notation)),
        }
    }
}
