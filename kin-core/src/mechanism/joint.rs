//! Joints, drivers and free equations, which contribute rows to Φ; masses and loads, which do not; guesses.

use super::{BodyRef, Component, Formula, Member, Operands, Range};
use crate::error::Origin;

/// A joint, driver or equation, or a family of them over a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The name without index.
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

/// A mass or a load, or a family of them; its name is the keyword if none is given.
pub type Load = Joint;

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
