//! The declarative model: ground, bodies, body-fixed points, joints and drivers, with all names resolved.
//!
//! A [`Mechanism`] says what the user said and nothing more; families (`link[10]`, `N[i in 0..10]: …`) stay
//! families. [`check`](crate::check::check) lists what is wrong with it.

mod body;
mod condition;
mod curve;
mod display;
mod form;
mod formula;
mod joint;
mod operand;
mod reference;
mod typed;
mod walk;

pub use crate::vocabulary::Component;
pub use body::{Body, BodyOrigin, Define, Input, NamedPoint, Parameter, Range, Scalar, Source, SuppliedFunction};
pub use condition::{Condition, Relation};
pub use curve::Curve;
pub use form::{Dimension, Sees, Slot, StatementForm, Takes, Written};
pub use formula::{Formula, Function, Place};
pub use joint::{Guess, GuessTarget, Joint, Load};
pub use operand::{Axis, Operand, OperandValue, Operands, Radii, Value, Vector};
pub use reference::{BodyRef, CurveVariable, Index, Member};
pub use typed::TypedOperands;
pub(crate) use typed::operands;
pub(crate) use walk::{contains_signal, defines_in, nodes};

use crate::error::Origin;

/// A planar mechanism as described.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mechanism {
    /// Name of the struct.
    pub name: String,
    /// The struct's name token.
    pub origin: Origin,
    /// Fields that are numbers or arrays of numbers, in order.
    pub parameters: Vec<Parameter>,
    /// Fields that are supplied functions, in order.
    pub functions: Vec<SuppliedFunction>,
    /// Signals known only at run time.
    pub inputs: Vec<Input>,
    /// Bodies in order of declaration.
    pub bodies: Vec<Body>,
    /// Scalar coordinates in order of declaration; they follow the bodies in q.
    pub scalars: Vec<Scalar>,
    /// Named points.
    pub points: Vec<NamedPoint>,
    /// Named expressions.
    pub defines: Vec<Define>,
    /// Joints, drivers and equations in order of declaration; their rows stand in this order in Φ.
    pub joints: Vec<Joint>,
    /// Masses and loads in order of declaration; they have no rows.
    pub loads: Vec<Load>,
    /// Unilateral conditions in order of declaration; they are no rows of Φ.
    pub conditions: Vec<Condition>,
    /// Start of assembly.
    pub guesses: Vec<Guess>,
}
