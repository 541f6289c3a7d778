//! Kinematics of planar mechanisms.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod mechanism;
pub mod model;
pub mod scalar;
pub mod workspace;

pub use kin_derive::mechanism;
pub use mechanism::{LengthError, Mechanism, Observations, Workspace};
pub use scalar::Scalar;
pub use workspace::{Array, Evaluation, Instant, Signal, Subset};
