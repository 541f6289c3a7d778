#![doc = include_str!("tour.md")]
#![cfg_attr(not(feature = "std"), no_std)]
// Says on docs.rs which feature a thing needs.
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(all(feature = "simd", feature = "alloc"))]
pub mod batch;
mod course;
mod evaluation;
pub mod function;
pub mod guide;
pub mod model;
pub mod plan;
pub mod planned;
#[doc(hidden)]
pub mod private;
pub mod scalar;
pub mod series;
#[doc(hidden)]
pub mod tables;
mod text;
pub mod vocabulary;

#[cfg(feature = "std")]
mod analysis;
#[cfg(feature = "std")]
pub mod cross_check;
#[cfg(feature = "std")]
mod equations;
#[cfg(all(test, feature = "std"))]
mod fixture;
#[cfg(feature = "std")]
pub mod kinematics;
#[cfg(feature = "std")]
mod linear;
#[cfg(feature = "std")]
mod nonlinear;
#[cfg(feature = "std")]
mod random;
#[cfg(feature = "std")]
mod report;
#[cfg(feature = "std")]
mod results;
#[cfg(all(feature = "serde", feature = "std"))]
mod serial;
#[cfg(feature = "std")]
pub mod solver;
#[cfg(feature = "std")]
mod sweep;
#[cfg(all(test, feature = "std"))]
mod tests;
#[cfg(feature = "std")]
pub mod tracker;

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
pub mod present;

pub use evaluation::curve::CurvePoint;
pub use evaluation::generic::GenericMechanism;
pub use evaluation::mechanism::{LengthError, Mechanism, Observations, Workspace};
pub use evaluation::signal::{Instant, Signal};
pub use evaluation::workspace::{Array, Evaluation, Subset};
pub use evaluation::{generic, mechanism, signal, workspace};
pub use function::ScalarFunction;
pub use kin_derive::mechanism;
pub use planned::{Limit, LimitKind, Located, ModeKey, PlanError, Planned, Sign};
pub use scalar::Scalar;
#[cfg(feature = "simd")]
pub use scalar::lanes::Lanes;
pub use series::PowerSeries;

/// The linear algebra of dense results, so that a crate needs no version of its own to match.
#[cfg(feature = "std")]
pub use nalgebra;

#[cfg(feature = "std")]
pub use {
    analysis::modes,
    analysis::modes::Mode,
    cross_check::{Configuration, CrossCheck, CrossCheckOptions, FunctionCheck, PlanCheck, WorstEntry, WorstPlanned},
    kinematics::Kinematics,
    report::mobility::{Cause, Mobility, RedundantRow},
    report::ratios::{InputRatio, VelocityRatio, VelocityRatios},
    report::transmission::TransmissionAngle,
    report::{mobility, ratios, transmission},
    results::error::{Degeneracy, GeometryFault, Refusal, SolveError, SweepError},
    results::event::{Crossing, Event, Unwatched},
    results::motion::{BodyMotion, ConditionMotion, Motion, PointMotion, Rates},
    results::observer::{Observer, Reached},
    results::options::Options,
    results::state::State,
    results::trajectory::{Fallback, Trajectory},
    results::{error, motion, observer, options, state, trajectory},
    series::{Derivatives, MotionDerivatives},
    solver::{Position, Solver},
    sweep::events,
    tracker::Tracker,
};
