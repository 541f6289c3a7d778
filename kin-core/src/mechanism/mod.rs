//! The declarative model: ground, bodies, body-fixed points, joints and drivers, with all names resolved.
//!
//! A [`Mechanism`] contains only what the user declared; families (`link[10]`, `N[i in 0..10]: …`) are not expanded.
//! [`check`](crate::check::check) reports what is wrong with it.

mod body;
mod condition;
mod curve;
mod display;
mod form;
mod formula;
mod operand;
mod reference;
mod statement;
mod typed;
mod walk;

pub use crate::vocabulary::{Component, Function};
pub use body::{Body, BodyOrigin, Define, Input, NamedPoint, Parameter, Range, Scalar, Source, SuppliedFunction};
pub use condition::{Condition, Relation};
pub use curve::Curve;
pub use form::{Dimension, OperandSlot, OperandType, Sees, StatementForm, Written};
pub use formula::{Formula, Place};
pub use operand::{Axis, Operand, OperandValue, Operands, Radii, Value, Vector};
pub use reference::{BodyRef, CurveVariable, Index, Member};
pub use statement::{Guess, GuessTarget, Statement};
pub use typed::TypedOperands;
pub(crate) use typed::operands;
pub(crate) use walk::{contains_coordinate, contains_signal, defines_in, nodes};

use crate::error::Origin;

/// A planar mechanism as declared.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mechanism {
    /// The name of the struct.
    pub name: String,
    /// The token of the struct's name.
    pub origin: Origin,
    /// The fields that are numbers or arrays of numbers, in order.
    pub parameters: Vec<Parameter>,
    /// The fields that are supplied functions, in order.
    pub functions: Vec<SuppliedFunction>,
    /// The signals known only at run time.
    pub inputs: Vec<Input>,
    /// The bodies in order of declaration.
    pub bodies: Vec<Body>,
    /// The scalar coordinates in order of declaration; they follow the bodies in q.
    pub scalars: Vec<Scalar>,
    /// The named points.
    pub points: Vec<NamedPoint>,
    /// The named expressions.
    pub defines: Vec<Define>,
    /// The joints, drivers and equations in order of declaration, which is the order of their rows in Φ.
    pub joints: Vec<Statement>,
    /// The masses and loads in order of declaration; they have no rows in Φ.
    pub loads: Vec<Statement>,
    /// The unilateral conditions in order of declaration; they are not rows of Φ.
    pub conditions: Vec<Condition>,
    /// The start values for assembly.
    pub guesses: Vec<Guess>,
}
