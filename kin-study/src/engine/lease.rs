//! Locks on the rows of a directory, so that two processes never compute the same rows at the same time.

use super::parts::ROWS;
use crate::error::StudyError;
use std::fs::{File, OpenOptions, TryLockError};
use std::ops::Range;
use std::path::Path;

/// The file with an exclusive lock of a whole run, or with shared locks of the jobs of an array.
const STUDY: &str = "study.lock";

/// A lock on rows; it ends when this value is dropped or the process ends in any way.
#[derive(Debug)]
pub(super) struct Lease {
    /// The locks last as long as these files are open.
    _files: Vec<File>,
}

impl Lease {
    /// Locks the whole study for a whole run. For a part, locks its own rows only, so that other parts can run beside
    /// it.
    pub(super) fn take(directory: &Path, rows: &Range<u64>, whole: bool) -> Result<Self, StudyError> {
        if whole {
            return Ok(Self { _files: vec![locked(directory, STUDY, File::try_lock)?] });
        }
        let name = format!("{ROWS}{:016}-{:016}.lock", rows.start, rows.end);
        let study = locked(directory, STUDY, File::try_lock_shared)?;
        Ok(Self { _files: vec![study, locked(directory, &name, File::try_lock)?] })
    }
}

fn locked(directory: &Path, name: &str, lock: impl Fn(&File) -> Result<(), TryLockError>) -> Result<File, StudyError> {
    let path = directory.join(name);
    let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
    let file = file.map_err(|error| StudyError::file(&path, error))?;
    match lock(&file) {
        Err(TryLockError::WouldBlock) => Err(StudyError::Directory(format!(
            "another process is computing these rows in {}; wait for it, or end it",
            directory.display()
        ))),
        // Some network file systems have no locks. There the user must not start the same job twice.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}
