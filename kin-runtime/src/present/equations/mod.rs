//! The derivation for people: joint by joint, each with its own equation first, then its rows of Φ, Φ_q, Φ_t and γ.
//!
//! The formulas are those of the graph that the code was emitted from, as the tables of the mechanism hold them.

mod document;
mod own;
mod text;
mod write;

pub(crate) use document::{latex, latex_fragment, page};
pub(crate) use text::text;

use crate::model::{EquationText, JointInfo, Level, Model};
use kin_core::notation::{Formula, Name, Notation};

/// A row with its formulas.
struct Row<'m> {
    name: &'static str,
    level: Level,
    phi: Shown<'m>,
    /// Coordinates with the entries of Φ_q.
    phi_q: Vec<(&'m str, Shown<'m>)>,
    phi_t: Shown<'m>,
    gamma: Shown<'m>,
}

/// A formula, or a text that was too long to be one.
enum Shown<'m> {
    Formula(Formula),
    Text(&'m str),
}

impl<'m> Shown<'m> {
    fn new(text: &'m str) -> Self {
        Formula::parse(text).map_or(Self::Text(text), |formula| Self::Formula(formula.tidied()))
    }

    fn write(&self, notation: Notation) -> String {
        match (self, notation) {
            (Self::Formula(formula), _) => formula.write(notation),
            (Self::Text(text), Notation::Unicode) => (*text).to_owned(),
            (Self::Text(text), Notation::Latex) => {
                format!(r"\text{{{}}}", text.replace('_', r"\_").replace('^', r"\^{}"))
            }
            (Self::Text(text), Notation::MathMl) => format!("<mtext>{}</mtext>", super::drawing::escaped(text)),
        }
    }
}

/// Those that are chosen, by their places; all where none is.
fn joints<'m>(model: &'m Model, chosen: &'m [usize]) -> impl Iterator<Item = &'m JointInfo> {
    let all = model.joints.iter().enumerate();
    all.filter(|(place, _)| chosen.is_empty() || chosen.contains(place)).map(|(_, joint)| joint)
}

/// The rows of a joint.
fn rows<'m>(model: &'m Model, joint: &JointInfo) -> Vec<Row<'m>> {
    let range = joint.first_row..joint.first_row + joint.rows;
    let row = |place: usize| -> Option<Row<'m>> {
        let (info, text): (_, &'m EquationText) = (model.rows.get(place)?, model.equations.get(place)?);
        Some(Row {
            name: info.name,
            level: info.level,
            phi: Shown::new(text.phi),
            phi_q: text.phi_q.iter().map(|&(name, entry)| (name, Shown::new(entry))).collect(),
            phi_t: Shown::new(text.phi_t),
            gamma: Shown::new(text.gamma),
        })
    };
    range.filter_map(row).collect()
}

/// `revolute, crank – coupler`.
fn what(model: &Model, joint: &JointInfo) -> String {
    let name = |frame| super::text::frame_name(model, frame);
    let frames: Vec<&str> = joint.frames.iter().flatten().map(|&frame| name(frame)).collect();
    match frames.is_empty() {
        true => joint.kind.to_string(),
        false => format!("{}, {}", joint.kind, frames.join(" – ")),
    }
}

/// A coordinate's symbol.
fn symbol(name: &str, notation: Notation) -> String {
    Name::new(name).write(notation)
}
