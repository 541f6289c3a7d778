//! What may stand in an expression, by where it stands.

use super::lowerer::Class;
use super::range::IndexRange;

/// What may stand in an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Allow {
    /// Numbers and parameters.
    Parameters,
    /// Also t and inputs.
    Signals,
    /// Also scalar coordinates.
    Scalars,
    /// Also coordinates.
    Everything,
    /// Coordinates, of which `dot` takes the rates.
    Dotted,
    /// Also rates: `dot(…)`.
    Rates,
}

impl Allow {
    pub(super) const fn class(self) -> Class {
        match self {
            Self::Parameters => Class::Constant,
            Self::Signals | Self::Scalars => Class::Signal,
            Self::Everything | Self::Dotted | Self::Rates => Class::Coordinate,
        }
    }
}

/// Where an expression stands.
pub(super) struct Scope<'s> {
    /// For messages: "a body-fixed point", "`length`".
    pub(super) what: &'s str,
    pub(super) allow: Allow,
    pub(super) range: &'s IndexRange,
}
