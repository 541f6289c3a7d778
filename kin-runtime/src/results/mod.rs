//! The inputs and results of analyses, as data: options, states, motions, trajectories, arcs, events and errors.

pub mod arc;
pub mod assembly;
pub mod certificate;
pub mod error;
pub(crate) mod event;
pub mod forces;
pub mod motion;
pub mod observer;
pub mod options;
pub mod ranges;
pub mod sensitivities;
pub mod state;
pub mod trajectory;
pub(crate) mod varied;
