//! The form of a joint, mass or load as a statement: its keyword and the slots of its operands.
//!
//! Code that parses, checks, prints or converts units of such a statement works on its slots and does not depend on
//! its kind.

use super::Component;
use crate::vocabulary::StatementKind;

/// The form of statements of one kind.
#[derive(Debug, PartialEq)]
pub struct StatementForm {
    /// The kind of statement. For joints with a curve, the kind also depends on the form of the curve.
    pub kind: StatementKind,
    /// Whether the statement must start with a name and a colon; otherwise the name is optional.
    pub named: bool,
    /// The slots in the order in which they are written: operands, the right-hand side, options.
    pub slots: &'static [OperandSlot],
    /// An example of a statement of this kind.
    pub example: &'static str,
    /// The message if several kinds share the keyword and the statement does not show which of them is meant;
    /// otherwise empty.
    pub choice: &'static str,
}

impl StatementForm {
    /// The slots that are written in the given way.
    pub fn written(&self, written: Written) -> impl Iterator<Item = &'static OperandSlot> + use<> {
        self.slots.iter().filter(move |slot| slot.written == written)
    }

    /// True for an equation, in which a right-hand side follows the last operand.
    pub fn is_equation(&self) -> bool {
        self.written(Written::Right).next().is_some()
    }
}

/// How an operand is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// As a positional operand.
    Operand,
    /// After `=`, behind the last operand.
    Right,
    /// As an option `key = value`, in any order.
    Option,
}

/// The type of an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperandType {
    /// A point: `body @ (x, y)` or the name of a point.
    Point,
    /// At least two points.
    Points,
    /// A body.
    Body,
    /// One or two bodies.
    Bodies,
    /// A vector `(fx, fy)` of arbitrary formulas, which may contain `dot(…)`.
    Vector,
    /// A formula of parameters.
    Constant,
    /// A body, by default the ground.
    Carrier,
    /// The name of a scalar coordinate; the text is the error message for any other name.
    Scalar(&'static str),
    /// An axis `(vx, vy)`.
    Axis,
    /// A radius other than 0.
    Radius,
    /// Two radii `(ra, rb)`.
    Radii,
    /// A formula of parameters, t and inputs.
    Signal,
    /// An arbitrary formula, such as a side of an equation.
    Side,
    /// A side of an equation of velocity level, or a couple: a formula that may contain `dot(…)`.
    SideOfRates,
    /// A support function, a formula in θ.
    Support,
    /// `polar(theta) = …`, `implicit(X, Y) = …`, or `parametric(u) = (…, …)` with or without `roller = …`.
    Curve,
}

/// The dimension of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// A length.
    Length,
    /// An angle.
    Angle,
    /// A length that is covered in one turn: a length, or a length divided by revolutions.
    LengthPerTurn,
    /// A length divided by a time.
    Speed,
    /// A product of powers of mass, length and time; the exponents are in this order.
    Derived([i8; 3]),
    /// Any dimension, the same for all slots that are marked so.
    Common,
    /// Like [`Common`](Self::Common), but a length unless it is a plain number, because radii may be given as numbers
    /// of teeth.
    CommonLength,
}

/// Which coordinates of an operand's body appear in the rows; this may include more than necessary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sees {
    /// Those of the point.
    Point,
    /// Those of one component of the point.
    Component(Component),
    /// Those of the point, and the angle of its body.
    PointAndAngle,
}

/// An operand slot of a statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OperandSlot {
    /// The key of an option, or a letter for other operands.
    pub key: &'static str,
    /// How the operand is written.
    pub written: Written,
    /// The type of the operand.
    pub takes: OperandType,
    /// Whether the operand is 0 if it is not given.
    pub or_zero: bool,
    /// The dimension of the operand.
    pub dimension: Dimension,
    /// Which coordinates of the operand's body appear in the rows.
    pub sees: Sees,
    /// Whether the operand appears only in the last row of the joint.
    pub in_last_row: bool,
    /// Whether the operand must be greater than 0.
    pub positive: bool,
}

impl OperandSlot {
    const fn new(key: &'static str, written: Written, takes: OperandType) -> Self {
        Self {
            key,
            written,
            takes,
            or_zero: false,
            dimension: Dimension::Length,
            sees: Sees::PointAndAngle,
            in_last_row: false,
            positive: false,
        }
    }

    /// A point whose body's angle also appears in the rows.
    pub const fn frame(letter: &'static str) -> Self {
        Self::new(letter, Written::Operand, OperandType::Point)
    }

    /// A point whose position alone appears in the rows.
    pub const fn point(letter: &'static str) -> Self {
        Self { sees: Sees::Point, ..Self::frame(letter) }
    }

    /// A point of which only one coordinate appears in the rows.
    pub const fn component_of_point(letter: &'static str, component: Component) -> Self {
        Self { sees: Sees::Component(component), ..Self::frame(letter) }
    }

    /// A list of points whose positions alone appear in the rows.
    pub const fn points(letter: &'static str) -> Self {
        Self { takes: OperandType::Points, ..Self::point(letter) }
    }

    /// A body whose angle appears in the rows.
    pub const fn body(letter: &'static str) -> Self {
        Self::new(letter, Written::Operand, OperandType::Body)
    }

    /// An operand of another type.
    pub const fn operand(letter: &'static str, takes: OperandType) -> Self {
        Self::new(letter, Written::Operand, takes)
    }

    /// The left side of an equation.
    pub const fn left(takes: OperandType) -> Self {
        Self { dimension: Dimension::Common, ..Self::new("left", Written::Operand, takes) }
    }

    /// The right side of an equation.
    pub const fn right(takes: OperandType) -> Self {
        Self { dimension: Dimension::Common, ..Self::new("right", Written::Right, takes) }
    }

    /// A value after `=`: a formula of parameters, t and inputs.
    pub const fn value(dimension: Dimension) -> Self {
        Self { dimension, ..Self::new("value", Written::Right, OperandType::Signal) }
    }

    /// An option without a value of its own where it is left out. It is mandatory unless its type has a default (the
    /// carrier of a gear or belt is the ground, if none is given).
    pub const fn option(key: &'static str, takes: OperandType) -> Self {
        Self::new(key, Written::Option, takes)
    }

    /// An option that is 0 by default: a formula of parameters, t and inputs.
    pub const fn offset(key: &'static str, dimension: Dimension) -> Self {
        Self { or_zero: true, dimension, ..Self::option(key, OperandType::Signal) }
    }

    /// The slot with another dimension.
    pub const fn measured_in(self, dimension: Dimension) -> Self {
        Self { dimension, ..self }
    }

    /// The slot with another type.
    pub const fn taking(self, takes: OperandType) -> Self {
        Self { takes, ..self }
    }

    /// The slot as an operand that appears only in the last row.
    pub const fn in_last_row(self) -> Self {
        Self { in_last_row: true, ..self }
    }

    /// The slot as an operand that must be greater than 0.
    pub const fn positive(self) -> Self {
        Self { positive: true, ..self }
    }

    /// True for formulas that may contain t and inputs; if one does, the joint drives.
    pub const fn may_move(&self) -> bool {
        matches!(
            self.takes,
            OperandType::Signal
                | OperandType::Side
                | OperandType::SideOfRates
                | OperandType::Support
                | OperandType::Curve
        )
    }
}
