//! The derivation as text: the equations of every row, and what every step of the solution plan computes.

/// The equations of one joint as text.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EquationText {
    /// Name of the row.
    pub row: &'static str,
    /// Φ; for a row of velocity level η, with B in `phi_q` and b in `phi_t`.
    pub phi: &'static str,
    /// Non-zero entries of Φ_q as (coordinate, expression).
    pub phi_q: &'static [(&'static str, &'static str)],
    /// Φ_t.
    pub phi_t: &'static str,
    /// γ.
    pub gamma: &'static str,
}

/// What a step of the solution plan computes, as text in the user's names. A step whose coordinates are computed in
/// several parts of the sequence has several entries.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepText {
    /// Index in [`Plan::steps`](crate::plan::Plan::steps).
    pub step: usize,
    /// A description of the step.
    pub what: &'static str,
    /// Lines for q, q̇ and q̈.
    pub lines: [&'static [LineText]; 3],
}

/// A line of a [`StepText`].
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineText {
    /// The value of a name: a coordinate, its rate or acceleration (`_dot`, `_ddot`), or a name that later lines use.
    Equation {
        /// The name.
        left: &'static str,
        /// Its value.
        right: &'static str,
    },
    /// An expression that an iteration makes zero.
    Zero {
        /// Its name.
        left: &'static str,
        /// Its value.
        right: &'static str,
    },
    /// matrix · unknowns = right.
    System {
        /// Row by row.
        matrix: &'static [&'static [&'static str]],
        /// Coordinates, or their rates or accelerations.
        unknowns: &'static [&'static str],
        /// The right-hand sides, one per row.
        right: &'static [&'static str],
    },
}
