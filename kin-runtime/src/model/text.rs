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
    Body: |info, f| write!(f, "body {}", info.0);
    /// Its place among the points.
    Point: |info, f| write!(f, "point {}", info.0);
    /// Its place in q.
    Coordinate: |info, f| write!(f, "coordinate {}", info.0);
    /// Its place among the defines.
    Quantity: |info, f| write!(f, "quantity {}", info.0);
    /// Its place among the inputs.
    Input: |info, f| write!(f, "input {}", info.0);
    /// Its name.
    CoordinateInfo: |info, f| f.write_str(info.name);
    /// `l1 = 0.1 m`.
    ParameterInfo: |info, f| {
        f.write_str(info.name)?;
        info.default.map_or(Ok(()), |value| write!(f, " = {value}"))?;
        info.unit.map_or(Ok(()), |unit| write!(f, " {unit}"))
    };
    /// Its name.
    BodyInfo: |info, f| f.write_str(info.name);
    /// Its name, and the body that carries it.
    PointInfo: |info, f| write!(f, "{} on {}", info.name, info.frame);
    /// Its name.
    DefineInfo: |info, f| f.write_str(info.name);
    /// Its name and class: `drive: holonomic rheonomic bilateral, driving`.
    RowInfo: |info, f| {
        let [level, time, side] = info.classes();
        write!(f, "{}: {level} {time} {side}{}", info.name, if info.driving { ", driving" } else { "" })
    };
    /// Its name and the inequality.
    ConditionInfo: |info, f| write!(f, "{}: {}", info.name, info.text);
    /// The number of entries and of rows.
    Pattern: |info, f| {
        counted(f, info.entries.len(), "entry").and_then(|()| f.write_str(" in "))?;
        counted(f, info.rows, "row")?;
        write!(f, ", {} constant", info.constants.len())
    };
    /// `effort of drive`.
    EffortInfo: |info, f| write!(f, "effort of {}", info.name);
    /// `reaction of B`.
    ReactionInfo: |info, f| write!(f, "reaction of {}", info.name);
    /// `spring S`.
    SpringInfo: |info, f| write!(f, "spring {}", info.name);
    /// `25 numbers: 1 effort, 4 reactions, 1 spring`.
    ForceModel: |info, f| {
        counted(f, info.count, "number")?;
        f.write_str(": ")?;
        counted(f, info.efforts.len(), "effort")?;
        f.write_str(", ")?;
        counted(f, info.reactions.len(), "reaction")?;
        f.write_str(", ")?;
        counted(f, info.springs.len(), "spring")
    };
    /// `revolute A`.
    JointInfo: |info, f| write!(f, "{} {}", info.kind, info.name);
    /// `FourBar: 3 bodies, 9 coordinates, 9 rows (1 driving)`.
    Model: |info, f| {
        write!(f, "{}: ", info.name)?;
        counted(f, info.bodies.len(), "body").and_then(|()| f.write_str(", "))?;
        counted(f, info.coordinates.len(), "coordinate").and_then(|()| f.write_str(", "))?;
        counted(f, info.rows.len(), "row")?;
        write!(f, " ({} driving)", info.rows.iter().filter(|row| row.driving).count())
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
