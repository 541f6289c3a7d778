#![doc = include_str!("tour.md")]
#![cfg_attr(not(feature = "std"), no_std)]
// Shows on docs.rs which feature an item needs.
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
mod quintic;
pub mod scalar;
#[doc(hidden)]
pub mod tables;
mod text;
pub mod vocabulary;

#[cfg(feature = "std")]
mod analysis;
#[cfg(feature = "std")]
pub mod cross_check;
#[cfg(feature = "design")]
pub mod design;
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
mod proof;
#[cfg(feature = "std")]
mod random;
#[cfg(feature = "std")]
mod report;
#[cfg(feature = "std")]
mod results;
#[cfg(feature = "std")]
mod sensitivity;
#[cfg(all(feature = "serde", feature = "std"))]
mod serial;
#[cfg(feature = "std")]
pub mod series;
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
mod present;

pub use evaluation::curve::CurvePoint;
pub use evaluation::{generic, mechanism, signal, workspace};
pub use kin_derive::mechanism;
#[cfg(feature = "simd")]
pub use scalar::lanes::Lanes;
#[cfg(feature = "std")]
pub use {
    analysis::{mobility, modes},
    report::{measure, ratios, transmission},
    results::{
        arc, assembly, certificate, error, forces, motion, observer, options, ranges, sensitivities, state, trajectory,
    },
    sweep::events,
};

/// The linear algebra crate whose types occur in dense results, re-exported so that users have the same version.
#[cfg(feature = "std")]
pub use nalgebra;

#[doc(no_inline)]
pub use crate::{
    function::ScalarFunction,
    generic::GenericMechanism,
    mechanism::{LengthError, Mechanism, Observations, Workspace},
    planned::{InputRange, Limit, LimitKind, Located, ModeKey, OutOfRange, PlanError, Planned, Sign},
    scalar::Scalar,
    signal::{Instant, Signal},
    workspace::{Array, Evaluation, Subset},
};

#[cfg(feature = "std")]
#[doc(no_inline)]
pub use crate::{
    arc::{ArcEnd, ArcFault, ArcPlace, ArcPlaceKind, SolutionArc},
    assembly::{Assemblies, Assembly, Undecided},
    certificate::{Certificate, Uncertified},
    cross_check::{Configuration, CrossCheck, CrossCheckOptions, FunctionCheck, WorstEntry},
    error::{Degeneracy, GeometryFault, Refusal, SolveError, SweepError},
    events::{Crossing, Event, Unwatched},
    forces::{ContactChange, Effort, Forces, Load, Reaction, SpringForce, Wrench},
    kinematics::Kinematics,
    measure::Measure,
    mobility::{Cause, Mobility, RedundantRow},
    modes::Mode,
    motion::{BodyMotion, ConditionMotion, Motion, PointMotion, Rates},
    observer::{Observer, Reached},
    options::Options,
    ranges::{Range, RangeLimit, Ranges},
    ratios::{VelocityRatio, VelocityRatios},
    sensitivities::{Deviation, Sensitivities, Sensitivity},
    series::{Derivatives, MotionDerivatives},
    solver::{Position, Solver},
    state::State,
    tracker::Tracker,
    trajectory::{Fallback, Trajectory},
    transmission::TransmissionAngle,
};
