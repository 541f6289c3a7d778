//! The range that an index variable runs over.

use crate::ast::RangeDecl;
use kin_core::mechanism::Range;

/// The range that the index variable of an item runs over.
#[derive(Clone, Debug)]
pub(super) enum IndexRange {
    /// No index variable.
    None,
    /// `i in start..end`.
    Over(RangeDecl),
    /// The brackets could not be read.
    Unknown,
}

impl IndexRange {
    /// The range in the model.
    pub(super) fn model(&self) -> Option<Range> {
        match self {
            Self::Over(range) => Some(Range { start: range.start, end: range.end }),
            Self::None | Self::Unknown => None,
        }
    }
}
