//! The command-line program of a mechanism's studies.

mod interrupt;
mod progress;
mod remote;

use crate::engine::{Limits, Report, Watch, missing, query, query_to_file, run, run_part};
use crate::error::StudyError;
use crate::scores::names;
use crate::study::Study;
use clap::Parser;
use kin_runtime::Mechanism;
use progress::Progress;
use std::ffi::OsString;
use std::io::{self, Write};
use std::net::IpAddr;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Studies of one mechanism: many designs, a motion of each, and what is worth keeping.
#[derive(Debug, Parser)]
#[command(subcommand_value_name = "COMMAND")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
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
        /// Threads; as many as there are processors where nobody says
        #[arg(long, value_name = "N")]
        threads: Option<NonZero<usize>>,
    },
    /// Run one of several parts of a study: for an array of jobs that share a directory
    ///
    /// All jobs say the same N. With --resume a job that was killed may be started again: it goes on behind the last rows
    /// that were written, and does nothing where all are there. Two processes never work on the same part.
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
    /// Ask for rows by SQL: the tables are `study` and, where there are histograms, `histogram`
    Query {
        /// The question, for example: select * from study order by swing desc limit 10
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
struct StudyArgs {
    /// The study, a TOML file
    study: PathBuf,
    /// Take another number of rows than the file says
    #[arg(long, value_name = "N", value_parser = rows)]
    rows: Option<u64>,
}

#[derive(Debug, clap::Args)]
struct RunArgs {
    #[command(flatten)]
    study: StudyArgs,
    /// The directory for its rows
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Go on with what the directory holds already
    #[arg(long)]
    resume: bool,
    /// Threads; as many as there are processors where nobody says
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
}

#[derive(Debug, clap::Args)]
struct ClusterArgs {
    /// Let the workers of this scheduler solve the rows
    #[arg(long, value_name = "HOST:PORT", conflicts_with_all = ["standalone", "threads"])]
    cluster: Option<String>,
    /// Let a cluster within this process solve them, to try what a study does there
    #[arg(long)]
    standalone: bool,
    /// Into how many tasks the work of some seconds is cut: at least as many as the cluster has cores, at most 2000 [default: 64]
    #[arg(long, value_name = "N", requires = "cluster")]
    tasks: Option<NonZero<usize>>,
}

#[derive(Debug, clap::Args)]
struct ListenArgs {
    /// The address of the interface to listen on
    #[arg(long, value_name = "IP", default_value = "127.0.0.1")]
    bind: IpAddr,
    /// The name by which other machines reach this one; that address where nobody says
    #[arg(long, value_name = "HOST")]
    host: Option<String>,
}

/// Runs the study program of the mechanism `M` with the arguments of this process: `run`, `chunk`, `missing`, `query`,
/// `names`, and `scheduler` and `worker`, which need the feature `cluster`.
///
/// The exit status is 0 when everything went well, 2 when arguments or the study make no sense, 1 for all other errors, and
/// 130 after Ctrl-C or SIGTERM.
pub fn main<M: Mechanism + Default + Send + Sync + 'static>() -> ExitCode {
    run_from::<M>(std::env::args_os())
}

/// Runs the study program of the mechanism `M` with these arguments; the first is the program's name.
pub fn run_from<M>(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    let command = match Arguments::try_parse_from(args) {
        Ok(arguments) => arguments.command,
        Err(error) => {
            let status = if error.use_stderr() { 2 } else { 0 };
            // Where nobody reads, there is nobody to tell.
            let _ = error.print();
            return ExitCode::from(status);
        }
    };
    let mut file = None;
    match done::<M>(command, &mut file) {
        Ok(code) => code,
        Err(error) => {
            let status = if matches!(error, StudyError::Description { .. }) { 2 } else { 1 };
            match (&error, file) {
                (StudyError::Description { line: Some(line), message }, Some(path)) => {
                    eprintln!("error: {}:{line}: {message}", path.display());
                }
                _ => eprintln!("error: {error}"),
            }
            ExitCode::from(status)
        }
    }
}

