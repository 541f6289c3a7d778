//! Tables as Parquet files that appear whole or not at all.

use crate::error::StudyError;
use datafusion::arrow::datatypes::SchemaRef;
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::parquet::arrow::ArrowWriter;
use datafusion::parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use datafusion::parquet::errors::ParquetError;
use datafusion::parquet::file::metadata::KeyValue;
use datafusion::parquet::file::properties::WriterProperties;
use std::fs::File;
use std::io;
use std::path::Path;
use tempfile::NamedTempFile;

/// The numbers of rows of each kind among those that a part covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// How many there were.
    pub(crate) tried: u64,
    /// How many met the conditions before solving.
    pub(crate) solved: u64,
    /// How many of the solved rows have a motion that ended before the last instant.
    pub(crate) ended: u64,
    /// How many met all conditions.
    pub(crate) passed: u64,
}

impl Tally {
    /// Its numbers with their keys in the metadata of files.
    pub(crate) fn entries(&self) -> [(&'static str, u64); 4] {
        [("kin.tried", self.tried), ("kin.solved", self.solved), ("kin.ended", self.ended), ("kin.passed", self.passed)]
    }

    /// The tally with these named numbers; missing ones count as 0.
    pub(crate) fn of(number: impl Fn(&str) -> Option<u64>) -> Self {
        let [tried, solved, ended, passed] = Self::default().entries().map(|(key, none)| number(key).unwrap_or(none));
        Self { tried, solved, ended, passed }
    }

    /// The sum of both.
    pub(crate) fn and(&self, other: &Self) -> Self {
        Self {
            tried: self.tried + other.tried,
            solved: self.solved + other.solved,
            ended: self.ended + other.ended,
            passed: self.passed + other.passed,
        }
    }
}

/// A file with a temporary name in a directory, for contents that are to appear there complete. It is removed unless it
/// gets its final name.
pub(super) fn temporary(directory: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".kin-").suffix(".tmp");
    // The permissions are those that the umask gives, since a directory is often shared.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(directory)
}

/// Writes a table to a temporary file in the same directory, which then takes the place of `path`.
pub(super) fn write(
    path: &Path,
    schema: &SchemaRef,
    batches: &[RecordBatch],
    tally: Option<&Tally>,
) -> Result<(), StudyError> {
    let failed = |error: io::Error| StudyError::file(path, error);
    let parquet = |error: ParquetError| failed(system(error));
    let entries = tally
        .map(|tally| tally.entries().map(|(key, number)| KeyValue::new(key.to_owned(), number.to_string())).to_vec());
    // Numbers, which hardly repeat, gain nothing from a dictionary; names do.
    let mut properties = WriterProperties::builder().set_dictionary_enabled(false).set_key_value_metadata(entries);
    for name in ["mode", "limit", "of"] {
        properties = properties.set_column_dictionary_enabled(name.into(), true);
    }
    let directory = path.parent().unwrap_or(Path::new("."));
    let mut file = temporary(directory).map_err(failed)?;
    let mut writer =
        ArrowWriter::try_new(io::BufWriter::new(file.as_file_mut()), schema.clone(), Some(properties.build()))
            .map_err(parquet)?;
    for batch in batches {
        writer.write(batch).map_err(parquet)?;
    }
    writer.into_inner().map_err(parquet)?.into_inner().map_err(|error| failed(error.into_error()))?;
    file.as_file().sync_data().map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// The tally of a part.
pub(super) fn tally(path: &Path) -> Result<Tally, StudyError> {
    let file = File::open(path).map_err(|error| StudyError::file(path, error))?;
    let reader = ParquetRecordBatchReaderBuilder::try_new(file);
    let damaged = |error| format!("{} ({}): remove this file, and go on with --resume", path.display(), system(error));
    let reader = reader.map_err(|error| StudyError::Directory(damaged(error)))?;
    let entries = reader.metadata().file_metadata().key_value_metadata().cloned().unwrap_or_default();
    let number = |key: &str| {
        let entry = entries.iter().find(|entry| entry.key == key);
        entry.and_then(|entry| entry.value.as_ref()?.parse().ok())
    };
    Ok(Tally::of(number))
}

/// The error of the system, if that is the cause.
fn system(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(inner) => io::Error::other(inner),
        },
        other => io::Error::other(other),
    }
}
