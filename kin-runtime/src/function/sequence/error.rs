//! What is wrong with a sequence.

use core::fmt;

/// Segments that make no motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SequenceError {
    /// A sequence has at least one segment.
    Empty,
    /// NaN or infinity: in the start (no segment), or in a segment.
    NonFinite {
        /// Number of the segment, from 0.
        segment: Option<usize>,
    },
    /// A duration is greater than 0, and than what rounding leaves of it so far from the start.
    Duration {
        /// Number of the segment, from 0.
        segment: usize,
        /// Its duration.
        duration: f64,
    },
    /// A polynomial segment begins with a constant term: the position would jump.
    Jump {
        /// Number of the segment, from 0.
        segment: usize,
        /// By how much.
        by: f64,
    },
    /// A periodic sequence ends where it begins.
    NotPeriodic {
        /// Position at the start.
        start: f64,
        /// Position at the end.
        end: f64,
    },
}

impl fmt::Display for SequenceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a sequence has at least one segment"),
            Self::NonFinite { segment: None } => f.write_str("the start of the sequence is not a finite number"),
            Self::NonFinite { segment: Some(segment) } => {
                write!(f, "segment {segment} holds a number that is not finite")
            }
            Self::Duration { segment, duration } => {
                write!(f, "the duration of segment {segment} is {duration}; it is greater than 0")
            }
            Self::Jump { segment, by } => write!(
                f,
                "segment {segment} jumps by {by} at its start; a polynomial is the displacement from there, without a \
                 constant term"
            ),
            Self::NotPeriodic { start, end } => {
                write!(f, "a periodic sequence ends where it begins; this one begins at {start} and ends at {end}")
            }
        }
    }
}

impl core::error::Error for SequenceError {}
