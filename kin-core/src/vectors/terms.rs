//! The terms of the vector equations of joints.

use super::equation::{Equation, EquationPiece, Letter, NamedJoint};

/// A frame: the name of a body, or `None` for the ground.
#[derive(Clone, Copy)]
pub(crate) struct FrameName<'a>(Option<&'a str>);

/// The symbols of a joint between two frames.
#[derive(Clone, Copy)]
pub(crate) struct Terms<'a> {
    /// The name of the joint.
    name: &'a str,
    /// The frame of P, or of the first operand.
    pub(crate) i: FrameName<'a>,
    /// The frame of Q, or of the second operand.
    pub(crate) j: FrameName<'a>,
}

impl<'a> Terms<'a> {
    /// The symbols of a joint; `None` if it has fewer than two frames.
    pub(crate) fn of(joint: &NamedJoint<'a>) -> Option<Self> {
        let frame = |index: usize| joint.points[index].or(joint.frames[index]).map(FrameName);
        Some(Self { name: joint.name, i: frame(0)?, j: frame(1)? })
    }

    /// The symbols of a joint with a single frame, which is used for both.
    pub(crate) fn of_first(joint: &NamedJoint<'a>) -> Option<Self> {
        let i = joint.points[0].or(joint.frames[0]).map(FrameName)?;
        Some(Self { name: joint.name, i, j: i })
    }

    /// A scalar with the joint's name as index.
    pub(crate) fn scalar(&self, letter: &'static str) -> Equation {
        vec![EquationPiece::Scalar(Letter::plain(letter).of(self.name))]
    }

    /// A vector with the joint's name as index.
    pub(crate) fn vector(&self, letter: &'static str) -> EquationPiece {
        EquationPiece::Vector(Letter::bold(letter).of(self.name))
    }

    /// The square dᵀd.
    pub(crate) fn square_of_d(&self) -> Equation {
        vec![EquationPiece::Transposed(Letter::bold("d").of(self.name)), self.vector("d")]
    }

    /// The square of a scalar.
    pub(crate) fn squared(&self, letter: &'static str) -> Equation {
        vec![EquationPiece::Squared(Letter::plain(letter).of(self.name))]
    }

    /// The difference r_Q − r_P.
    pub(crate) fn difference(&self) -> Equation {
        let (q, p) = (self.point(self.j, " + "), self.point(self.i, " − "));
        q.into_iter().chain([EquationPiece::Op(" − ")]).chain(p).collect()
    }

    /// The definition d = r_Q − r_P.
    pub(crate) fn d_is_difference(&self) -> Equation {
        equals(vec![self.vector("d")], self.difference())
    }

    /// The component across the axis, (A v̂)⊥ᵀ d.
    pub(crate) fn across(&self) -> Equation {
        vec![self.axis("⊥ᵀ"), self.vector("d")]
    }

    /// The component along the axis, (A v̂)ᵀ d.
    pub(crate) fn along(&self) -> Equation {
        vec![self.axis("ᵀ"), self.vector("d")]
    }

    /// The velocity across the direction, (A v̂)⊥ᵀ ṙ.
    pub(crate) fn rate_across(&self) -> Equation {
        vec![self.axis("⊥ᵀ"), self.vector("ṙ")]
    }

    /// The equation φ_j − φ_i = `angle`.
    pub(crate) fn turned_by(&self, angle: Equation) -> Equation {
        equals(
            vec![EquationPiece::Scalar(self.j.phi()), EquationPiece::Op(" − "), EquationPiece::Scalar(self.i.phi())],
            angle,
        )
    }

    /// The position r + A s′ of a point, with `sign` in place of the plus sign; s for a point of the ground.
    fn point(&self, frame: FrameName<'_>, sign: &'static str) -> Equation {
        let local = Letter::bold("s").of(frame.index()).at(self.name);
        match frame.0 {
            None => vec![EquationPiece::Vector(local)],
            Some(name) => vec![
                EquationPiece::Vector(Letter::bold("r").of(name)),
                EquationPiece::Op(sign),
                frame.matrix(),
                EquationPiece::Vector(local.primed()),
            ],
        }
    }

    fn axis(&self, mark: &'static str) -> EquationPiece {
        let inner = match self.i.0 {
            None => vec![self.vector("v̂")],
            Some(_) => vec![self.i.matrix(), self.vector("v̂")],
        };
        EquationPiece::Marked(inner, mark)
    }
}

impl FrameName<'_> {
    fn index(&self) -> &str {
        self.0.unwrap_or("0")
    }

    /// The symbol of the frame's angle φ.
    pub(crate) fn phi(&self) -> Letter {
        Letter::plain("φ").of(self.index())
    }

    /// The symbol of the frame's rotation matrix A.
    pub(crate) fn matrix(&self) -> EquationPiece {
        EquationPiece::Vector(Letter::bold("A").of(self.index()))
    }
}

/// The number 0.
pub(crate) fn zero() -> Equation {
    vec![EquationPiece::Op("0")]
}

/// The equation left = right.
pub(crate) fn equals(left: Equation, right: Equation) -> Equation {
    left.into_iter().chain([EquationPiece::Op(" = ")]).chain(right).collect()
}
