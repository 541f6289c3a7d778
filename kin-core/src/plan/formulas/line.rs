//! The formulas of a plan as lines of text.

use crate::plan::step::StepId;

/// The formulas of a step, in the user's names. If the coordinates of a step are not found one directly after another,
/// the step has one entry for each uninterrupted sequence of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Formulas {
    /// The step.
    pub step: StepId,
    /// A description in words.
    pub what: String,
    /// The lines for q, q̇ and q̈.
    pub lines: [Vec<Line>; 3],
}

/// A line; its expressions are written as by [`ConstraintSet::show`](crate::ConstraintSet::show).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// The definition of a name.
    Equation {
        /// A coordinate, its rate or acceleration (`_dot`, `_ddot`), or a name that later lines use.
        left: String,
        /// The expression.
        right: String,
    },
    /// A residual that an iteration brings to zero.
    Zero {
        /// The name of the residual.
        left: String,
        /// The expression of the residual.
        right: String,
    },
    /// The linear system matrix · unknowns = right.
    System {
        /// The matrix, row by row.
        matrix: Vec<Vec<String>>,
        /// The unknowns: coordinates, rates or accelerations.
        unknowns: Vec<String>,
        /// The right-hand side, one entry per row.
        right: Vec<String>,
    },
}
