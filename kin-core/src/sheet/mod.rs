//! The derivation for people: joint by joint, each with its own equation first, then its rows of Φ, Φ_q, Φ_t and γ, and
//! how the solution plan solves them; as text, LaTeX, a page, and documentation of the struct.
//!
//! A sheet is made of texts that were printed from the graph that the code is emitted from: by [`Sheet::of_system`] where
//! that graph is at hand, or from the tables of a compiled mechanism.

mod docs;
mod html;
mod latex;
mod lines;
mod of_system;
mod steps;
mod text;

pub use steps::{Line, Step};

use crate::joints;
use crate::notation::{Formula, Name, Notation, escaped};
use crate::vectors::{Equation, NamedJoint};

/// All of it.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// The mechanism's name.
    pub name: String,
    /// First paragraph of its documentation.
    pub doc: String,
    /// Entries of q.
    pub coordinates: Vec<String>,
    /// Joints, constraints and drivers.
    pub joints: Vec<Joint>,
    /// How they are solved, step by step.
    pub steps: Vec<Step>,
    /// Why there are no steps, where that is worth saying.
    pub unsolved: String,
}

/// A joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// `revolute, crank – coupler`.
    pub what: String,
    /// Names of those that are alike: other members of its family, where they are not written out.
    pub alike: Vec<String>,
    /// Its own equations, in vectors.
    own: Vec<Equation>,
    /// Its rows.
    pub rows: Vec<Row>,
}

/// A row with its formulas.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// False for a row of velocity level: η, its B and b stand for Φ, Φ_q and Φ_t.
    pub position: bool,
    /// Φ.
    pub phi: Shown,
    /// Coordinates with the entries of Φ_q that are not 0.
    pub phi_q: Vec<(String, Shown)>,
    /// Φ_t.
    pub phi_t: Shown,
    /// γ.
    pub gamma: Shown,
}

impl Joint {
    /// A joint without rows yet.
    pub fn new(joint: &NamedJoint<'_>) -> Self {
        let keyword = joint.kind.keyword();
        let frames: Vec<&str> = joint.frames.iter().flatten().map(|body| body.unwrap_or("ground")).collect();
        let what = match frames.is_empty() {
            true => keyword.to_owned(),
            false => format!("{keyword}, {}", frames.join(" – ")),
        };
        let (name, own) = (joint.name.to_owned(), joints::vector_equations(joint));
        Self { name, what, alike: Vec::new(), own, rows: Vec::new() }
    }
}

/// A formula, or a text that was too long to be one.
#[derive(Clone, Debug)]
pub enum Shown {
    /// A formula, tidied.
    Formula(Formula),
    /// As it was printed.
    Text(String),
}

impl Shown {
    /// Reads what the graph prints.
    pub fn new(text: &str) -> Self {
        Formula::parse(text).map_or_else(|_| Self::Text(text.to_owned()), |formula| Self::Formula(formula.tidied()))
    }

    /// On one line.
    fn write(&self, notation: Notation) -> String {
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

/// A name's symbol.
fn symbol(name: &str, notation: Notation) -> String {
    Name::new(name).write(notation)
}
