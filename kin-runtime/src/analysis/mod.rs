//! Analyses of one instant: assembly and assembly modes, position, velocity, acceleration, forces, degrees of
//! freedom, and singular configurations.

pub(crate) mod acceleration;
mod across;
mod assemble;
pub(crate) mod by_plan;
pub(crate) mod fit;
pub(crate) mod forces;
pub mod mobility;
pub mod modes;
pub(crate) mod poses;
pub(crate) mod position;
pub(crate) mod refinement;
pub(crate) mod rounding;
pub(crate) mod singular;
mod state;
pub(crate) mod subsystem_residual;
pub(crate) mod velocity;

pub(crate) use state::state;
