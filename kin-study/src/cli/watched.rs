//! Reads a study from its file and runs it, with its progress on the screen.

use super::arguments::{RunArgs, StudyArgs};
use super::progress::Progress;
use crate::engine::{Limits, Report, Watch};
use crate::error::StudyError;
use crate::study::Study;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Runs a study by `run`: a whole run, one part, or a run on a cluster.
pub(super) fn ran(
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

/// The study of a file. `file` becomes its path, so that errors in the description name it.
pub(super) fn read(args: &StudyArgs, file: &mut Option<PathBuf>) -> Result<Study, StudyError> {
    let text = std::fs::read_to_string(&args.study).map_err(|error| StudyError::file(&args.study, error))?;
    *file = Some(args.study.clone());
    let study = Study::from_toml(&text)?;
    Ok(match args.rows {
        Some(rows) => study.rows(rows),
        None => study,
    })
}
