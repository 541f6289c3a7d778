//! The constraint set: Φ with everything that is reported, and the state in which joints write their rows of it.
//!
//! Imports `expr` and `mechanism`. Nothing here knows the kinds of joints, and nothing differentiates but rates, for which
//! rows of velocity level ask `expr`.

mod assembly;
mod condition;
mod declared;
mod define;
mod formula;
mod layout;
mod placed;
mod pose;
mod rows;
mod set;
mod variables;

pub use crate::vocabulary::Frame;
pub(crate) use assembly::Assembly;
pub(crate) use layout::indexed;
pub(crate) use pose::{PlacedAxis, PlacedPoint, Pose};
pub(crate) use rows::Rows;
pub use set::{
    BodyInstance, ConditionInstance, ConstraintRow, ConstraintSet, Coordinate, CoordinateKind, CurveInstance,
    DefineInstance, Family, Geometry, JointInstance, Observable, ObservableKind, PointInstance, Quantity, RowMeaning,
    VelocityRow,
};
pub(crate) use variables::Variables;
