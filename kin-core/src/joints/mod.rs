//! From a mechanism to Φ. Each kind of joint is a file with its operands, its rows of Φ, its rules and its textbook
//! equations. All other code uses a joint only through the [slots](crate::mechanism::OperandSlot) of its operands.

mod angle;
mod assemble;
mod belt;
mod contact;
mod coordinate;
mod curve;
mod distance;
mod driver;
#[cfg(test)]
mod equidistant;
mod fixed;
mod free_equation;
mod gear;
mod joint;
mod kinds;
mod knife_edge;
mod nonholonomic;
mod point_on_line;
mod rack_pinion;
mod revolute;
mod rolling_on_disc;
mod rolling_on_line;
mod rope;
mod screw;
mod speed;
mod translational;

pub use angle::{Angle, RelativeAngle};
pub use assemble::assemble;
pub use belt::Belt;
pub(crate) use contact::{Contact, Normal};
pub use coordinate::{X, Y};
pub use curve::{FlatFollower, OnCurve};
pub use distance::Distance;
pub use driver::Driver;
pub use fixed::Fixed;
pub use free_equation::Constraint;
pub use gear::Gear;
pub(crate) use joint::Reaction;
pub use kinds::forms;
pub(crate) use kinds::{check, contact_of, reaction_of, rows_of, vector_equations};
pub use knife_edge::KnifeEdge;
pub use nonholonomic::Nonholonomic;
pub use point_on_line::PointOnLine;
pub use rack_pinion::RackPinion;
pub use revolute::Revolute;
pub use rolling_on_disc::RollingOnDisc;
pub use rolling_on_line::RollingOnLine;
pub use rope::Rope;
pub use screw::Screw;
pub use speed::Speed;
pub use translational::Translational;
