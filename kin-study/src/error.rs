//! Why a study has no result.

use datafusion::error::DataFusionError;
use kin_runtime::batch::BatchError;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a study has no result.
#[derive(Debug)]
#[non_exhaustive]
pub enum StudyError {
    /// The description is invalid, or it does not fit the mechanism.
    Description {
        /// The line of the file, from 1; `None` if the study was built in Rust.
        line: Option<usize>,
        /// What is wrong there, and what would be right.
        message: String,
    },
    /// The mechanism cannot be swept in lanes.
    Batch(BatchError),
    /// A file cannot be read or written.
    File {
        /// Which file.
        path: PathBuf,
        /// The error of the system.
        error: io::Error,
    },
    /// The directory holds another study, or parts that are not expected there.
    Directory(String),
    /// A scheduler or all of its workers do not answer, or a member of the cluster is another program. The text has the
    /// address.
    Cluster(String),
    /// An error of the engine, in a query or during a run.
    Engine(Box<DataFusionError>),
}

impl StudyError {
    /// An invalid description that was built in Rust, or whose line in its file is not known yet.
    pub(crate) fn description(message: impl Into<String>) -> Self {
        Self::Description { line: None, message: message.into() }
    }

    /// The same error with a line, unless it has one already.
    pub(crate) fn on_line(self, place: Option<usize>) -> Self {
        match self {
            Self::Description { line: None, message } => Self::Description { line: place, message },
            other => other,
        }
    }

    pub(crate) fn file(path: &Path, error: io::Error) -> Self {
        Self::File { path: path.to_owned(), error }
    }
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Description { line: Some(line), message } => write!(f, "line {line}: {message}"),
            Self::Description { line: None, message } | Self::Directory(message) | Self::Cluster(message) => {
                f.write_str(message)
            }
            Self::Batch(error) => error.fmt(f),
            Self::File { path, error } => write!(f, "{}: {error}", path.display()),
            Self::Engine(error) => error.strip_backtrace().fmt(f),
        }
    }
}

impl std::error::Error for StudyError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Description { .. } | Self::Directory(_) | Self::Cluster(_) => None,
            Self::Batch(error) => Some(error),
            Self::File { error, .. } => Some(error),
            Self::Engine(error) => Some(&**error),
        }
    }
}

impl From<BatchError> for StudyError {
    fn from(error: BatchError) -> Self {
        Self::Batch(error)
    }
}

/// An error of this crate that the engine has passed on becomes the original error again.
impl From<DataFusionError> for StudyError {
    fn from(error: DataFusionError) -> Self {
        match error {
            DataFusionError::External(inner) => match inner.downcast::<Self>() {
                Ok(error) => *error,
                Err(inner) => Self::Engine(Box::new(DataFusionError::External(inner))),
            },
            DataFusionError::Context(_, inner) => Self::from(*inner),
            other => Self::Engine(Box::new(other)),
        }
    }
}
