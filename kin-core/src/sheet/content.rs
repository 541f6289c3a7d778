//! The contents of a sheet.

use super::shown::Row;
use super::steps::Step;
use crate::joints;
use crate::vectors::{Equation, NamedJoint};

/// The derivation of a mechanism.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// The mechanism's name.
    pub name: String,
    /// First paragraph of its documentation.
    pub doc: String,
    /// The coordinates in q.
    pub coordinates: Vec<String>,
    /// Joints, constraints and drivers.
    pub joints: Vec<Joint>,
    /// True if all rows are present, so that the matrices of the mechanism can be written.
    pub whole: bool,
    /// The steps of the solution plan.
    pub steps: Vec<Step>,
    /// The reason why there are no steps; empty if it need not be shown.
    pub unsolved: String,
}

/// A joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// `revolute, crank – coupler`.
    pub what: String,
    /// Names of other members of its family with the same equations, which are not written out.
    pub alike: Vec<String>,
    /// Its equations in vectors.
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
