//! What generated code implements and is called with: the mechanism as a trait, instants and inputs, memory for results.

pub(crate) mod curve;
pub mod generic;
pub mod mechanism;
pub mod signal;
pub mod workspace;
