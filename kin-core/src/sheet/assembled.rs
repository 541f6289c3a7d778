//! The rows of all joints put together: Φ, Φ_q, Φ_t and γ of the mechanism as matrices.

use super::content::{Rows, Sheet};
use super::lines::EquationLine;
use super::shown::{Row, ShownFormula, symbol};
use super::steps::bracketed;
use crate::notation::{FormulaTree, Notation};

/// Maximum numbers of coordinates and of rows of a mechanism whose matrices are written in addition to its joints.
const MAX_MATRIX_SIZE: usize = 24;
/// Width, in columns of plain text, of an entry of Φ_q and of an entry of a column vector.
const ENTRY: [usize; 2] = [24, 72];

/// Matrices with names for entries that are too long.
pub(super) struct Assembled {
    pub(super) matrices: Vec<Matrix>,
    /// Entries that were too long, with the names that stand for them.
    pub(super) long: Vec<EquationLine>,
    /// The symbols of the coordinates.
    pub(super) coordinates: Vec<String>,
}

pub(super) struct Matrix {
    name: &'static str,
    /// The entries row by row.
    entries: Vec<Vec<String>>,
    /// The names of the rows: Φ has no rows of velocity level.
    rows: Vec<String>,
}

impl Sheet {
    /// The matrices of the whole mechanism. `None` if only the joints are to be written, or if the matrices are written
    /// in addition to the joints and would be too large to be read.
    pub(super) fn assembled(&self, notation: Notation) -> Option<Assembled> {
        let rows: Vec<&Row> = self.joints.iter().flat_map(|joint| &joint.rows).collect();
        let wanted = match self.rows {
            Rows::ByJoint => false,
            Rows::Both => rows.len() <= MAX_MATRIX_SIZE && self.coordinates.len() <= MAX_MATRIX_SIZE,
            Rows::Together => true,
        };
        if !wanted || rows.is_empty() {
            return None;
        }
        let mut long = Vec::new();
        let mut entry = |shown: &ShownFormula, most: usize| {
            if shown.write(Notation::Unicode).chars().count() <= most {
                return shown.write(notation);
            }
            let name = numbered(long.len() + 1, notation);
            long.push(EquationLine { left: name.clone(), right: shown.lines(notation, most.max(ENTRY[1])) });
            name
        };
        let zero = ShownFormula::Formula(FormulaTree::Number(0.0));
        let column = |rows: &[&Row],
                      entry: &mut dyn FnMut(&ShownFormula, usize) -> String,
                      expression: fn(&Row) -> &ShownFormula| {
            rows.iter().map(|row| vec![entry(expression(row), ENTRY[1])]).collect::<Vec<_>>()
        };
        let positions: Vec<&Row> = rows.iter().copied().filter(|row| row.position).collect();
        let phi = column(&positions, &mut entry, |row| &row.phi);
        let of_row = |row: &&Row| {
            let entry_by = |coordinate: &String| row.phi_q.iter().find(|(name, _)| name == coordinate);
            self.coordinates
                .iter()
                .map(|name| entry(entry_by(name).map_or(&zero, |(_, shown)| shown), ENTRY[0]))
                .collect()
        };
        let phi_q = rows.iter().map(of_row).collect();
        let phi_t = column(&rows, &mut entry, |row| &row.phi_t);
        let gamma = column(&rows, &mut entry, |row| &row.gamma);
        let named = |name, entries, rows: &[&Row]| {
            let rows = rows.iter().map(|row| row.name.clone()).collect();
            Matrix { name, entries, rows }
        };
        let phi = (!positions.is_empty()).then(|| named("Φ", phi, &positions));
        let others = [("Φ_q", phi_q), ("Φ_t", phi_t), ("γ", gamma)];
        let others = others.into_iter().map(|(name, entries)| named(name, entries, &rows));
        Some(Assembled {
            matrices: phi.into_iter().chain(others).collect(),
            long,
            coordinates: self.coordinates.iter().map(|name| symbol(name, notation)).collect(),
        })
    }
}

