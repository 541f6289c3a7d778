//! Joints, drivers and free equations, which contribute rows to Φ; masses and loads, which do not; guesses.

use super::{BodyRef, Component, Formula, Member, Operands, Range};
use crate::error::Origin;

/// A joint, a driver, an equation, a mass or a load, or a family of them over a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// The name without index; the keyword, for a mass or a load without a name.
    pub name: String,
    /// The range of a family.
    pub range: Option<Range>,
    /// The operands.
    pub operands: Operands,
    /// The token of the keyword.
    pub keyword: Origin,
    /// The token of the name.
    pub origin: Origin,
}

/// The coordinate that a guess is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GuessTarget {
    /// A component of a body's pose.
    Pose(BodyRef, Component),
    /// A scalar coordinate.
    Scalar(Member),
}

/// The start value of one coordinate for assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// The coordinate.
    pub target: GuessTarget,
    /// The value, a formula of parameters.
    pub value: Formula,
    /// The range of a family.
    pub range: Option<Range>,
    /// The token of the coordinate.
    pub origin: Origin,
}
