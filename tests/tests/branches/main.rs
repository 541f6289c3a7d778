//! Motions through folds and crossings of branches, against closed forms: a motion ends there with a typed error, or goes on
//! along the branch that is analytically the same one. Nothing else is ever given as good.
//!
//! Every motion is followed in all ways that there are: a sweep by the plan and one without it, a tracker, a follower of the
//! plan, a batch. `KIN_SWEEPS` asks for more sweeps than a usual run has.
#![cfg(feature = "simd")]

mod alone;
mod approaches;
mod arithmetic;
mod bars;
mod case;
mod chains;
mod closure;
mod crossings;
mod cylinders;
mod draw;
mod jet;
mod lifts;
mod located;
mod platforms;
mod redundant;
mod rig;
mod side_by_side;
mod tally;
mod turning;
mod twins;
mod ways;
