#![doc = include_str!("../README.md")]

mod cli;
#[cfg(feature = "cluster")]
pub mod cluster;
mod engine;
mod error;
mod fingerprint;
mod machine;
mod rows;
mod sampling;
mod scores;
mod study;
mod suggest;

pub use cli::{main, run_from};
/// The crate of the tables in [`Answer`], so that users need not depend on the same version of it themselves.
pub use datafusion::arrow;
pub use engine::{Answer, Limits, Report, Watch, missing, query, query_to_file, run, run_part};
pub use error::StudyError;
pub use sampling::{Range, Sampling};
pub use scores::{Measure, Score, normalise};
pub use study::{Closures, Histogram, Ramp, Study};
