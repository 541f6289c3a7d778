//! The words of the command line.

use clap::Parser;
use std::net::IpAddr;
use std::num::NonZero;
use std::path::PathBuf;

/// Studies of one mechanism: many designs, a motion of each, and what is worth keeping.
#[derive(Debug, Parser)]
#[command(subcommand_value_name = "COMMAND")]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, clap::Subcommand)]
pub(super) enum Command {
    /// Run a study on all cores of this machine, or on a cluster
    ///
    /// Finished rows are written every few seconds. Ctrl-C ends the run and keeps them; --resume goes on. A second Ctrl-C
    /// ends the program at once. SIGTERM does the same. The exit status is 0 when all rows are done, 130 after a signal.
    Run {
        #[command(flatten)]
        run: RunArgs,
        #[command(flatten)]
        cluster: ClusterArgs,
    },
    /// Start the scheduler of a cluster; `run --cluster` hands it studies
    ///
    /// It has no password and no encryption: whoever reaches its port can use it and its workers.
    Scheduler {
        #[command(flatten)]
        listen: ListenArgs,
        /// The port; 0 takes any that is free
        #[arg(long, value_name = "PORT", default_value_t = 50050)]
        port: u16,
    },
    /// Start a worker of a cluster; it ends with Ctrl-C or SIGTERM
    ///
    /// It must be the same file as the scheduler and as the program that runs the study, and like these it trusts its network.
    Worker {
        /// The scheduler
        #[arg(long, value_name = "HOST:PORT")]
        scheduler: String,
        #[command(flatten)]
        listen: ListenArgs,
        /// Its port; it takes the next one, too. 0 takes two that are free
        #[arg(long, value_name = "PORT", default_value_t = 0)]
        port: u16,
        /// Number of threads [default: number of processors]
        #[arg(long, value_name = "N")]
        threads: Option<NonZero<usize>>,
    },
    /// Run one of several parts of a study: for an array of jobs that share a directory
    ///
    /// All jobs use the same N. With --resume a job that was killed may be started again: it continues after the last
    /// rows that were written, and does nothing where all are there. Two processes never work on the same part.
    Chunk {
        #[command(flatten)]
        run: RunArgs,
        /// Which part, from 0
        #[arg(long, value_name = "I")]
        index: u64,
        /// How many parts there are
        #[arg(long, value_name = "N")]
        of: NonZero<u64>,
    },
    /// List the parts whose rows are not all there, as job schedulers write an array: 3,7-9
    Missing {
        #[command(flatten)]
        study: StudyArgs,
        /// The directory for its rows
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
        /// How many parts there are
        #[arg(long, value_name = "N")]
        of: NonZero<u64>,
    },
    /// Query rows by SQL: the tables are `study` and, where there are histograms, `histogram`
    Query {
        /// The query, for example: select * from study order by swing desc limit 10
        sql: String,
        /// The directory of the study
        #[arg(long = "in", value_name = "DIR")]
        directory: PathBuf,
        /// Write the answer to a file, .csv or .parquet, instead of a table on the screen
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// List the parameters, modes and quantities of the mechanism by the names that a study uses
    Names,
}

#[derive(Debug, clap::Args)]
pub(super) struct StudyArgs {
    /// The study, a TOML file
    pub(super) study: PathBuf,
    /// Take another number of rows than the file says
    #[arg(long, value_name = "N", value_parser = rows)]
    pub(super) rows: Option<u64>,
}

#[derive(Debug, clap::Args)]
pub(super) struct RunArgs {
    #[command(flatten)]
    pub(super) study: StudyArgs,
    /// The directory for its rows
    #[arg(long, value_name = "DIR")]
    pub(super) out: PathBuf,
    /// Go on with what the directory holds already
    #[arg(long)]
    pub(super) resume: bool,
    /// Number of threads [default: number of processors]
    #[arg(long, value_name = "N")]
    pub(super) threads: Option<NonZero<usize>>,
}

#[derive(Debug, clap::Args)]
pub(super) struct ClusterArgs {
    /// Let the workers of this scheduler solve the rows
    #[arg(long, value_name = "HOST:PORT", conflicts_with_all = ["standalone", "threads"])]
    pub(super) cluster: Option<String>,
    /// Solve the rows on a cluster within this process, for a trial
    #[arg(long)]
    pub(super) standalone: bool,
    /// Number of tasks per wave (some seconds of work): at least as many as the cluster has cores, at most 2000
    /// [default: 64]
    #[arg(long, value_name = "N", requires = "cluster")]
    pub(super) tasks: Option<NonZero<usize>>,
}

#[derive(Debug, clap::Args)]
pub(super) struct ListenArgs {
    /// The address of the interface to listen on
    #[arg(long, value_name = "IP", default_value = "127.0.0.1")]
    pub(super) bind: IpAddr,
    /// The name by which other machines reach this one [default: the address of --bind]
    #[arg(long, value_name = "HOST")]
    pub(super) host: Option<String>,
}

/// A number of rows; 1e6 is one, too.
fn rows(text: &str) -> Result<u64, String> {
    let number: f64 = text.parse().map_err(|_| "a number like 1000 or 1e6 is expected".to_owned())?;
    let is_count = number.fract() == 0.0 && (0.0..=9e15).contains(&number);
    if is_count { Ok(number as u64) } else { Err("a whole number is expected".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_of_rows_is_whole() {
        assert_eq!((rows("1e6"), rows("12")), (Ok(1_000_000), Ok(12)));
        assert!(rows("1.5").is_err() && rows("-1").is_err() && rows("many").is_err());
    }
}
