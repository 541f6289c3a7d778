#![doc = include_str!("tour.md")]
#![cfg_attr(not(feature = "std"), no_std)]
// Says on docs.rs which feature a thing needs.
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(all(feature = "simd", feature = "alloc"))]
pub mod batch;
mod course;
mod curve;
pub mod function;
pub mod generic;
pub mod guide;
mod handles;
#[cfg(feature = "simd")]
mod lanes;
pub mod mechanism;
pub mod model;
pub mod plan;
pub mod planned;
#[doc(hidden)]
pub mod private;
pub mod scalar;
pub mod series;
pub mod signal;
#[doc(hidden)]
pub mod tables;
mod text;
#[cfg(feature = "simd")]
mod trig;
pub mod vocabulary;
pub mod workspace;

#[cfg(feature = "std")]
pub mod cross_check;
#[cfg(feature = "std")]
pub mod error;
#[cfg(feature = "std")]
pub mod events;
#[cfg(feature = "std")]
pub mod kinematics;
#[cfg(feature = "std")]
pub mod mobility;
#[cfg(feature = "std")]
pub mod modes;
#[cfg(feature = "std")]
pub mod motion;
#[cfg(feature = "std")]
pub mod observer;
#[cfg(feature = "std")]
pub mod options;
#[cfg(feature = "std")]
pub mod ratios;
#[cfg(feature = "std")]
pub mod solver;
#[cfg(feature = "std")]
pub mod state;
#[cfg(feature = "std")]
pub mod tracker;
#[cfg(feature = "std")]
pub mod trajectory;
#[cfg(feature = "std")]
pub mod transmission;

#[cfg(feature = "std")]
mod acceleration;
#[cfg(feature = "std")]
mod analysis;
#[cfg(feature = "std")]
mod assemble;
#[cfg(feature = "std")]
mod by_plan;
#[cfg(feature = "std")]
mod closure;
#[cfg(feature = "std")]
mod contact;
#[cfg(feature = "std")]
mod continuation;
#[cfg(feature = "std")]
mod dual;
#[cfg(feature = "std")]
mod equations;
#[cfg(feature = "std")]
mod factorisation;
#[cfg(all(test, feature = "std"))]
mod fixture;
#[cfg(feature = "std")]
mod geometry;
#[cfg(feature = "std")]
mod linear;
#[cfg(feature = "std")]
mod newton;
#[cfg(feature = "std")]
mod observables;
#[cfg(feature = "std")]
mod placement;
#[cfg(feature = "std")]
mod poses;
#[cfg(feature = "std")]
mod position;
#[cfg(feature = "std")]
mod radii;
#[cfg(feature = "std")]
mod random;
#[cfg(feature = "std")]
mod residual;
#[cfg(feature = "std")]
mod scale;
#[cfg(all(feature = "serde", feature = "std"))]
mod serial;
#[cfg(feature = "std")]
mod singular;
#[cfg(feature = "std")]
mod system;
#[cfg(all(test, feature = "std"))]
mod tests;
#[cfg(feature = "std")]
mod velocity;

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
pub mod present;

pub use curve::CurvePoint;
pub use function::ScalarFunction;
pub use generic::GenericMechanism;
pub use kin_derive::mechanism;
#[cfg(feature = "simd")]
pub use lanes::Lanes;
pub use mechanism::{LengthError, Mechanism, Observations, Workspace};
pub use planned::{Limit, LimitKind, Located, ModeKey, PlanError, Planned, Sign};
pub use scalar::Scalar;
pub use series::PowerSeries;
pub use signal::{Instant, Signal};
pub use workspace::{Array, Evaluation, Subset};

/// The linear algebra of dense results, so that a crate needs no version of its own to match.
#[cfg(feature = "std")]
pub use nalgebra;

#[cfg(feature = "std")]
pub use cross_check::{
    Configuration, CrossCheck, CrossCheckOptions, FunctionCheck, PlanCheck, WorstEntry, WorstPlanned,
};
#[cfg(feature = "std")]
pub use error::{Degeneracy, GeometryFault, Refusal, SolveError, SweepError};
#[cfg(feature = "std")]
pub use events::{Crossing, Event, Unwatched};
#[cfg(feature = "std")]
pub use kinematics::Kinematics;
#[cfg(feature = "std")]
pub use mobility::{Cause, Mobility, RedundantRow};
#[cfg(feature = "std")]
pub use modes::Mode;
#[cfg(feature = "std")]
pub use motion::{BodyMotion, ConditionMotion, Motion, PointMotion, Rates};
#[cfg(feature = "std")]
pub use observer::{Observer, Reached};
#[cfg(feature = "std")]
pub use options::Options;
#[cfg(feature = "std")]
pub use ratios::{InputRatio, VelocityRatio, VelocityRatios};
#[cfg(feature = "std")]
pub use series::{Derivatives, MotionDerivatives};
#[cfg(feature = "std")]
pub use solver::{Position, Solver};
#[cfg(feature = "std")]
pub use state::State;
#[cfg(feature = "std")]
pub use tracker::Tracker;
#[cfg(feature = "std")]
pub use trajectory::{Fallback, Trajectory};
#[cfg(feature = "std")]
pub use transmission::TransmissionAngle;
