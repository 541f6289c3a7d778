//! Formulas as the user wrote them, with names resolved but nothing simplified.

use super::{BodyRef, Component, CurveVariable, Function, Index, Member};
use crate::error::Origin;

/// A formula with resolved names. An [`Origin`] is stored where an error may have to be reported.
#[derive(Debug, PartialEq)]
pub enum Formula {
    /// A literal number.
    Number(f64),
    /// π.
    Pi,
    /// Time t.
    Time,
    /// The value of the index variable, or of a linear expression in it.
    Index(Index),
    /// A parameter of the mechanism (a field of the struct).
    Parameter(Member),
    /// A signal known only at run time.
    Input(Member),
    /// A component of a body's pose, which may be free, held or carried.
    Pose(BodyRef, Component),
    /// A scalar generalized coordinate.
    Scalar(Member),
    /// x or y of a point in the inertial frame.
    PointCoordinate(Box<Place>, Component),
    /// The distance between two points, |r_Q − r_P|.
    Distance(Box<Place>, Box<Place>),
    /// A named expression.
    Define(Member),
    /// A variable of the curve that the formula belongs to.
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
    /// a to the power of a constant.
    Pow(Box<Formula>, f64),
    /// A function of one argument.
    Call(Function, Box<Formula>),
    /// atan2(y, x).
    Atan2(Box<Formula>, Box<Formula>),
    /// A scalar function that the user supplies (a field of the struct), applied to an argument.
    Supplied(Member, Box<Formula>),
    /// The total time derivative of a formula in a row of velocity level; the origin is that of `dot`.
    Dot(Box<Formula>, Origin),
}

/// A point of a body, `body @ (x, y)` in the body's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The body.
    pub body: BodyRef,
    /// The first body-fixed coordinate, a formula of parameters.
    pub x: Formula,
    /// The second body-fixed coordinate.
    pub y: Formula,
    /// The tokens of the operand.
    pub origin: Origin,
}

/// A long sum or product is deeply nested on the left, so the left operands are copied in a loop, not recursively.
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
            // The loop above has removed these from the left end.
            Self::Add(a, b) => Self::Add(a.clone(), b.clone()),
            Self::Sub(a, b) => Self::Sub(a.clone(), b.clone()),
            Self::Mul(a, b) => Self::Mul(a.clone(), b.clone()),
            Self::Div(a, b, origin) => Self::Div(a.clone(), b.clone(), *origin),
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

    /// The value of the formula if it is a literal number, possibly with a sign.
    pub fn literal(&self) -> Option<f64> {
        match self {
            Self::Number(v) => Some(*v),
            Self::Pi => Some(core::f64::consts::PI),
            Self::Neg(a) => a.literal().map(|v| -v),
            _ => None,
        }
    }
}
