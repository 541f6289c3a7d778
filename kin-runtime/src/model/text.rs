//! What is known about a mechanism, in words.

use super::{
    Body, BodyInfo, ConditionInfo, Coordinate, CoordinateInfo, CoordinateKind, DefineInfo, EquationText, FamilyInfo,
    FamilyKind, GenericRedundancy, Geometry, Input, JointInfo, JointQuantity, Level, LineText, Model, Observable,
    OriginKind, ParameterInfo, Pattern, Point, PointInfo, Quantity, RowInfo, StepText, Structure,
};
use crate::text::{counted, separated};
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

    /// `phi of body 2`, or `scalar`.
    CoordinateKind: |it, f| match it {
        Self::Pose { body, component } => write!(f, "{component} of {}", Body(*body)),
        Self::Scalar => f.write_str("scalar"),
    };
    /// Its name.
    CoordinateInfo: |it, f| f.write_str(it.name);
    /// `l1 = 0.1 m`.
    ParameterInfo: |it, f| {
        f.write_str(it.name)?;
        it.default.map_or(Ok(()), |value| write!(f, " = {value}"))?;
        it.unit.map_or(Ok(()), |unit| write!(f, " {unit}"))
    };
    /// `free`, or by what it is carried.
    OriginKind: |it, f| match it {
        Self::Free => f.write_str("free"),
        Self::Carried(frame) => write!(f, "carried by {frame}"),
    };
    /// Its name.
    BodyInfo: |it, f| f.write_str(it.name);
    /// Its name, and who carries it.
    PointInfo: |it, f| write!(f, "{} on {}", it.name, it.frame);
    /// Its name.
    DefineInfo: |it, f| f.write_str(it.name);
    /// `position` or `velocity`.
    Level: |it, f| f.write_str(match it { Self::Position => "position", Self::Velocity => "velocity" });
    /// Its name and class: `drive: holonomic rheonomic bilateral, driving`.
    RowInfo: |it, f| {
        let [level, time, side] = it.classes();
        write!(f, "{}: {level} {time} {side}{}", it.name, if it.driving { ", driving" } else { "" })
    };
    /// Its name and the inequality.
    ConditionInfo: |it, f| write!(f, "{}: {}", it.name, it.text);
    /// What is observed, by place.
    Observable: |it, f| match it {
        Self::Pose { body, component } => write!(f, "{component} of {}", Body(*body)),
        Self::Point { point, component } => write!(f, "{component} of {}", Point(*point)),
        Self::Define(place) => Quantity(*place).fmt(f),
        Self::Joint { joint, quantity } => write!(f, "quantity {quantity} of joint {joint}"),
        Self::Condition(place) => write!(f, "condition {place}"),
    };
    /// `bodies` or `rows`.
    FamilyKind: |it, f| f.write_str(match it { Self::Bodies => "bodies", Self::Rows => "rows" });
    /// `link[0..10]`.
    FamilyInfo: |it, f| write!(f, "{}[0..{}]", it.name, it.members);
    /// How many entries in how many rows.
    Pattern: |it, f| {
        counted(f, it.entries.len(), "entry").and_then(|()| f.write_str(" in "))?;
        counted(f, it.rows, "row")?;
        write!(f, ", {} constant", it.constants.len())
    };
    /// Φ of the row: `A.x: …`.
    EquationText: |it, f| write!(f, "{}: {}", it.row, it.phi);
    /// `step 3: dyad RRR …`.
    StepText: |it, f| write!(f, "step {}: {}", it.step + 1, it.what);
    /// `phi = …`, what is brought to zero, or the rows of a system.
    LineText: |it, f| match it {
        Self::Equation { left, right } => write!(f, "{left} = {right}"),
        Self::Zero { left, right } => write!(f, "{left} = {right} = 0"),
        Self::System { matrix, unknowns, right } => {
            f.write_str("[")?;
            let row = |f: &mut fmt::Formatter<'_>, row: &&[&str]| separated(f, *row, |f, entry| f.write_str(entry));
            matrix.iter().enumerate().try_for_each(|(k, entries)| {
                f.write_str(if k == 0 { "" } else { "; " }).and_then(|()| row(f, entries))
            })?;
            f.write_str("] (").and_then(|()| row(f, unknowns)).and_then(|()| f.write_str(") = ("))?;
            row(f, right).and_then(|()| f.write_str(")"))
        }
    };
    /// The row, by place, and the circuit.
    GenericRedundancy: |it, f| {
        write!(f, "row {} repeats ", it.row)?;
        separated(f, it.circuit, |f, joint| f.write_str(joint))
    };
    /// The ranks.
    Structure: |it, f| {
        write!(f, "rank {}, {} without driving rows, ", it.rank, it.rank_without_driving)?;
        counted(f, it.redundant.len(), "redundant row")
    };
    /// What it is for, and where it is fixed.
    Geometry: |it, f| write!(f, "{} in {}", it.role, it.frame);
    /// Its name.
    JointQuantity: |it, f| f.write_str(it.name);
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
