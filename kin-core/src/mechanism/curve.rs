//! Curves fixed in a body, in polar, implicit or parametric form.

use super::{Formula, Member};
use crate::error::Origin;

/// A curve fixed in a body, with its centre at the point of the first operand.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// `polar(theta) = e`: the distance ρ(θ) from the centre, which must be 2π-periodic.
    Polar {
        /// The formula of ρ.
        radius: Formula,
        /// The tokens of ρ.
        origin: Origin,
    },
    /// `implicit(X, Y) = e`: the points where e vanishes.
    Implicit {
        /// The formula e.
        value: Formula,
        /// The tokens of e.
        origin: Origin,
    },
    /// `parametric(u) = (ex, ey)`: the points c(u), or those of a parallel curve if there is a roller.
    Parametric {
        /// The scalar coordinate u.
        parameter: Member,
        /// The first component of c.
        x: Formula,
        /// The second component of c.
        y: Formula,
        /// The signed radius R of the roller, positive to the left of the direction of increasing u.
        roller: Option<Formula>,
        /// The tokens of the pair.
        origin: Origin,
    },
}

impl Curve {
    /// The keyword of the form.
    pub const fn keyword(&self) -> &'static str {
        match self {
            Self::Polar { .. } => "polar",
            Self::Implicit { .. } => "implicit",
            Self::Parametric { .. } => "parametric",
        }
    }

    /// The formulas of the curve.
    pub fn formulas(&self) -> Vec<&Formula> {
        match self {
            Self::Polar { radius, .. } => vec![radius],
            Self::Implicit { value, .. } => vec![value],
            Self::Parametric { x, y, roller, .. } => [x, y].into_iter().chain(roller).collect(),
        }
    }
}
