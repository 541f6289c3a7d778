//! What is wrong with a table.

use core::fmt;

/// A table that no spline goes through.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SplineError {
    /// As many abscissae as values are needed.
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
    /// NaN or infinity.
    NonFinite {
        /// `abscissae`, `values`, `slopes`, or `coefficients`, when the numbers are too far apart for a spline.
        what: &'static str,
        /// Place in it.
        index: usize,
    },
    /// Abscissae increase strictly.
    NotIncreasing {
        /// Place of the abscissa that does not lie behind its predecessor.
        index: usize,
        /// The abscissa before it.
        before: f64,
        /// The abscissa.
        found: f64,
    },
    /// The first and the last value of a periodic table are the same point, and differ.
    NotPeriodic {
        /// First value.
        first: f64,
        /// Last value.
        last: f64,
    },
}

impl fmt::Display for SplineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lengths { abscissae, values } => {
                write!(f, "a table has as many abscissae as values; here are {abscissae} and {values}")
            }
            Self::TooFewPoints { found, needed } => {
                write!(f, "a spline goes through at least {needed} points; the table has {found}")
            }
            Self::NonFinite { what: "coefficients", index } => {
                write!(f, "the numbers of the table are too far apart: piece {index} has no finite coefficients")
            }
            Self::NonFinite { what, index } => write!(f, "{what}[{index}] is not a finite number"),
            Self::NotIncreasing { index, before, found } => {
                write!(f, "abscissae increase; abscissa {index} is {found} and the one before it {before}")
            }
            Self::NotPeriodic { first, last } => write!(
                f,
                "a periodic table ends with the value it begins with; this one begins with {first} and ends with {last}"
            ),
        }
    }
}

impl core::error::Error for SplineError {}
