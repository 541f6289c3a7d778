//! What a sheet holds.

use super::shown::Row;
use super::steps::Step;
use crate::joints;
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
    /// True where every row is there, so that the matrices of the mechanism can be written.
    pub whole: bool,
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
    pub(super) own: Vec<Equation>,
    /// Its rows.
    pub rows: Vec<Row>,
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
