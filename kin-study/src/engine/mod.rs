//! Running studies and asking for their results, by DataFusion.

mod parts;
mod query;
mod run;
mod wave;
mod write;

pub use query::{Answer, query, query_to_file};
pub use run::{Limits, Report, Watch, run, run_part};
