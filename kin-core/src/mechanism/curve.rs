//! Curves fixed in a body, in one of three ways of writing.

use super::{Formula, Member};
use crate::error::Origin;

/// A curve fixed in a body, with its centre at the first operand's point.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// `polar(theta) = e`: the distance ρ(θ) from the centre, 2π-periodic.
    Polar {
        /// ρ.
        radius: Formula,
        /// The tokens of ρ.
        origin: Origin,
    },
    /// `implicit(X, Y) = e`: the points at which e vanishes.
    Implicit {
        /// e.
        value: Formula,
        /// The tokens of e.
        origin: Origin,
    },
    /// `parametric(u) = (ex, ey)`: the points c(u), or those of its parallel curve where a roller runs on it.
    Parametric {
        /// u, a scalar coordinate.
        parameter: Member,
        /// First component of c.
        x: Formula,
        /// Second component.
        y: Formula,
        /// R: signed distance of the parallel curve, positive to the left of growing u.
        roller: Option<Formula>,
        /// The tokens of the pair.
        origin: Origin,
    },
}

impl Curve {
    /// The keyword with which it is written.
    pub const fn keyword(&self) -> &'static str {
        match self {
            Self::Polar { .. } => "polar",
            Self::Implicit { .. } => "implicit",
            Self::Parametric { .. } => "parametric",
        }
    }

    /// Its formulas.
    pub fn formulas(&self) -> Vec<&Formula> {
        match self {
            Self::Polar { radius, .. } => vec![radius],
            Self::Implicit { value, .. } => vec![value],
            Self::Parametric { x, y, roller, .. } => [x, y].into_iter().chain(roller).collect(),
        }
    }
}
