//! Runs studies and queries their results, by DataFusion.

mod found;
mod lease;
mod parts;
mod query;
mod run;
mod watch;
mod wave;
mod write;

pub use query::{Answer, query, query_to_file};
pub use run::{Limits, Report, missing, run, run_part};
pub use watch::Watch;

#[cfg(feature = "cluster")]
pub(crate) use {
    found::{Found, Summary, Workers, merged, solve},
    run::{Part, cover},
    wave::{TIME, most},
    write::Tally,
};
