//! Symbolic kinematics of planar mechanisms.
pub mod error;
pub mod mechanism;
