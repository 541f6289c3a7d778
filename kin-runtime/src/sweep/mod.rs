//! A motion over many instants, and the events on its way.

pub(crate) mod arc;
pub(crate) mod continuation;
pub mod events;
