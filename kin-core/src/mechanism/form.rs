//! How a joint, a mass or a load is written: its keyword, and the operands that it takes, slot by slot.
//!
//! Everything that reads, checks, prints or measures such a statement goes through its slots, so that none of it knows
//! the kinds.

use super::Component;
use crate::vocabulary::StatementKind;

/// How a statement of one kind is written.
#[derive(Debug, PartialEq)]
pub struct StatementForm {
    /// The kind; of a joint with a curve its kind depends on how the curve is written, too.
    pub kind: StatementKind,
    /// It begins with a name and a colon; otherwise it may.
    pub named: bool,
    /// What it takes, in the order in which it is written: operands, then the right-hand side, then options.
    pub slots: &'static [Slot],
    /// A statement of the kind as the user writes it.
    pub example: &'static str,
    /// What to say where kinds share a keyword and nothing tells which of them is meant; otherwise empty.
    pub choice: &'static str,
}

impl StatementForm {
    /// The slots that are written in one way.
    pub fn written(&self, written: Written) -> impl Iterator<Item = &'static Slot> + use<> {
        self.slots.iter().filter(move |slot| slot.written == written)
    }

    /// True for an equation: a right-hand side follows the last operand.
    pub fn is_equation(&self) -> bool {
        self.written(Written::Right).next().is_some()
    }
}

/// How an operand is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// By itself, at its place.
    Operand,
    /// Behind `=`, after the last operand.
    Right,
    /// As `key = value`, in any order.
    Option,
}

/// What an operand is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Takes {
    /// `body @ (x, y)`, or a named point.
    Point,
    /// Two points or more.
    Points,
    /// A body.
    Body,
    /// One body, or two.
    Bodies,
    /// `(fx, fy)`, two formulas of anything, which may hold `dot(…)`.
    Vector,
    /// A formula of parameters.
    Constant,
    /// A body; the ground where none is given.
    Carrier,
    /// The name of a scalar coordinate, and what to say where it is none.
    Scalar(&'static str),
    /// `(vx, vy)`.
    Axis,
    /// A radius, which is not 0.
    Radius,
    /// `(ra, rb)`.
    Radii,
    /// A formula of parameters, t and inputs.
    Signal,
    /// A formula of anything: a side of an equation.
    Side,
    /// A side of an equation of velocity level, which may hold `dot(…)`.
    SideOfRates,
    /// A support function, a formula in θ.
    Support,
    /// `polar(theta) = …`, `implicit(X, Y) = …`, or `parametric(u) = (…, …)` with or without `roller = …`.
    Curve,
}

/// In what a formula is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// A length.
    Length,
    /// An angle.
    Angle,
    /// A length by a time.
    Speed,
    /// A product of powers of mass, length and time, in this order.
    Derived([i8; 3]),
    /// Whatever all slots of this dimension agree on.
    Common,
    /// As [`Common`](Self::Common), and a length unless it is a plain number: radii, for which numbers of teeth do as
    /// well.
    CommonLength,
}

/// What of the body that carries a point, or that is named, appears in the rows; too much does no harm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sees {
    /// The point.
    Point,
    /// One coordinate of the point.
    Component(Component),
    /// The point and the angle of its body.
    PointAndAngle,
}

/// An operand of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot {
    /// Its key, as an option is written; of operands a letter.
    pub key: &'static str,
    /// How it is written.
    pub written: Written,
    /// What it is.
    pub takes: Takes,
    /// It is 0 where it is not given.
    pub or_zero: bool,
    /// In what it is measured.
    pub dimension: Dimension,
    /// What of its body the rows see.
    pub sees: Sees,
    /// Only the last row of the joint holds it.
    pub in_last_row: bool,
    /// It is greater than 0.
    pub positive: bool,
}

impl Slot {
    const fn new(key: &'static str, written: Written, takes: Takes) -> Self {
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

    /// A point, whose body turns something in the rows.
    pub const fn frame(letter: &'static str) -> Self {
        Self::new(letter, Written::Operand, Takes::Point)
    }

    /// A point, of which only the place counts.
    pub const fn point(letter: &'static str) -> Self {
        Self { sees: Sees::Point, ..Self::frame(letter) }
    }

    /// A point, of which one coordinate counts.
    pub const fn component_of_point(letter: &'static str, component: Component) -> Self {
        Self { sees: Sees::Component(component), ..Self::frame(letter) }
    }

    /// Points in a row, of which only the places count.
    pub const fn points(letter: &'static str) -> Self {
        Self { takes: Takes::Points, ..Self::point(letter) }
    }

    /// A body, whose angle counts.
    pub const fn body(letter: &'static str) -> Self {
        Self::new(letter, Written::Operand, Takes::Body)
    }

    /// An operand of another kind.
    pub const fn operand(letter: &'static str, takes: Takes) -> Self {
        Self::new(letter, Written::Operand, takes)
    }

    /// The left side of an equation.
    pub const fn left(takes: Takes) -> Self {
        Self { dimension: Dimension::Common, ..Self::new("left", Written::Operand, takes) }
    }

    /// The right side of an equation.
    pub const fn right(takes: Takes) -> Self {
        Self { dimension: Dimension::Common, ..Self::new("right", Written::Right, takes) }
    }

    /// The value behind `=`, a formula of parameters, t and inputs.
    pub const fn value(dimension: Dimension) -> Self {
        Self { dimension, ..Self::new("value", Written::Right, Takes::Signal) }
    }

    /// An option that must be given.
    pub const fn required(key: &'static str, takes: Takes) -> Self {
        Self::new(key, Written::Option, takes)
    }

    /// An option that is 0 unless it is given: a formula of parameters, t and inputs.
    pub const fn offset(key: &'static str, dimension: Dimension) -> Self {
        Self { or_zero: true, dimension, ..Self::required(key, Takes::Signal) }
    }

    /// An option measured in something else than a length.
    pub const fn measured_in(self, dimension: Dimension) -> Self {
        Self { dimension, ..self }
    }

    /// An option that is something else.
    pub const fn taking(self, takes: Takes) -> Self {
        Self { takes, ..self }
    }

    /// An option that only the last row holds.
    pub const fn in_last_row(self) -> Self {
        Self { in_last_row: true, ..self }
    }

    /// An option that is greater than 0.
    pub const fn positive(self) -> Self {
        Self { positive: true, ..self }
    }

    /// True for formulas that may hold t and inputs, so that a joint drives with them.
    pub const fn may_move(&self) -> bool {
        matches!(self.takes, Takes::Signal | Takes::Side | Takes::SideOfRates | Takes::Support | Takes::Curve)
    }
}
