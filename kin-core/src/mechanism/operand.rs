//! The operands of a joint, a mass or a load: the values of its slots.

use super::form::{OperandSlot, OperandType, StatementForm, Written};
use super::{BodyRef, Curve, Formula, Member, Place};
use crate::error::Origin;
use crate::vocabulary::{JointKind, StatementKind};

/// An axis direction in the frame of the first operand's body (for a flat follower, of the second), normalised later.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The first component, a formula of parameters.
    pub x: Formula,
    /// The second component.
    pub y: Formula,
    /// The tokens of the axis.
    pub origin: Origin,
}

/// A formula with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// The formula.
    pub value: Formula,
    /// The tokens of the formula.
    pub origin: Origin,
}

/// The radii of two discs or gears; the radius of a ring, inside which the other one runs, is negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Radii {
    /// The radius of body i.
    pub i: Value,
    /// The radius of body j.
    pub j: Value,
    /// The tokens of the pair.
    pub origin: Origin,
}

/// A vector with two components, in the inertial frame or in the frame of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Vector {
    /// The first component.
    pub x: Formula,
    /// The second component.
    pub y: Formula,
    /// The tokens of the pair.
    pub origin: Origin,
}

/// The value of a slot.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    /// A point.
    Point(Place),
    /// A list of points.
    Points(Vec<Place>),
    /// A body.
    Body(BodyRef),
    /// One or two bodies.
    Bodies(Vec<BodyRef>),
    /// A vector.
    Vector(Vector),
    /// A scalar coordinate.
    Scalar(Member),
    /// An axis.
    Axis(Axis),
    /// A formula.
    Value(Value),
    /// Two radii.
    Radii(Radii),
    /// A curve.
    Curve(Curve),
}

impl Operand {
    /// The formulas of the operand, including those of its points.
    pub fn formulas(&self) -> Vec<&Formula> {
        match self {
            Self::Point(place) => vec![&place.x, &place.y],
            Self::Points(places) => places.iter().flat_map(|place| [&place.x, &place.y]).collect(),
            Self::Body(_) | Self::Bodies(_) | Self::Scalar(_) => Vec::new(),
            Self::Vector(vector) => vec![&vector.x, &vector.y],
            Self::Axis(axis) => vec![&axis.x, &axis.y],
            Self::Value(value) => vec![&value.value],
            Self::Radii(radii) => vec![&radii.i.value, &radii.j.value],
            Self::Curve(curve) => curve.formulas(),
        }
    }

    /// The bodies that the operand names outside its formulas.
    pub fn bodies(&self) -> Vec<BodyRef> {
        match self {
            Self::Point(place) => vec![place.body],
            Self::Points(places) => places.iter().map(|place| place.body).collect(),
            Self::Body(body) => vec![*body],
            Self::Bodies(bodies) => bodies.clone(),
            Self::Scalar(_) | Self::Vector(_) | Self::Axis(_) | Self::Value(_) | Self::Radii(_) | Self::Curve(_) => {
                Vec::new()
            }
        }
    }

    /// The scalar coordinate that the operand names outside its formulas.
    pub fn scalar(&self) -> Option<Member> {
        match self {
            Self::Scalar(member) | Self::Curve(Curve::Parametric { parameter: member, .. }) => Some(*member),
            _ => None,
        }
    }

    /// True if `slot` takes an operand of this type.
    fn fits(&self, slot: &OperandSlot) -> bool {
        match slot.takes {
            OperandType::Point => matches!(self, Self::Point(_)),
            OperandType::Points => matches!(self, Self::Points(_)),
            OperandType::Body | OperandType::Carrier => matches!(self, Self::Body(_)),
            OperandType::Bodies => matches!(self, Self::Bodies(_)),
            OperandType::Vector => matches!(self, Self::Vector(_)),
            OperandType::Scalar(_) => matches!(self, Self::Scalar(_)),
            OperandType::Axis => matches!(self, Self::Axis(_)),
            OperandType::Radii => matches!(self, Self::Radii(_)),
            OperandType::Curve => matches!(self, Self::Curve(_)),
            OperandType::Constant
            | OperandType::Radius
            | OperandType::Signal
            | OperandType::Side
            | OperandType::SideOfRates
            | OperandType::Support => {
                matches!(self, Self::Value(_))
            }
        }
    }
}

