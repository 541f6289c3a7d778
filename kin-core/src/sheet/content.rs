//! The contents of a sheet.

use super::shown::{Row, ShownFormula};
use super::steps::SheetStep;
use crate::joints;
use crate::vectors::{Equation, NamedJoint};

/// The derivation of a mechanism.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// The mechanism's name.
    pub name: String,
    /// The first paragraph of the mechanism's documentation.
    pub doc: String,
    /// The coordinates in q.
    pub coordinates: Vec<String>,
    /// Joints, constraints and drivers.
    pub joints: Vec<Joint>,
    /// How the rows of the joints are written.
    pub rows: Rows,
    /// The steps of the solution plan.
    pub steps: Vec<SheetStep>,
    /// The reason why there are no steps; empty if it need not be shown.
    pub unsolved: String,
    /// M and Q of a mechanism with masses or loads.
    pub dynamics: Option<Dynamics>,
}

/// How rows are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rows {
    /// Joint by joint.
    #[default]
    ByJoint,
    /// Joint by joint, then all together as matrices; for sheets with all joints.
    Both,
    /// As matrices only; for sheets with all joints.
    Together,
}

impl Sheet {
    /// The joints that are written one by one.
    pub(super) fn joints_written(&self) -> &[Joint] {
        if self.rows == Rows::Together { &[] } else { &self.joints }
    }
}

/// The mass matrix M and the generalized forces Q, with the names of their coordinates.
#[derive(Clone, Debug, Default)]
pub struct Dynamics {
    /// Entries of the symmetric M that are not 0, each once.
    pub mass: Vec<([String; 2], ShownFormula)>,
    /// Entries of Q that are not 0.
    pub forces: Vec<(String, ShownFormula)>,
}

impl Dynamics {
    /// M and Q from the names of the coordinates and from the texts that the graph prints.
    pub fn new<'t>(
        coordinates: &[String],
        mass: impl IntoIterator<Item = (usize, usize, &'t str)>,
        forces: impl IntoIterator<Item = &'t str>,
    ) -> Self {
        let entry = |(row, column, text): (usize, usize, &str)| {
            ([row, column].map(|k| coordinates[k].clone()), ShownFormula::new(text))
        };
        let not_zero = coordinates.iter().zip(forces).filter(|(_, text)| *text != "0");
        Self {
            mass: mass.into_iter().map(entry).collect(),
            forces: not_zero.map(|(name, text)| (name.clone(), ShownFormula::new(text))).collect(),
        }
    }
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
    pub(super) vector_equations: Vec<Equation>,
    /// Its rows.
    pub rows: Vec<Row>,
}

impl Joint {
    /// A joint whose rows are still to be added.
    pub fn new(joint: &NamedJoint<'_>) -> Self {
        let keyword = joint.kind.keyword();
        let frames: Vec<&str> = joint.frames.iter().flatten().map(|body| body.unwrap_or("ground")).collect();
        let what = match frames.is_empty() {
            true => keyword.to_owned(),
            false => format!("{keyword}, {}", frames.join(" – ")),
        };
        let (name, vector_equations) = (joint.name.to_owned(), joints::vector_equations(joint));
        Self { name, what, alike: Vec::new(), vector_equations, rows: Vec::new() }
    }
}
