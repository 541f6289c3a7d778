//! What a formula may refer to, names resolved: members of families, bodies, components of their poses, variables of curves.

use crate::error::Origin;

/// An index into a family: `scale * i + offset`, where `i` is the variable of the row's range.
///
/// A thing that is not an array has the index 0; `link[3]` has scale 0 and offset 3; `link[i + 1]` inside
/// `N[i in 0..10]: …` has scale 1 and offset 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Index {
    /// Factor of the range variable.
    pub scale: i64,
    /// Constant part.
    pub offset: i64,
}

impl Index {
    /// The constant index `offset`.
    pub const fn constant(offset: i64) -> Self {
        Self { scale: 0, offset }
    }

    /// The value at `i`, or `None` on overflow or when negative.
    pub fn at(self, i: i64) -> Option<usize> {
        let value = self.scale.checked_mul(i)?.checked_add(self.offset)?;
        usize::try_from(value).ok()
    }
}

/// A member of a family: which family, and which index in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Member {
    /// Position of the family in its list (`Mechanism::parameters`, `scalars`, `points`, `defines`, …).
    pub family: usize,
    /// Index in the family.
    pub index: Index,
    /// The token that named it.
    pub origin: Origin,
}

/// A body: the ground or a member of a family of bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BodyRef {
    /// The fixed frame O–xy.
    Ground(Origin),
    /// A member of `Mechanism::bodies`.
    Body {
        /// Position of the family in `Mechanism::bodies`.
        family: usize,
        /// Index in the family.
        index: Index,
        /// The token that named it.
        origin: Origin,
    },
}

impl BodyRef {
    /// The token that named the body.
    pub const fn origin(&self) -> Origin {
        match self {
            Self::Ground(origin) | Self::Body { origin, .. } => *origin,
        }
    }

    /// True for the ground.
    pub const fn is_ground(&self) -> bool {
        matches!(self, Self::Ground(_))
    }
}

/// A variable that is known inside the formulas of a curve only.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CurveVariable {
    /// θ: the direction in which a polar curve or the support function of a cam is asked for.
    Theta,
    /// First coordinate of a point of an implicit curve, in the curve's frame.
    X,
    /// Second coordinate.
    Y,
}

impl CurveVariable {
    /// The word in the user's language.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Theta => "theta",
            Self::X => "X",
            Self::Y => "Y",
        }
    }
}
