//! The range of an index variable.

use crate::ast::RangeDecl;
use kin_core::mechanism::Range;

/// The range of an item's index variable.
#[derive(Clone, Debug)]
pub(super) enum IndexRange {
    /// No index variable.
    None,
    /// A range: `i in start..end`.
    Over(RangeDecl),
    /// The members are counted without an index variable: the name of the family and their number.
    Counted(String, usize),
    /// The brackets could not be read; the words that may be index variables. Without words, every single letter may
    /// be one.
    Unknown(Vec<String>),
}

impl IndexRange {
    /// The range for the model.
    pub(super) fn model(&self) -> Option<Range> {
        match self {
            Self::Over(range) => Some(Range { start: range.start, end: range.end }),
            Self::None | Self::Counted(..) | Self::Unknown(_) => None,
        }
    }
}
