//! Scores: what is kept of a motion, gathered in lanes.

mod accumulate;
mod quantity;
mod reporter;
mod score;

pub(crate) use accumulate::Scoring;
pub(crate) use quantity::names;
pub use score::{Measure, Score};
