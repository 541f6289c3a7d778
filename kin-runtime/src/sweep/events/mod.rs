//! Events: the instants at which a motion passes the limit of a unilateral condition.
//!
//! A condition is watched as a number g(q, t), satisfied while g > 0, with ġ and g̈. Between two neighbouring
//! configurations of a sweep its course is one of five (`shape`): clear of zero, zero throughout, monotone, with one
//! extremum, or unclear; an interval with an unclear course is halved. Steps are as long as the mechanism allows, and a
//! condition may change faster than the mechanism: the interpolation of two samples is trusted only as far as it
//! predicts a third one between them. On a steady course the third sample is the one that two neighbouring steps share,
//! so that it costs nothing; elsewhere one more is computed. Where a step would need more samples than the limit
//! allows, the trajectory reports that the condition was not watched there. In a monotone piece with ends on different
//! sides of zero the crossing is bracketed and located (`root`). In a piece with an extremum that approaches zero the
//! extremum is located first, so that a crossing and its return within one step are both found. Values between two
//! configurations always come from the mechanism itself, solved on the branch, never from an interpolation.
//!
//! A condition that contains an absolute value has corners, where the samples of one side say nothing of the other: its step
//! is searched from corner to corner, which are located like crossings.
//!
//! `EventWatch` does not depend on how a sweep takes steps or computes states in between: the sweep passes every accepted
//! state to it, together with a function that computes states since the previous one.

mod sample;
mod search;
mod shape;
mod watch;

pub use crate::results::event::{Crossing, Event, Unwatched};
pub(crate) use watch::{EventWatch, WatchResult};

#[cfg(test)]
mod tests;
