//! The command-line program of a mechanism's studies.

mod arguments;
mod interrupt;
mod progress;
mod remote;
mod watched;

use crate::engine::{Watch, missing, query, query_to_file, run, run_part};
use crate::error::StudyError;
use crate::scores::names;
use crate::study::Study;
use arguments::{Arguments, Command};
use clap::Parser;
use kin_runtime::Mechanism;
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use watched::{ran, read};

/// Runs the study program of the mechanism `M` with the arguments of this process: `run`, `chunk`, `missing`, `query`,
/// `names`, and `scheduler` and `worker`, which need the feature `cluster`.
///
/// The exit status is 0 after success, 2 if the arguments or the study are invalid, 1 for all other errors, and 130
/// after Ctrl-C or SIGTERM.
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
            // If stdout or stderr cannot be written, this cannot be reported anywhere.
            let _ = error.print();
            return ExitCode::from(status);
        }
    };
    let mut file = None;
    match executed::<M>(command, &mut file) {
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

/// Executes a command; `file` becomes the file of the study, which errors in its description are about.
fn executed<M>(command: Command, file: &mut Option<PathBuf>) -> Result<ExitCode, StudyError>
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
            printed(&format!("{}\n", array(&missing)))
        }
        Command::Query { sql, directory, out } => match out {
            Some(path) => {
                let rows = query_to_file(&directory, &sql, &path)?;
                eprintln!("{rows} rows in {}", path.display());
                Ok(ExitCode::SUCCESS)
            }
            None => printed(&format!("{}\n", query(&directory, &sql)?)),
        },
        Command::Names => printed(&listing::<M>()),
    }
}

/// Numbers in increasing order as job schedulers write them: `3,7-9`.
fn array(numbers: &[u64]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [number] => number.to_string(),
        [first, .., last] => format!("{first}-{last}"),
        [] => String::new(),
    });
    runs.collect::<Vec<_>>().join(",")
}

/// Writes to stdout. If the reader of a pipe has closed it early, that is no error.
fn printed(text: &str) -> Result<ExitCode, StudyError> {
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
}
