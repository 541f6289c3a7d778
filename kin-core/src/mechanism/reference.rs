//! References in formulas with names resolved: members of families, bodies, variables of curves.

use crate::error::Origin;

/// An index of a family, `scale * i + offset`, where `i` is the index variable of the range.
///
/// A single object has the index 0; `link[3]` has scale 0 and offset 3; `link[i + 1]` inside `N[i in 0..10]: …` has
/// scale 1 and offset 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Index {
    /// The factor of the index variable.
    pub scale: i64,
    /// The constant part.
    pub offset: i64,
}

impl Index {
    /// The constant index `offset`.
    pub const fn constant(offset: i64) -> Self {
        Self { scale: 0, offset }
    }

    /// The value for `i`; `None` if it overflows or is negative.
    pub fn at(self, i: i64) -> Option<usize> {
        let value = self.scale.checked_mul(i)?.checked_add(self.offset)?;
        usize::try_from(value).ok()
    }
}

/// A member of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Member {
    /// The index of the family in its list (`Mechanism::parameters`, `scalars`, `points`, `defines`, …).
    pub family: usize,
    /// The index in the family.
    pub index: Index,
    /// The token of the reference.
    pub origin: Origin,
}

/// A body: the ground or a member of a family of bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BodyRef {
    /// The fixed frame O–xy.
    Ground(Origin),
    /// A member of `Mechanism::bodies`.
    Body {
        /// The index of the family in `Mechanism::bodies`.
        family: usize,
        /// The index in the family.
        index: Index,
        /// The token of the reference.
        origin: Origin,
    },
}

impl BodyRef {
    /// The token of the reference.
    pub const fn origin(&self) -> Origin {
        match self {
            Self::Ground(origin) | Self::Body { origin, .. } => *origin,
        }
    }

    /// A reference to the same body at another token.
    pub const fn at(self, origin: Origin) -> Self {
        match self {
            Self::Ground(_) => Self::Ground(origin),
            Self::Body { family, index, .. } => Self::Body { family, index, origin },
        }
    }

    /// True for the ground.
    pub const fn is_ground(&self) -> bool {
        matches!(self, Self::Ground(_))
    }
}

/// A variable that exists only inside the formulas of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CurveVariable {
    /// The direction θ, the argument of a polar curve or of a support function.
    Theta,
    /// The first coordinate of a point of an implicit curve, in the curve's frame.
    X,
    /// The second coordinate of such a point.
    Y,
}

impl CurveVariable {
    /// The name of the variable in the user's language.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Theta => "theta",
            Self::X => "X",
            Self::Y => "Y",
        }
    }
}