/// Does what is asked; notes which file a complaint is about.
fn done<M>(command: Command, file: &mut Option<PathBuf>) -> Result<ExitCode, StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    match command {
        Command::Run { run: args, cluster } if cluster.cluster.is_none() && !cluster.standalone => {
            ran(&args, file, run::<M>)
        }
        Command::Run { run: args, cluster } => remote::run_on::<M>(&args, cluster, file),
        Command::Scheduler { listen, port } => remote::scheduler::<M>(listen, port),
        Command::Worker { scheduler, listen, port, threads } => remote::worker::<M>(&scheduler, listen, port, threads),
        Command::Chunk { run: args, index, of } => {
            ran(&args, file, |study: &Study, out: &Path, limits, watch: &Watch| {
                run_part::<M>(study, out, (index, of), limits, watch)
            })
        }
        Command::Missing { study, out, of } => {
            let missing = missing::<M>(&read(&study, file)?, &out, of)?;
            said(&format!("{}\n", array(&missing)))
        }
        Command::Query { sql, directory, out } => match out {
            Some(path) => {
                let rows = query_to_file(&directory, &sql, &path)?;
                eprintln!("{rows} rows in {}", path.display());
                Ok(ExitCode::SUCCESS)
            }
            None => said(&format!("{}\n", query(&directory, &sql)?)),
        },
        Command::Names => said(&listing::<M>()),
    }
}

/// Runs a study in one of the ways that there are.
fn ran(
    args: &RunArgs,
    file: &mut Option<PathBuf>,
    run: impl FnOnce(&Study, &Path, Limits, &Watch) -> Result<Report, StudyError>,
) -> Result<ExitCode, StudyError> {
    let study = read(&args.study, file)?;
    let limits = Limits { threads: args.threads, resume: args.resume };
    let progress = Progress::begin();
    let report = run(&study, &args.out, limits, progress.watch());
    let interrupted = progress.end();
    let report = report?;
    eprintln!("{report}");
    if interrupted && !report.is_complete() {
        eprintln!("what is done is kept in {}; go on with --resume", args.out.display());
        return Ok(ExitCode::from(130));
    }
    Ok(ExitCode::SUCCESS)
}

/// The study of a file; complaints from here on are about that file.
fn read(args: &StudyArgs, file: &mut Option<PathBuf>) -> Result<Study, StudyError> {
    let text = std::fs::read_to_string(&args.study).map_err(|error| StudyError::file(&args.study, error))?;
    *file = Some(args.study.clone());
    let study = Study::from_toml(&text)?;
    Ok(match args.rows {
        Some(rows) => study.rows(rows),
        None => study,
    })
}

/// A number of rows; 1e6 is one, too.
fn rows(text: &str) -> Result<u64, String> {
    let number: f64 = text.parse().map_err(|_| "a number like 1000 or 1e6 is expected".to_owned())?;
    let is_count = number.fract() == 0.0 && (0.0..=9e15).contains(&number);
    if is_count { Ok(number as u64) } else { Err("a whole number is expected".to_owned()) }
}

/// Numbers in increasing order as job schedulers write them: `3,7-9`.
fn array(numbers: &[u64]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [one] => one.to_string(),
        [first, .., last] => format!("{first}-{last}"),
        [] => String::new(),
    });
    runs.collect::<Vec<_>>().join(",")
}

/// Writes to stdout; nothing is wrong where a reader leaves early.
fn said(text: &str) -> Result<ExitCode, StudyError> {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(StudyError::file(Path::new("stdout"), error)),
        _ => Ok(ExitCode::SUCCESS),
    }
}

fn listing<M: Mechanism>() -> String {
    let model = M::model();
    let section = |title: &str, names: &[String]| match names.is_empty() {
        true => String::new(),
        false => format!("{title}\n{}", names.iter().map(|name| format!("  {name}\n")).collect::<String>()),
    };
    let parameters: Vec<String> = model
        .parameters
        .iter()
        .map(|parameter| {
            let default = parameter.default.map_or_else(String::new, |value| format!(" = {value}"));
            format!("{}{default} {}", parameter.name, parameter.unit.unwrap_or_default()).trim_end().to_owned()
        })
        .collect();
    let modes: Vec<String> = model.plan.modes.iter().map(|mode| mode.name.to_owned()).collect();
    let inputs: Vec<String> = model.inputs.iter().map(|name| (*name).to_owned()).collect();
    section("parameters", &parameters)
        + &section("inputs", &inputs)
        + &section("modes", &modes)
        + &section("quantities", &names(model))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_listed_as_job_schedulers_write_them() {
        assert_eq!(array(&[]), "");
        assert_eq!(array(&[3, 7, 8, 9, 12, 13]), "3,7-9,12-13");
    }

    #[test]
    fn a_number_of_rows_is_whole() {
        assert_eq!((rows("1e6"), rows("12")), (Ok(1_000_000), Ok(12)));
        assert!(rows("1.5").is_err() && rows("-1").is_err() && rows("many").is_err());
    }
}
