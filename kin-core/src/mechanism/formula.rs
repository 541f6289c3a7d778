//! Formulas as the user wrote them: names resolved to ids, nothing simplified yet.

use super::{BodyRef, CurveVariable, Place};
use crate::error::Origin;
use core::fmt;

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

/// One of the three coordinates of a body's pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Component {
    /// x of the body's origin in the inertial frame.
    X,
    /// y of the body's origin in the inertial frame.
    Y,
    /// Rotation of the body's frame, counter-clockwise, never wrapped.
    Phi,
}

impl Component {
    /// All three, in the order of q.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Phi];

    /// `x`, `y` or `phi`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Phi => "phi",
        }
    }
}

impl fmt::Display for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent.
    Tan,
    /// Inverse sine.
    Asin,
    /// Inverse cosine.
    Acos,
    /// Inverse tangent.
    Atan,
    /// Square root.
    Sqrt,
    /// Exponential.
    Exp,
    /// Natural logarithm.
    Ln,
    /// Absolute value.
    Abs,
}

impl Function {
    /// Every function of one argument.
    pub const ALL: [Self; 10] = [
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Asin,
        Self::Acos,
        Self::Atan,
        Self::Sqrt,
        Self::Exp,
        Self::Ln,
        Self::Abs,
    ];

    /// The name in the user's language.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan => "atan",
            Self::Sqrt => "sqrt",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Abs => "abs",
        }
    }

    /// The function called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|f| f.name() == name)
    }
}

/// A formula with resolved names. [`Origin`]s sit where something can be wrong.
#[derive(Debug, PartialEq)]
pub enum Formula {
    /// A literal number.
    Number(f64),
    /// π.
    Pi,
    /// Time t.
    Time,
    /// The number of the member of a family: an index as a value.
    Index(Index),
    /// A parameter of the mechanism (a field of the struct).
    Parameter(Member),
    /// A signal known only at run time.
    Input(Member),
    /// A coordinate of a body's pose, free, held or carried.
    Pose(BodyRef, Component),
    /// A scalar generalized coordinate.
    Scalar(Member),
    /// x or y of a point in the inertial frame.
    PointCoordinate(Box<Place>, Component),
    /// The distance between two points, |r_Q − r_P|.
    Distance(Box<Place>, Box<Place>),
    /// A named expression.
    Define(Member),
    /// The variable of the curve that the formula belongs to.
    Curve(CurveVariable),
    /// −a.
    Neg(Box<Formula>),
    /// a + b.
    Add(Box<Formula>, Box<Formula>),
    /// a − b.
    Sub(Box<Formula>, Box<Formula>),
    /// a · b.
    Mul(Box<Formula>, Box<Formula>),
    /// a / b; the origin is that of the divisor.
    Div(Box<Formula>, Box<Formula>, Origin),
    /// a to a constant power.
    Pow(Box<Formula>, f64),
    /// A function of one argument.
    Call(Function, Box<Formula>),
    /// atan2(y, x).
    Atan2(Box<Formula>, Box<Formula>),
    /// A scalar function that the user supplies (a field of the struct), at an argument.
    Supplied(Member, Box<Formula>),
    /// The total time derivative of a formula, in a row of velocity level; the origin is that of the word `dot`.
    Dot(Box<Formula>, Origin),
}

/// A long sum or product is deep on its left, so that side is walked and not called.
impl Clone for Formula {
    fn clone(&self) -> Self {
        let (mut operations, mut left) = (Vec::new(), self);
        while let Self::Add(a, _) | Self::Sub(a, _) | Self::Mul(a, _) | Self::Div(a, ..) = left {
            operations.push(left);
            left = a;
        }
        let mut copy = match left {
            Self::Number(value) => Self::Number(*value),
            Self::Pi => Self::Pi,
            Self::Time => Self::Time,
            Self::Index(index) => Self::Index(*index),
            Self::Parameter(member) => Self::Parameter(*member),
            Self::Input(member) => Self::Input(*member),
            Self::Pose(body, component) => Self::Pose(*body, *component),
            Self::Scalar(member) => Self::Scalar(*member),
            Self::PointCoordinate(place, component) => Self::PointCoordinate(place.clone(), *component),
            Self::Distance(p, q) => Self::Distance(p.clone(), q.clone()),
            Self::Define(member) => Self::Define(*member),
            Self::Curve(variable) => Self::Curve(*variable),
            Self::Neg(a) => Self::Neg(a.clone()),
            Self::Pow(a, n) => Self::Pow(a.clone(), *n),
            Self::Call(function, a) => Self::Call(*function, a.clone()),
            Self::Atan2(y, x) => Self::Atan2(y.clone(), x.clone()),
            Self::Supplied(member, a) => Self::Supplied(*member, a.clone()),
            Self::Dot(a, origin) => Self::Dot(a.clone(), *origin),
            Self::Add(..) | Self::Sub(..) | Self::Mul(..) | Self::Div(..) => unreachable!("walked above"),
        };
        for operation in operations.into_iter().rev() {
            copy = match operation {
                Self::Add(_, b) => Self::Add(Box::new(copy), b.clone()),
                Self::Sub(_, b) => Self::Sub(Box::new(copy), b.clone()),
                Self::Mul(_, b) => Self::Mul(Box::new(copy), b.clone()),
                Self::Div(_, b, origin) => Self::Div(Box::new(copy), b.clone(), *origin),
                _ => copy,
            };
        }
        copy
    }
}

impl Formula {
    /// The literal 0.
    pub const ZERO: Self = Self::Number(0.0);

    /// The number, when the formula is one, with its sign.
    pub fn literal(&self) -> Option<f64> {
        match self {
            Self::Number(v) => Some(*v),
            Self::Pi => Some(core::f64::consts::PI),
            Self::Neg(a) => a.literal().map(|v| -v),
            _ => None,
        }
    }
}
