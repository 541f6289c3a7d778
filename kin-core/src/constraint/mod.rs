//! From a mechanism to Φ: one constraint type per file, each writing its rows of Φ and nothing else.
//!
//! Imports `expr` and `mechanism`. Nothing here differentiates; a roller asks `expr` for the direction of its curve, and
//! rows of velocity level ask it for rates.

mod angle;
mod assembly;
mod belt;
mod condition;
mod coordinate;
mod curve;
mod define;
mod distance;
mod driver;
mod fixed;
mod formula;
mod gear;
mod knife_edge;
mod layout;
mod moving_operands;
mod nonholonomic;
mod placed;
mod point_on_line;
mod rack_pinion;
mod revolute;
mod rolling_on_disc;
mod rolling_on_line;
mod set;
mod speed;
mod tag;
mod translational;

pub use assembly::assemble;
pub use set::{
    BodyInstance, ConditionInstance, ConstraintRow, ConstraintSet, Coordinate, CoordinateKind, CurveInstance,
    DefineInstance, Family, Frame, Geometry, JointInstance, Observable, ObservableKind, PointInstance, Quantity, Role,
    VelocityRow,
};
pub use tag::JointTag;
