//! Equations in vectors: r + A s′ of both bodies, before anything is written out in coordinates.

use crate::vocabulary::JointKind;

/// An equation, piece by piece.
pub(crate) type Equation = Vec<Piece>;

/// A joint with what its equations are about. A body is its name, `None` the ground.
#[derive(Clone, Copy, Debug)]
pub struct NamedJoint<'a> {
    /// Kind.
    pub kind: JointKind,
    /// Name.
    pub name: &'a str,
    /// Frames of the operands, as far as there are any.
    pub frames: [Option<Option<&'a str>>; 2],
    /// Frames that carry the points P and Q.
    pub points: [Option<Option<&'a str>>; 2],
}

/// A letter with what stands at it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Symbol {
    pub(super) letter: &'static str,
    pub(super) bold: bool,
    pub(super) index: Option<String>,
    pub(super) above: Option<String>,
    pub(super) primed: bool,
}

impl Symbol {
    pub(crate) fn plain(letter: &'static str) -> Self {
        Self { letter, bold: false, index: None, above: None, primed: false }
    }

    pub(crate) fn bold(letter: &'static str) -> Self {
        Self { bold: true, ..Self::plain(letter) }
    }

    /// With an index below.
    pub(crate) fn of(self, index: &str) -> Self {
        Self { index: Some(index.to_owned()), ..self }
    }

    /// With an index above.
    pub(crate) fn at(self, above: &str) -> Self {
        Self { above: Some(above.to_owned()), ..self }
    }

    pub(crate) fn primed(self) -> Self {
        Self { primed: true, ..self }
    }
}

/// A part of an equation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Piece {
    /// A vector or a matrix.
    Vector(Symbol),
    /// A row vector.
    Transposed(Symbol),
    /// A number.
    Scalar(Symbol),
    /// Its square.
    Squared(Symbol),
    /// A product in brackets with a mark: ⊥ᵀ or ᵀ.
    Marked(Vec<Piece>, &'static str),
    /// Anything else: signs, brackets, numbers.
    Op(&'static str),
}
