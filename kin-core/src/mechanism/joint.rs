//! Joints, drivers and free equations, which contribute rows to Φ; masses and loads, which do not; and guesses.

use super::{BodyRef, Component, Formula, Member, Operands, Range};
use crate::error::Origin;

/// A joint, driver or equation, or a family of them over a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name without index.
    pub name: String,
    /// Range, when repeated.
    pub range: Option<Range>,
    /// What it says.
    pub operands: Operands,
    /// The keyword's token.
    pub keyword: Origin,
    /// The name's token.
    pub origin: Origin,
}

/// A mass or a load, or a family of them; without a name of its own it has that of its keyword.
pub type Load = Joint;

/// What a guess sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GuessTarget {
    /// A coordinate of a body.
    Pose(BodyRef, Component),
    /// A scalar coordinate.
    Scalar(Member),
}

/// The start of assembly for one coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// Which coordinate.
    pub target: GuessTarget,
    /// Its value, a formula of parameters.
    pub value: Formula,
    /// Range, when repeated.
    pub range: Option<Range>,
    /// The target's token.
    pub origin: Origin,
}
