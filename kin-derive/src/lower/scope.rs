//! The parts that an expression may contain, depending on its place.

use super::lowerer::Class;
use super::range::IndexRange;

/// The parts that an expression may contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Allow {
    /// Numbers and parameters only.
    Parameters,
    /// In addition t and inputs.
    Signals,
    /// The same, on the right-hand side of a row that a `constraint` can express with coordinates.
    RightSide,
    /// In addition scalar coordinates.
    Scalars,
    /// In addition all coordinates.
    Everything,
    /// All coordinates, inside of `dot`, which takes their rates.
    InsideDot,
    /// All coordinates and their rates: `dot(…)`.
    Rates,
}

impl Allow {
    pub(super) const fn class(self) -> Class {
        match self {
            Self::Parameters => Class::Constant,
            Self::Signals | Self::RightSide => Class::Signal,
            Self::Scalars => Class::Scalar,
            Self::Everything | Self::InsideDot | Self::Rates => Class::Coordinate,
        }
    }
}

/// The place of an expression.
pub(super) struct Scope<'s> {
    /// A description for messages: "a body-fixed point", "`length`".
    pub(super) place: &'s str,
    pub(super) allow: Allow,
    pub(super) range: &'s IndexRange,
}
