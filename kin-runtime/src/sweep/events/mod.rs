//! Events: the instants at which a motion passes the limit of a unilateral condition.
//!
//! A condition is watched as a number g(q, t), satisfied while g > 0, with ġ and g̈. Between two neighbouring
//! configurations of a sweep its course is one of four (`shape`): clear of zero, monotone, turning once, or unclear;
//! an unclear one is halved. Steps are as long as the mechanism allows, and a condition may be faster than the mechanism:
//! what two samples say is believed as far as it foretells a third one between them. On a steady course that is the sample
//! that two neighbouring steps share, so that it costs nothing; elsewhere one is taken. Where a step would need more
//! samples than there is patience for, the trajectory says that the condition was not watched there. In a monotone piece whose ends lie on different sides the crossing is bracketed and located
//! (`root`); in a turning piece that heads for zero the extremum is located first, so that a crossing and its return
//! within one step are both found. What lies between two configurations is always the mechanism itself, solved on
//! the branch, never an interpolation.
//!
//! `Watch` knows neither how a sweep steps nor how a state in between is found: whoever sweeps hands it every accepted
//! state, and a function for the states since the one before.

mod sample;
mod shape;
mod watch;

pub use crate::results::event::{Crossing, Event, Unwatched};
pub(crate) use watch::{Seen, Watch};

#[cfg(test)]
mod tests;
