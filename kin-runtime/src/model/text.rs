//! Display of a model and its parts.

use super::{
    Body, BodyInfo, ConditionInfo, Coordinate, CoordinateInfo, DefineInfo, EffortInfo, ForceModel, Input, JointInfo,
    Level, Model, ParameterInfo, Pattern, Point, PointInfo, Quantity, ReactionInfo, RowInfo, SpringInfo,
};
use crate::text::counted;
use core::fmt;

/// Implements `Display` for types, each by an expression of `self` and the formatter.
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
    /// Its name, and the body that carries it.
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
    /// The number of entries and of rows.
    Pattern: |it, f| {
        counted(f, it.entries.len(), "entry").and_then(|()| f.write_str(" in "))?;
        counted(f, it.rows, "row")?;
        write!(f, ", {} constant", it.constants.len())
    };
    /// `effort of drive`.
    EffortInfo: |it, f| write!(f, "effort of {}", it.name);
    /// `reaction of B`.
    ReactionInfo: |it, f| write!(f, "reaction of {}", it.name);
    /// `spring S`.
    SpringInfo: |it, f| write!(f, "spring {}", it.name);
    /// `25 numbers: 1 effort, 4 reactions, 1 spring`.
    ForceModel: |it, f| {
        counted(f, it.count, "number")?;
        f.write_str(": ")?;
        counted(f, it.efforts.len(), "effort")?;
        f.write_str(", ")?;
        counted(f, it.reactions.len(), "reaction")?;
        f.write_str(", ")?;
        counted(f, it.springs.len(), "spring")
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
    /// Its classification: `holonomic` or `nonholonomic`, `rheonomic` or `scleronomic`, `bilateral`.
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
