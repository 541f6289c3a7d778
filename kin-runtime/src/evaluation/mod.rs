//! Interfaces of generated code: the trait of mechanisms, instants and inputs, and workspaces for results.

pub(crate) mod curve;
pub mod generic;
pub mod mechanism;
pub mod signal;
pub mod workspace;
