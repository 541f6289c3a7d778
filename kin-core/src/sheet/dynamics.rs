//! The equations of motion on a sheet: M q̈ + Φ_qᵀ λ = Q and the entries of M and Q.

use super::content::{Dynamics, Sheet};
use super::html::{WIDTH as PAGE, math, table};
use super::latex::{display, equation};
use super::lines::EquationLine;
use super::shown::symbol;
use super::text::aligned;
use crate::notation::Notation::{self, Latex, MathMl, Unicode};

/// Columns of plain text on a page of LaTeX.
const PRINTED: usize = 80;

impl Dynamics {
    fn lines(&self, notation: Notation, width: usize) -> Vec<EquationLine> {
        let mass = self.mass.iter().map(|(names, entry)| EquationLine {
            left: indexed("M", &[&names[0], &names[1]], notation),
            right: entry.lines(notation, width),
        });
        let forces = self.forces.iter().map(|(name, entry)| EquationLine {
            left: indexed("Q", &[name], notation),
            right: entry.lines(notation, width),
        });
        mass.chain(forces).collect()
    }
}

/// A letter with the symbols of coordinates as its indices.
fn indexed(letter: &str, names: &[&str], notation: Notation) -> String {
    let symbols: Vec<String> = names.iter().map(|name| symbol(name, notation)).collect();
    match notation {
        Unicode => format!("{letter}[{}]", symbols.join(", ")),
        Latex => format!("{letter}_{{{}}}", symbols.join(",\\,")),
        MathMl => format!("<msub><mi>{letter}</mi><mrow>{}</mrow></msub>", symbols.join("<mo>,</mo>")),
    }
}

/// The text above the entries.
const WORDS: &str = "M is symmetric, and entries of M and Q that are not written are 0. Joints and drivers exert";

impl Sheet {
    pub(super) fn text_dynamics(&self) -> String {
        let Some(dynamics) = &self.dynamics else { return String::new() };
        let lines = aligned(dynamics.lines(Unicode, usize::MAX));
        format!("\nForces\n    M q̈ + Φ_qᵀ λ = Q\n    {WORDS} −Φ_qᵀ λ.\n\n{lines}")
    }

    pub(super) fn latex_dynamics(&self) -> String {
        let Some(dynamics) = &self.dynamics else { return String::new() };
        let lines: Vec<String> = dynamics.lines(Latex, PRINTED).iter().map(equation).collect();
        let law = display(&[r"M \ddot q + \Phi_q^{\mathsf T} \lambda &= Q".to_owned()]);
        let words = WORDS.replace("M ", "$M$ ").replace("Q ", "$Q$ ");
        format!("\\section*{{Forces}}\n{law}{words} $-\\Phi_q^{{\\mathsf T}} \\lambda$.\n{}", display(&lines))
    }

    /// Paragraphs and tables without a heading.
    pub(super) fn html_dynamics(&self) -> Option<String> {
        let dynamics = self.dynamics.as_ref()?;
        let transposed = "<msubsup><mi mathvariant=\"normal\">Φ</mi><mi>q</mi><mtext>T</mtext></msubsup><mi>λ</mi>";
        let q_ddot = "<mover><mi>q</mi><mo>¨</mo></mover>";
        let law = math(&format!("<mi>M</mi>{q_ddot}<mo>+</mo>{transposed}<mo>=</mo><mi>Q</mi>"));
        let exerted = math(&format!("<mo>−</mo>{transposed}"));
        let lines = table(dynamics.lines(MathMl, PAGE).into_iter());
        Some(format!("<div class=\"kin-eq\"><p>{law}</p></div>\n<p>{WORDS} {exerted}.</p>\n{lines}"))
    }
}
