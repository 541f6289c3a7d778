//! The operands of a joint, a mass or a load: what stands in its slots.

use super::form::{Slot, StatementForm, Takes, Written};
use super::{BodyRef, Curve, Formula, Member, Place};
use crate::error::Origin;
use crate::vocabulary::{JointKind, StatementKind};

/// An axis direction in the frame of the first operand's body (a flat follower's: of the second); kin normalises it.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// First component, a formula of parameters.
    pub x: Formula,
    /// Second component.
    pub y: Formula,
    /// The tokens of the axis.
    pub origin: Origin,
}

/// A formula with the tokens it is written with.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// The formula.
    pub value: Formula,
    /// Its tokens.
    pub origin: Origin,
}

/// The radii of a pair of discs, or of two gears; negative for one that the other runs inside of.
#[derive(Clone, Debug, PartialEq)]
pub struct Radii {
    /// Of body i.
    pub i: Value,
    /// Of body j.
    pub j: Value,
    /// The pair.
    pub origin: Origin,
}

/// Two components in the inertial frame, or in that of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Vector {
    /// First component.
    pub x: Formula,
    /// Second component.
    pub y: Formula,
    /// The tokens of the pair.
    pub origin: Origin,
}

/// What stands in a slot.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    /// A point.
    Point(Place),
    /// Points in a row.
    Points(Vec<Place>),
    /// A body.
    Body(BodyRef),
    /// One body, or two.
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
    /// Its formulas, those of its points included.
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

    /// The bodies that it names outside of its formulas.
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

    /// The scalar coordinate that it names outside of its formulas.
    pub fn scalar(&self) -> Option<Member> {
        match self {
            Self::Scalar(member) | Self::Curve(Curve::Parametric { parameter: member, .. }) => Some(*member),
            _ => None,
        }
    }

    /// True for something that `slot` takes.
    fn fits(&self, slot: &Slot) -> bool {
        match slot.takes {
            Takes::Point => matches!(self, Self::Point(_)),
            Takes::Points => matches!(self, Self::Points(_)),
            Takes::Body | Takes::Carrier => matches!(self, Self::Body(_)),
            Takes::Bodies => matches!(self, Self::Bodies(_)),
            Takes::Vector => matches!(self, Self::Vector(_)),
            Takes::Scalar(_) => matches!(self, Self::Scalar(_)),
            Takes::Axis => matches!(self, Self::Axis(_)),
            Takes::Radii => matches!(self, Self::Radii(_)),
            Takes::Curve => matches!(self, Self::Curve(_)),
            Takes::Constant | Takes::Radius | Takes::Signal | Takes::Side | Takes::SideOfRates | Takes::Support => {
                matches!(self, Self::Value(_))
            }
        }
    }
}

/// Something that stands in a slot, as a type of its own.
pub trait OperandValue: Clone {
    /// As an operand.
    fn into_operand(self) -> Operand;
    /// Out of an operand, where it is one of this type.
    fn of(operand: &Operand) -> Option<Self>;
}

/// A type that stands in a slot, with the variant of [`Operand`] that holds it.
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

/// A formula of which nobody needs to know where it stands.
impl OperandValue for Formula {
    fn into_operand(self) -> Operand {
        Operand::Value(Value { value: self, origin: Origin::default() })
    }

    fn of(operand: &Operand) -> Option<Self> {
        Value::of(operand).map(|value| value.value)
    }
}

/// The operands of a statement, one for every slot of its form.
#[derive(Clone, Debug, PartialEq)]
pub struct Operands {
    form: &'static StatementForm,
    values: Vec<Operand>,
}

impl Operands {
    /// Operands for a form; none where they are too many, too few, or not what the slots take.
    pub fn new(form: &'static StatementForm, values: Vec<Operand>) -> Option<Self> {
        let fit = form.slots.iter().zip(&values).all(|(slot, value)| value.fits(slot));
        (fit && form.slots.len() == values.len()).then_some(Self { form, values })
    }

    /// Operands out of the fields of a typed joint, which have the types that the slots of its form take.
    pub(crate) fn of_fields(form: &'static StatementForm, values: Vec<Operand>) -> Self {
        debug_assert!(form.slots.iter().zip(&values).all(|(slot, value)| value.fits(slot)), "{form:?}: {values:?}");
        Self { form, values }
    }

    /// How the joint is written.
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

    /// The keyword of the user's language.
    pub const fn keyword(&self) -> &'static str {
        self.form.kind.keyword()
    }

    /// Every slot with what stands in it.
    pub fn iter(&self) -> impl Iterator<Item = (&'static Slot, &Operand)> + use<'_> {
        self.form.slots.iter().zip(&self.values)
    }

    /// What stands in the slots.
    pub fn into_values(self) -> Vec<Operand> {
        self.values
    }

    /// What stands in the slot at `place`.
    pub fn get<T: OperandValue>(&self, place: usize) -> Option<T> {
        self.values.get(place).and_then(T::of)
    }

    /// The curve, where the joint has one.
    pub fn curve(&self) -> Option<&Curve> {
        self.values.iter().find_map(|value| if let Operand::Curve(curve) = value { Some(curve) } else { None })
    }

    /// The two bodies that it joins; none where it joins no two.
    pub fn joined(&self) -> Option<[BodyRef; 2]> {
        let bodies: Vec<BodyRef> = self.written().flat_map(Operand::bodies).collect();
        <[BodyRef; 2]>::try_from(bodies).ok()
    }

    /// The tokens of the second operand.
    pub fn second_origin(&self) -> Option<Origin> {
        self.written().nth(1).and_then(|operand| match operand {
            Operand::Point(place) => Some(place.origin),
            Operand::Body(body) => Some(body.origin()),
            _ => None,
        })
    }

    /// What is written before the options and the right-hand side.
    fn written(&self) -> impl Iterator<Item = &Operand> {
        self.iter().filter(|(slot, _)| slot.written == Written::Operand).map(|(_, operand)| operand)
    }
}
