//! Scores: what is kept of a motion, accumulated in lanes.

mod accumulate;
mod path;
mod quantity;
mod reporter;
mod score;

pub(crate) use accumulate::{Gathering, Scoring};
pub use path::normalise;
pub(crate) use quantity::names;
pub use score::{Measure, Score};
