//! Vector equations of joints, in terms of the vectors r + A s′ of both bodies and not of coordinates.

use crate::vocabulary::JointKind;

/// An equation as a sequence of pieces.
pub(crate) type Equation = Vec<EquationPiece>;

/// A joint with the names that its equations contain; a body is given by its name, the ground by `None`.
#[derive(Clone, Copy, Debug)]
pub struct NamedJoint<'a> {
    /// The kind of joint.
    pub kind: JointKind,
    /// The name of the joint.
    pub name: &'a str,
    /// The frames of the operands, if there are any.
    pub frames: [Option<Option<&'a str>>; 2],
    /// The frames of the points P and Q, if there are any.
    pub points: [Option<Option<&'a str>>; 2],
}

/// A letter with its decorations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Letter {
    pub(super) letter: &'static str,
    pub(super) bold: bool,
    pub(super) index: Option<String>,
    pub(super) above: Option<String>,
    pub(super) primed: bool,
}

impl Letter {
    pub(crate) fn plain(letter: &'static str) -> Self {
        Self { letter, bold: false, index: None, above: None, primed: false }
    }

    pub(crate) fn bold(letter: &'static str) -> Self {
        Self { bold: true, ..Self::plain(letter) }
    }

    /// The symbol with a subscript.
    pub(crate) fn of(self, index: &str) -> Self {
        Self { index: Some(index.to_owned()), ..self }
    }

    /// The symbol with a superscript.
    pub(crate) fn at(self, above: &str) -> Self {
        Self { above: Some(above.to_owned()), ..self }
    }

    pub(crate) fn primed(self) -> Self {
        Self { primed: true, ..self }
    }
}

/// A piece of an equation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum EquationPiece {
    /// A vector or a matrix.
    Vector(Letter),
    /// A transposed vector.
    Transposed(Letter),
    /// A scalar.
    Scalar(Letter),
    /// A squared scalar.
    Squared(Letter),
    /// A bracketed product with a superscript: ⊥ᵀ or ᵀ.
    Marked(Vec<EquationPiece>, &'static str),
    /// Any other text: signs, brackets, numbers.
    Op(&'static str),
}