impl Assembled {
    /// One equation per matrix, then the equations of names for long entries.
    pub(super) fn lines(self, notation: Notation) -> Vec<EquationLine> {
        let q = self.coordinates.iter().map(|name| vec![name.clone()]).collect();
        let q = EquationLine { left: called("q", notation), right: vec![bracketed(q, notation)] };
        let matrix = |matrix: Matrix| {
            let right = vec![bracketed(matrix.entries, notation)];
            EquationLine { left: called(matrix.name, notation), right }
        };
        std::iter::once(q).chain(self.matrices.into_iter().map(matrix)).chain(self.long).collect()
    }

    /// The matrices as text, each with the names of its rows beside it, and Φ_q with the names of its columns above it.
    pub(super) fn text(&self) -> String {
        let mut out = String::new();
        for Matrix { name, entries, rows } in &self.matrices {
            let head = (*name == "Φ_q").then_some(&self.coordinates[..]);
            out.push('\n');
            out.push_str(&matrix(name, head, entries, rows));
        }
        out
    }
}

/// The name for a long entry, which cannot be a name of the mechanism.
fn numbered(number: usize, notation: Notation) -> String {
    match notation {
        Notation::Unicode => format!("⟨{number}⟩"),
        Notation::Latex => format!(r"\langle {number}\rangle"),
        Notation::MathMl => format!("<mrow><mo>⟨</mo><mn>{number}</mn><mo>⟩</mo></mrow>"),
    }
}

fn called(name: &str, notation: Notation) -> String {
    let latex = |letter: &str| letter.replace('Φ', r"\Phi").replace('γ', r"\gamma");
    match (notation, name.split_once('_')) {
        (Notation::Unicode, _) => name.to_owned(),
        (Notation::Latex, _) => latex(name),
        (Notation::MathMl, Some((letter, index))) => {
            format!("<msub><mi mathvariant=\"normal\">{letter}</mi><mi>{index}</mi></msub>")
        }
        (Notation::MathMl, None) => format!("<mi mathvariant=\"normal\">{name}</mi>"),
    }
}

/// A matrix of text in brackets, its columns aligned.
fn matrix(name: &str, head: Option<&[String]>, rows: &[Vec<String>], names: &[String]) -> String {
    let width = |text: &String| super::text::shown(text);
    let columns = rows.first().map_or(0, Vec::len);
    let widest = |column: usize| {
        let entries = rows.iter().map(|row| &row[column]).chain(head.and_then(|head| head.get(column)));
        entries.map(width).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(widest).collect();
    let line = |entries: &[String]| -> String {
        let padded =
            entries.iter().zip(&widths).map(|(entry, most)| format!("{}{entry}", " ".repeat(most - width(entry))));
        padded.collect::<Vec<_>>().join("  ")
    };
    let indent = " ".repeat(super::text::shown(name) + 3);
    let mut out = head.map_or_else(String::new, |head| format!("    {indent}  {}\n", line(head)));
    for (index, row) in rows.iter().enumerate() {
        let (open, close) = match (index, index + 1 == rows.len()) {
            (0, true) => ("[", "]"),
            (0, false) => ("⎡", "⎤"),
            (_, true) => ("⎣", "⎦"),
            _ => ("⎢", "⎥"),
        };
        let before = if index == 0 { format!("{name} = ") } else { indent.clone() };
        let row_name = names.get(index).map_or("", String::as_str);
        out.push_str(&format!("    {before}{open} {} {close}  {row_name}\n", line(row)));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_of_text_is_aligned() {
        let texts = |list: &[&str]| list.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
        let rows = [texts(&["1", "−l sin φ"]), texts(&["0", "l cos φ"])];
        let shown = matrix("Φ_q", Some(&texts(&["x", "φ"])), &rows, &texts(&["A.x", "A.y"]));
        assert_eq!(shown, "            x         φ\n    Φ_q = ⎡ 1  −l sin φ ⎤  A.x\n          ⎣ 0   l cos φ ⎦  A.y\n");
    }
}
