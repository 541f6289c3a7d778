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
    /// The brackets could not be read.
    Unknown,
}

impl IndexRange {
    /// The range for the model.
    pub(super) fn model(&self) -> Option<Range> {
        match self {
            Self::Over(range) => Some(Range { start: range.start, end: range.end }),
            Self::None | Self::Unknown => None,
        }
    }
}
