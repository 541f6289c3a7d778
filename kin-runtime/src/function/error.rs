//! Errors in the numbers of a supplied function.

use core::fmt;

/// Why a table does not define a spline, or segments do not define a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FunctionError {
    /// The numbers of abscissae and values differ.
    Lengths {
        /// Number of abscissae.
        abscissae: usize,
        /// Number of values.
        values: usize,
    },
    /// Too few points.
    TooFewPoints {
        /// Number of points.
        found: usize,
        /// The smallest number: 2, or 3 for a periodic spline.
        needed: usize,
    },
    /// NaN or infinity in a table.
    NonFinite {
        /// The list: `abscissae`, `values`, `slopes`, or `coefficients`, when the numbers of the table are too far
        /// apart for finite coefficients.
        what: &'static str,
        /// Index in that list.
        index: usize,
    },
    /// The abscissae do not increase strictly.
    NotIncreasing {
        /// Index of the abscissa that does not exceed its predecessor.
        index: usize,
        /// The abscissa before it.
        before: f64,
        /// The abscissa.
        found: f64,
    },
    /// The sequence has no segment.
    Empty,
    /// NaN or infinity: in the start of a sequence (no segment), or in a segment.
    NonFiniteSegment {
        /// Index of the segment, from 0; `None` for the start of the sequence.
        segment: Option<usize>,
    },
    /// The duration is not positive, or is lost by rounding so far from the start.
    Duration {
        /// Index of the segment, from 0.
        segment: usize,
        /// The duration of the segment.
        duration: f64,
    },
    /// A polynomial segment has a constant term, so that the position would jump.
    Jump {
        /// Index of the segment, from 0.
        segment: usize,
        /// The constant term, by which the position would jump.
        by: f64,
    },
    /// A periodic function does not end with the value at its start.
    NotPeriodic {
        /// First value.
        first: f64,
        /// Last value.
        last: f64,
    },
}

impl fmt::Display for FunctionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lengths { abscissae, values } => {
                write!(f, "a table must have as many abscissae as values; there are {abscissae} and {values}")
            }
            Self::TooFewPoints { found, needed } => {
                write!(f, "a spline must have at least {needed} points; the table has {found}")
            }
            Self::NonFinite { what: "coefficients", index } => {
                write!(f, "the numbers of the table are too far apart: piece {index} has no finite coefficients")
            }
            Self::NonFinite { what, index } => write!(f, "{what}[{index}] is not a finite number"),
            Self::NotIncreasing { index, before, found } => {
                write!(f, "abscissae must increase; abscissa {index} is {found} and the one before it {before}")
            }
            Self::Empty => f.write_str("a sequence must have at least one segment"),
            Self::NonFiniteSegment { segment: None } => f.write_str("the start of the sequence is not a finite number"),
            Self::NonFiniteSegment { segment: Some(segment) } => {
                write!(f, "segment {segment} holds a number that is not finite")
            }
            Self::Duration { segment, duration } => {
                write!(
                    f,
                    "the duration of segment {segment} is {duration}; it must exceed 0 and the rounding of its start"
                )
            }
            Self::Jump { segment, by } => write!(
                f,
                "segment {segment} jumps by {by} at its start; a polynomial is the displacement from there and must \
                 not have a constant term"
            ),
            Self::NotPeriodic { first, last } => {
                write!(
                    f,
                    "a periodic function must end with the value it begins with; this one begins with {first} and ends \
                     with {last}"
                )
            }
        }
    }
}

impl core::error::Error for FunctionError {}
