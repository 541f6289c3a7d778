//! Why a command did not do what was asked, and the exit status that says so.

use std::fmt;

/// What went wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// The options do not make sense: status 2.
    Usage(String),
    /// The mechanism has no good answer at these numbers: status 1.
    Analysis(String),
    /// A file or stream could not be written: status 1.
    Output(String),
}

impl Failure {
    /// A usage error of one option.
    pub(super) fn option(option: &str, what: impl fmt::Display) -> Self {
        Self::Usage(format!("{option}: {what}"))
    }

    /// The exit status.
    pub(super) fn status(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Analysis(_) | Self::Output(_) => 1,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Usage(text) | Self::Analysis(text) | Self::Output(text)) = self;
        f.write_str(text)
    }
}
