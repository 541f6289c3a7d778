//! Unilateral conditions: inequalities that are watched along a motion and never solved as equations.

use super::{Formula, Range};
use crate::error::Origin;
use core::fmt;

/// Which side of a condition is the larger one.
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

/// A unilateral condition, or a family of them over a range. Its name lives among those of the rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// Name without index.
    pub name: String,
    /// Range, when repeated.
    pub range: Option<Range>,
    /// Both sides as they were written, for people.
    pub text: String,
    /// Left side.
    pub left: Formula,
    /// Which side is the larger one.
    pub relation: Relation,
    /// Right side.
    pub right: Formula,
    /// The keyword's token.
    pub keyword: Origin,
    /// The name's token.
    pub origin: Origin,
}
