//! The directory of a study. Its parts, Parquet files, are named by the rows that they cover, so that missing rows are
//! known from the names.

use super::write::temporary;
use crate::error::StudyError;
use crate::rows::Prepared;
use std::fs;
use std::io::{ErrorKind, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The file with the text that identifies the study of a directory.
const IDENTITY: &str = "study.txt";
/// The file with the SQL query that gives the table `study` from the table `parts`.
const VIEW: &str = "study.sql";
/// What the names of parts with rows begin with.
pub(super) const ROWS: &str = "rows-";
/// What the names of parts with counts begin with.
pub(super) const COUNTS: &str = "counts-";

/// The directory of a study.
#[derive(Debug)]
pub(super) struct Parts {
    directory: PathBuf,
}

impl Parts {
    /// The directory for a study, which is created if it does not exist. If it holds another study, or rows of this one
    /// without `resume`, that is an error.
    pub(super) fn open(directory: &Path, prepared: &Prepared, resume: bool) -> Result<Self, StudyError> {
        let parts = Self::of(directory);
        parts.is_no_pattern()?;
        fs::create_dir_all(directory).map_err(|error| StudyError::file(directory, error))?;
        // Of several jobs that begin at once, one writes these files; the others find them.
        if !parts.holds(prepared)? {
            parts.put_new(IDENTITY, &prepared.identity)?;
            parts.holds(prepared)?;
        }
        parts.put_new(VIEW, &prepared.kept.sql("parts"))?;
        if !resume && !parts.covered()?.is_empty() {
            return Err(StudyError::Directory(format!(
                "{} holds rows of this study already; go on with --resume, or choose another directory",
                directory.display()
            )));
        }
        Ok(parts)
    }

    /// Whether the directory holds this study. If it holds another study, that is an error.
    pub(super) fn holds(&self, prepared: &Prepared) -> Result<bool, StudyError> {
        let path = self.directory.join(IDENTITY);
        match fs::read_to_string(&path) {
            Ok(found) if found == prepared.identity => Ok(true),
            Ok(found) => {
                let mut lines = found.lines().zip(prepared.identity.lines());
                let directory = self.directory.display();
                Err(StudyError::Directory(match lines.find(|(old, new)| old != new) {
                    Some((old, new)) => format!(
                        "{directory} holds another study: it says `{}` where this one has `{}`; choose another directory",
                        old.trim(),
                        new.trim()
                    ),
                    None => format!("{} is damaged; choose another directory", path.display()),
                }))
            }
            Err(error)
                if error.kind() == ErrorKind::NotFound && self.files(ROWS).is_ok_and(|files| !files.is_empty()) =>
            {
                Err(StudyError::Directory(format!(
                    "{} holds rows, but no {IDENTITY}, which says of which study; choose another directory",
                    self.directory.display()
                )))
            }
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
            Err(error) => Err(StudyError::file(&path, error)),
        }
    }

    /// Writes a small file, whole or not at all; an existing file stays as it is.
    fn put_new(&self, name: &str, text: &str) -> Result<(), StudyError> {
        let path = self.directory.join(name);
        if path.exists() {
            return Ok(());
        }
        let failed = |error| StudyError::file(&path, error);
        let mut file = temporary(&self.directory).map_err(failed)?;
        file.write_all(text.as_bytes()).map_err(failed)?;
        match file.persist_noclobber(&path) {
            Err(error) if error.error.kind() != ErrorKind::AlreadyExists => Err(failed(error.error)),
            _ => Ok(()),
        }
    }

    /// The SQL query that gives the table `study` from the table `parts`.
    pub(super) fn view(&self) -> Result<String, StudyError> {
        let path = self.directory.join(VIEW);
        fs::read_to_string(&path).map_err(|error| StudyError::file(&path, error))
    }

    /// The directory of a study that has run.
    pub(super) fn of(directory: &Path) -> Self {
        Self { directory: directory.to_owned() }
    }

    /// An error if the engine would read the name of the directory as a pattern for several files.
    pub(super) fn is_no_pattern(&self) -> Result<(), StudyError> {
        match self.directory.to_string_lossy().contains(['*', '?', '[']) {
            false => Ok(()),
            true => Err(StudyError::Directory(format!(
                "{} contains *, ? or [, which would be read as a file pattern; choose another directory",
                self.directory.display()
            ))),
        }
    }

    /// Its path.
    pub(super) fn directory(&self) -> &Path {
        &self.directory
    }

    /// The file for some rows.
    pub(super) fn path(&self, kind: &str, rows: &Range<u64>) -> PathBuf {
        self.directory.join(format!("{kind}{:016}-{:016}.parquet", rows.start, rows.end))
    }

    /// The finished files of one kind with their rows, in order.
    pub(super) fn files(&self, kind: &str) -> Result<Vec<(Range<u64>, PathBuf)>, StudyError> {
        let wrong = |error| StudyError::file(&self.directory, error);
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.directory).map_err(wrong)? {
            let path = entry.map_err(wrong)?.path();
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            if let Some(rows) = covered_by(name, kind) {
                files.push((rows, path));
            }
        }
        files.sort_by_key(|(rows, _)| (rows.start, rows.end));
        Ok(files)
    }

    /// The rows that are done.
    pub(super) fn covered(&self) -> Result<Vec<Range<u64>>, StudyError> {
        let rows: Vec<Range<u64>> = self.files(ROWS)?.into_iter().map(|(rows, _)| rows).collect();
        match rows.windows(2).find(|pair| pair[1].start < pair[0].end) {
            None => Ok(rows),
            Some(pair) => Err(StudyError::Directory(format!(
                "two parts in {} cover row {}: remove one of them",
                self.directory.display(),
                pair[1].start
            ))),
        }
    }
}

/// The rows that a file covers, by its name.
fn covered_by(name: &str, kind: &str) -> Option<Range<u64>> {
    let (start, end) = name.strip_prefix(kind)?.strip_suffix(".parquet")?.split_once('-')?;
    Some(start.parse().ok()?..end.parse().ok()?)
}

/// The ranges of `rows` that are not covered, in order.
pub(super) fn gaps(rows: Range<u64>, covered: &[Range<u64>]) -> Vec<Range<u64>> {
    let mut gaps = Vec::new();
    let mut next = rows.start;
    for done in covered.iter().filter(|done| done.end > rows.start && done.start < rows.end) {
        gaps.extend((next < done.start).then_some(next..done.start));
        next = next.max(done.end);
    }
    gaps.extend((next < rows.end).then_some(next..rows.end));
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_what_nothing_covers() {
        assert_eq!(gaps(0..10, &[]).first(), Some(&(0..10)));
        assert_eq!(gaps(0..10, &[0..3, 5..9]), [3..5, 9..10]);
        assert_eq!(gaps(4..10, &[0..5, 7..8, 20..30]), [5..7, 8..10]);
        assert_eq!(gaps(4..10, &[0..6, 6..30]), []);
    }

    #[test]
    fn only_finished_parts_count() {
        assert_eq!(covered_by("rows-0000000000000000-0000000000000128.parquet", ROWS), Some(0..128));
        assert_eq!(covered_by("counts-0000000000000000-0000000000000128.parquet", ROWS), None);
        assert_eq!(covered_by("rows-0-1.parquet.tmp", ROWS), None);
        assert_eq!(covered_by(".tmpXYZ", ROWS), None);
    }
}
