//! The equations of a row in every notation; a right side may be broken into several lines.

use super::shown::{Row, ShownFormula, rate_symbol, symbol};
use crate::notation::{Notation, escaped, upright};

/// An equation.
pub(super) struct EquationLine {
    /// The left side.
    pub(super) left: String,
    /// The right side, one entry per line.
    pub(super) right: Vec<String>,
}

impl ShownFormula {
    /// The right side broken into lines of at most `width` columns.
    pub(super) fn lines(&self, notation: Notation, width: usize) -> Vec<String> {
        match self {
            Self::Formula(formula) => formula.lines(notation, width),
            Self::Text(_) => vec![self.write(notation)],
        }
    }
}

/// ` = 0` in a notation.
pub(super) fn zero(notation: Notation) -> &'static str {
    match notation {
        Notation::Unicode | Notation::Latex => " = 0",
        Notation::MathMl => "<mo>=</mo><mn>0</mn>",
    }
}

/// The equation Φ = 0 of a row.
pub(super) fn row_equation(row: &Row, notation: Notation, width: usize) -> EquationLine {
    let mut right = row.phi.lines(notation, width);
    if let Some(last) = right.last_mut() {
        last.push_str(zero(notation));
    }
    EquationLine { left: of_row(phi(row), &row.name, notation), right }
}

/// The derivatives of a row: the entries of Φ_q that are not 0, Φ_t and γ.
pub(super) fn derivatives(row: &Row, notation: Notation, width: usize) -> Vec<EquationLine> {
    let line = |left: String, shown: &ShownFormula| EquationLine { left, right: shown.lines(notation, width) };
    let phi = of_row(phi(row), &row.name, notation);
    let by = |coordinate: &str| match row.position {
        true => symbol(coordinate, notation),
        false => rate_symbol(coordinate, notation),
    };
    let partial = |by: &str| match notation {
        Notation::Unicode => format!("∂{phi}/∂{by}"),
        Notation::Latex => format!(r"\frac{{\partial {phi}}}{{\partial {by}}}"),
        Notation::MathMl => {
            format!("<mfrac><mrow><mo>∂</mo>{phi}</mrow><mrow><mo>∂</mo>{by}</mrow></mfrac>")
        }
    };
    let entries = row.phi_q.iter().map(|(coordinate, entry)| line(partial(&by(coordinate)), entry));
    let rest = match (row.position, notation) {
        (true, Notation::MathMl) => partial("<mi>t</mi>"),
        (true, _) => partial("t"),
        (false, Notation::Unicode) => format!("{phi}(q̇ = 0)"),
        (false, Notation::Latex) => format!(r"{phi}\big|_{{\dot q = 0}}"),
        (false, Notation::MathMl) => {
            format!("{phi}<mo>(</mo>{}<mo>=</mo><mn>0</mn><mo>)</mo>", symbol("q_dot", notation))
        }
    };
    let gamma = of_row("γ", &row.name, notation);
    entries.chain([line(rest, &row.phi_t), line(gamma, &row.gamma)]).collect()
}

fn phi(row: &Row) -> &'static str {
    if row.position { "Φ" } else { "η" }
}

/// A letter with the name of a row as its index.
fn of_row(letter: &str, name: &str, notation: Notation) -> String {
    match notation {
        Notation::Unicode => letter.to_owned(),
        Notation::Latex => {
            let letter = match letter {
                "Φ" => r"\Phi",
                "η" => r"\eta",
                _ => r"\gamma",
            };
            format!(r"{letter}_{{\mathrm{{{}}}}}", upright(name))
        }
        Notation::MathMl => {
            let upright = if letter == "Φ" { " mathvariant=\"normal\"" } else { "" };
            format!("<msub><mi{upright}>{letter}</mi><mi mathvariant=\"normal\">{}</mi></msub>", escaped(name))
        }
    }
}
