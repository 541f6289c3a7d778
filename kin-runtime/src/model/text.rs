//! What is known about a mechanism, in words.

use super::{
    Body, BodyInfo, Component, ConditionInfo, Coordinate, CoordinateInfo, DefineInfo, Frame, Input, JointInfo, Level,
    Model, OperationCount, ParameterInfo, Pattern, Point, PointInfo, Quantity, RowInfo,
};
use crate::text::counted;
use core::fmt;

/// What a type displays as: an expression of `self` and the formatter.
macro_rules! display {
    ($($(#[$doc:meta])* $type:ty: |$self:ident, $f:ident| $text:expr;)+) => {
        $($(#[$doc])*
        impl fmt::Display for $type {
            fn fmt(&self, $f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let $self = self;
                $text
            }
        })+
    };
}

display! {
    /// Its place among the bodies.
    Body: |it, f| write!(f, "body {}", it.0);
    /// Its place among the points.
    Point: |it, f| write!(f, "point {}", it.0);
    /// Its place in q.
    Coordinate: |it, f| write!(f, "coordinate {}", it.0);
    /// Its place among the defines.
    Quantity: |it, f| write!(f, "quantity {}", it.0);
    /// Its place among the inputs.
    Input: |it, f| write!(f, "input {}", it.0);
    /// `ground` or the place of a body.
    Frame: |it, f| match it {
        Self::Ground => f.write_str("ground"),
        Self::Body(place) => Body(*place).fmt(f),
    };
    /// As in the name of a coordinate: `x`, `y`, `phi`.
    Component: |it, f| f.write_str(match it { Self::X => "x", Self::Y => "y", Self::Phi => "phi" });
    /// Its name.
    CoordinateInfo: |it, f| f.write_str(it.name);
    /// `l1 = 0.1 m`.
    ParameterInfo: |it, f| {
        f.write_str(it.name)?;
        it.default.map_or(Ok(()), |value| write!(f, " = {value}"))?;
        it.unit.map_or(Ok(()), |unit| write!(f, " {unit}"))
    };
    /// Its name.
    BodyInfo: |it, f| f.write_str(it.name);
    /// Its name, and who carries it.
    PointInfo: |it, f| write!(f, "{} on {}", it.name, it.frame);
    /// Its name.
    DefineInfo: |it, f| f.write_str(it.name);
    /// Its name and class: `drive: holonomic rheonomic bilateral, driving`.
    RowInfo: |it, f| {
        let [level, time, side] = it.classes();
        write!(f, "{}: {level} {time} {side}{}", it.name, if it.driving { ", driving" } else { "" })
    };
    /// Its name and the inequality.
    ConditionInfo: |it, f| write!(f, "{}: {}", it.name, it.text);
    /// How many entries in how many rows.
    Pattern: |it, f| {
        counted(f, it.entries.len(), "entry").and_then(|()| f.write_str(" in "))?;
        counted(f, it.rows, "row")?;
        write!(f, ", {} constant", it.constants.len())
    };
    /// `50: 19 mul, 24 add, 4 neg, 3 sincos`; what there is none of is left out.
    OperationCount: |it, f| {
        let all = [
            (it.mul, "mul"), (it.add, "add"), (it.neg, "neg"), (it.div, "div"), (it.sqrt, "sqrt"), (it.sincos, "sincos"),
            (it.function, "function"),
        ];
        write!(f, "{}", all.iter().map(|(count, _)| count).sum::<usize>())?;
        let there = all.iter().filter(|(count, _)| *count > 0);
        there.enumerate().try_for_each(|(k, (count, what))| write!(f, "{} {count} {what}", if k == 0 { ":" } else { "," }))
    };
    /// `revolute A`.
    JointInfo: |it, f| write!(f, "{} {}", it.kind, it.name);
    /// `FourBar: 3 bodies, 9 coordinates, 9 rows (1 driving)`.
    Model: |it, f| {
        write!(f, "{}: ", it.name)?;
        counted(f, it.bodies.len(), "body").and_then(|()| f.write_str(", "))?;
        counted(f, it.coordinates.len(), "coordinate").and_then(|()| f.write_str(", "))?;
        counted(f, it.rows.len(), "row")?;
        write!(f, " ({} driving)", it.rows.iter().filter(|row| row.driving).count())
    };
}

impl RowInfo {
    /// Its class in the field's words: `holonomic` or `nonholonomic`, `rheonomic` or `scleronomic`, `bilateral`.
    pub const fn classes(&self) -> [&'static str; 3] {
        [
            match self.level {
                Level::Position => "holonomic",
                Level::Velocity => "nonholonomic",
            },
            if self.rheonomic { "rheonomic" } else { "scleronomic" },
            if self.bilateral { "bilateral" } else { "unilateral" },
        ]
    }
}
