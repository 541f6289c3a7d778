//! Events: the instants at which a motion passes the limit of a unilateral condition.
//!
//! A condition is watched as a number g(q, t), satisfied while g > 0, with ġ and g̈. Between two neighbouring
//! configurations of a sweep its course is one of four (`shape`): clear of zero, monotone, turning once, or unclear;
//! an unclear one is halved. In a monotone piece whose ends lie on different sides the crossing is bracketed and located
//! (`root`); in a turning piece that heads for zero the extremum is located first, so that a crossing and its return
//! within one step are both found. What lies between two configurations is always the mechanism itself, solved on
//! the branch, never an interpolation.
//!
//! `Watch` knows neither how a sweep steps nor how a state in between is found: whoever sweeps hands it every accepted
//! state, and a function for the states since the one before.

mod event;
mod root;
mod sample;
mod shape;
mod watch;

pub use event::{Crossing, Event};
pub(crate) use watch::Watch;

#[cfg(test)]
mod tests;
