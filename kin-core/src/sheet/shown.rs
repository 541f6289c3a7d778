//! Rows and formulas of a sheet.

use crate::notation::{FormulaTree, Name, Notation, escaped};

/// A row with its formulas.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// False for a row of velocity level; `phi`, `phi_q` and `phi_t` are then η and the row of B and b.
    pub position: bool,
    /// Φ.
    pub phi: ShownFormula,
    /// Coordinates with the entries of Φ_q that are not 0.
    pub phi_q: Vec<(String, ShownFormula)>,
    /// Φ_t.
    pub phi_t: ShownFormula,
    /// γ.
    pub gamma: ShownFormula,
}

/// A formula, or a text that cannot be parsed as one, for example because it was cut off.
#[derive(Clone, Debug)]
pub enum ShownFormula {
    /// A simplified formula.
    Formula(FormulaTree),
    /// The text as the graph printed it.
    Text(String),
}

impl ShownFormula {
    /// Reads the text that the graph prints.
    pub fn new(text: &str) -> Self {
        FormulaTree::parse(text).map_or_else(|_| Self::Text(text.to_owned()), |formula| Self::Formula(formula.tidied()))
    }

    /// The formula on one line.
    pub(super) fn write(&self, notation: Notation) -> String {
        match (self, notation) {
            (Self::Formula(formula), _) => formula.write(notation),
            (Self::Text(text), Notation::Unicode) => text.clone(),
            (Self::Text(text), Notation::Latex) => {
                format!(r"\text{{{}}}", text.replace('_', r"\_").replace('^', r"\^{}"))
            }
            (Self::Text(text), Notation::MathMl) => format!("<mtext>{}</mtext>", escaped(text)),
        }
    }
}

/// The symbol of a name.
pub(super) fn symbol(name: &str, notation: Notation) -> String {
    Name::new(name).write(notation)
}

/// The symbol of the rate of a name.
pub(super) fn rate_symbol(name: &str, notation: Notation) -> String {
    match name.strip_suffix('`') {
        Some(verbatim) => symbol(&format!("{verbatim}_dot`"), notation),
        None => symbol(&format!("{name}_dot"), notation),
    }
}
