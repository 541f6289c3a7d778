//! Motions through folds of branches (dead centres) and crossings of branches, compared with closed forms: a motion
//! ends there with a typed error, or continues along its analytic branch. No other state is accepted.
//!
//! Every motion is followed by all methods: a sweep with the plan and one without, a tracker, a follower of the plan,
//! and a batch. `KIN_SWEEPS` sets the number of sweeps.
#![cfg(feature = "simd")]

mod alone;
mod approaches;
mod arithmetic;
mod bars;
mod belted;
mod bumps;
mod case;
mod chains;
mod closure;
mod corners;
mod crossings;
mod cylinders;
mod draw;
mod flat;
mod iterated;
mod jet;
mod lengths;
mod lifts;
mod located;
mod moving;
mod platforms;
mod rates_beside_crossings;
mod redundant;
mod rig;
mod side_by_side;
mod slots;
mod tally;
mod tappets;
mod turning;
mod twins;
mod ways;
mod without_groups;
