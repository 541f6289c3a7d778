//! What analyses take and give, as data: options, states, motions, trajectories, crossings and errors.

pub mod assembly;
pub mod certificate;
pub mod error;
pub(crate) mod event;
pub mod forces;
pub mod motion;
pub mod observer;
pub mod options;
pub mod sensitivities;
pub mod state;
pub mod trajectory;
