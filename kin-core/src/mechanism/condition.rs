//! Unilateral conditions: inequalities that are monitored during a motion but not solved as equations.

use super::{Formula, Range};
use crate::error::Origin;
use core::fmt;

/// Which side of a condition is to be larger.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// left > right.
    Greater,
    /// left < right.
    Less,
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Greater => ">",
            Self::Less => "<",
        })
    }
}

/// A unilateral condition, or a family of them over a range. Its name shares a namespace with the rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// The name without index.
    pub name: String,
    /// The range of a family.
    pub range: Option<Range>,
    /// The condition as the user wrote it.
    pub text: String,
    /// The left side.
    pub left: Formula,
    /// Which side is to be larger.
    pub relation: Relation,
    /// The right side.
    pub right: Formula,
    /// The token of the keyword.
    pub keyword: Origin,
    /// The token of the name.
    pub origin: Origin,
}
