//! The constraint set: Φ with everything that is reported, and the assembly state in which joints write their rows of
//! Φ.
//!
//! This module depends on `expr` and `mechanism`. It does not know the kinds of joints, and differentiates only to
//! obtain rates for rows of velocity level.

mod assembly;
mod condition;
mod declared;
mod define;
mod formula;
mod layout;
mod loads;
mod placed;
mod pose;
mod rows;
mod scalars;
mod set;
mod variables;

pub use crate::vocabulary::Frame;
pub(crate) use assembly::Assembly;
pub(crate) use layout::indexed;
pub(crate) use pose::{PlacedAxis, PlacedPoint, Pose};
pub(crate) use rows::JointRows;
pub(crate) use scalars::mark_scalars;
pub use set::{
    BodyInstance, ConditionInstance, ConstraintRow, ConstraintSet, Coordinate, CoordinateKind, CurveInstance,
    DefineInstance, Family, Geometry, JointInstance, Observable, ObservableKind, PointInstance, Quantity, RowMeaning,
    VelocityRow,
};
pub(crate) use variables::Variables;
