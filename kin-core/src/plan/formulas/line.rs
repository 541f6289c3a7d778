//! What is written of a plan for people: lines for every step.

use crate::plan::step::StepId;

/// What a step computes, in the user's names; a step whose coordinates come at several places is there several times.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Formulas {
    /// The step.
    pub step: StepId,
    /// What it is, in words.
    pub what: String,
    /// Lines for q, q̇ and q̈.
    pub lines: [Vec<Line>; 3],
}

/// A line; expressions are written as [`ConstraintSet::show`](crate::ConstraintSet::show) writes them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// What a name is.
    Equation {
        /// A coordinate, a rate or acceleration of one (`_dot`, `_ddot`), or a name that later lines use.
        left: String,
        /// Its value.
        right: String,
    },
    /// What an iteration brings to zero.
    Zero {
        /// Its name.
        left: String,
        /// Its value.
        right: String,
    },
    /// matrix · unknowns = right.
    System {
        /// Row by row.
        matrix: Vec<Vec<String>>,
        /// Coordinates, or their rates or accelerations.
        unknowns: Vec<String>,
        /// As many as rows.
        right: Vec<String>,
    },
}