/// A Rust type for the value of a slot.
pub trait OperandValue: Clone {
    /// Converts the value to an operand.
    fn into_operand(self) -> Operand;
    /// The value of an operand of this type; `None` for an operand of another type.
    fn of(operand: &Operand) -> Option<Self>;
}

/// Implements [`OperandValue`] for the type that each variant of [`Operand`] holds.
macro_rules! operand_values {
    ($($variant:ident: $type:ty),*) => {$(
        impl OperandValue for $type {
            fn into_operand(self) -> Operand {
                Operand::$variant(self)
            }

            fn of(operand: &Operand) -> Option<Self> {
                if let Operand::$variant(value) = operand { Some(value.clone()) } else { None }
            }
        }
    )*};
}

operand_values!(
    Point: Place, Points: Vec<Place>, Body: BodyRef, Bodies: Vec<BodyRef>, Vector: Vector, Scalar: Member, Axis: Axis, Value: Value, Radii: Radii, Curve: Curve
);

/// A formula whose origin is not needed.
impl OperandValue for Formula {
    fn into_operand(self) -> Operand {
        Operand::Value(Value { value: self, origin: Origin::default() })
    }

    fn of(operand: &Operand) -> Option<Self> {
        Value::of(operand).map(|value| value.value)
    }
}

/// The operands of a statement, one for each slot of its form.
#[derive(Clone, Debug, PartialEq)]
pub struct Operands {
    form: &'static StatementForm,
    values: Vec<Operand>,
}

impl Operands {
    /// The operands of a statement; `None` if their number or their types do not fit the slots.
    pub fn new(form: &'static StatementForm, values: Vec<Operand>) -> Option<Self> {
        let fit = form.slots.iter().zip(&values).all(|(slot, value)| value.fits(slot));
        (fit && form.slots.len() == values.len()).then_some(Self { form, values })
    }

    /// The operands from the fields of a typed joint, whose types fit the slots by construction.
    pub(crate) fn of_fields(form: &'static StatementForm, values: Vec<Operand>) -> Self {
        debug_assert!(form.slots.iter().zip(&values).all(|(slot, value)| value.fits(slot)), "{form:?}: {values:?}");
        Self { form, values }
    }

    /// The form of the statement.
    pub const fn form(&self) -> &'static StatementForm {
        self.form
    }

    /// The kind of statement.
    pub fn kind(&self) -> StatementKind {
        let of_curve = |curve: &Curve| match curve {
            Curve::Polar { .. } => JointKind::OnPolarCurve,
            Curve::Implicit { .. } => JointKind::OnImplicitCurve,
            Curve::Parametric { .. } => JointKind::OnParametricCurve,
        };
        self.curve().map_or(self.form.kind, |curve| StatementKind::Joint(of_curve(curve)))
    }

    /// The keyword of the statement.
    pub const fn keyword(&self) -> &'static str {
        self.form.kind.keyword()
    }

    /// The slots with their operands.
    pub fn iter(&self) -> impl Iterator<Item = (&'static OperandSlot, &Operand)> + use<'_> {
        self.form.slots.iter().zip(&self.values)
    }

    /// The operands in the order of the slots.
    pub fn into_values(self) -> Vec<Operand> {
        self.values
    }

    /// The operand of the slot at index `index`, if it has type `T`.
    pub fn get<T: OperandValue>(&self, index: usize) -> Option<T> {
        self.values.get(index).and_then(T::of)
    }

    /// The curve, if the joint has one.
    pub fn curve(&self) -> Option<&Curve> {
        self.values.iter().find_map(|value| if let Operand::Curve(curve) = value { Some(curve) } else { None })
    }

    /// The two bodies that the statement connects; `None` if it does not connect exactly two.
    pub fn joined(&self) -> Option<[BodyRef; 2]> {
        let written = self.iter().filter(|(slot, _)| slot.written == Written::Operand);
        let bodies: Vec<BodyRef> = written.flat_map(|(_, operand)| operand.bodies()).collect();
        <[BodyRef; 2]>::try_from(bodies).ok()
    }
}
