//! Why a command failed, and its exit status.

use std::fmt;

/// What went wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// All errors in the options: status 2.
    Usage(Vec<String>),
    /// The analysis fails for these numbers, or a check does: status 1.
    Analysis(String),
    /// A file or stream could not be written: status 1.
    Output(String),
    /// Ctrl-C, with how much was finished: status 130, as of a program that the signal ends.
    Interrupted(String),
}

impl Failure {
    /// A usage error.
    pub(super) fn usage(message: impl Into<String>) -> Self {
        Self::Usage(vec![message.into()])
    }

    /// A usage error of one option.
    pub(super) fn option(option: &str, message: impl fmt::Display) -> Self {
        Self::usage(format!("{option}: {message}"))
    }

    /// The exit status.
    pub(super) fn status(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Analysis(_) | Self::Output(_) => 1,
            Self::Interrupted(_) => 130,
        }
    }

    /// The messages, one by one.
    pub(super) fn complaints(&self) -> &[String] {
        match self {
            Self::Usage(all) => all,
            Self::Analysis(text) | Self::Output(text) | Self::Interrupted(text) => std::slice::from_ref(text),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.complaints().join("\n"))
    }
}

/// All three, or `None`.
pub(super) fn zip3<A, B, C>(a: Option<A>, b: Option<B>, c: Option<C>) -> Option<(A, B, C)> {
    Some((a?, b?, c?))
}

/// Collects usage errors of several options, so that all of them are reported at once.
#[derive(Debug, Default)]
pub(super) struct Ledger {
    complaints: Vec<String>,
    /// The first error that is no usage error.
    other: Option<Failure>,
}

impl Ledger {
    /// The value; or `None`, with the error recorded.
    pub(super) fn take<T>(&mut self, result: Result<T, Failure>) -> Option<T> {
        match result {
            Ok(value) => return Some(value),
            Err(Failure::Usage(all)) => all.into_iter().for_each(|complaint| self.note(complaint)),
            Err(other) => self.other = self.other.take().or(Some(other)),
        }
        None
    }

    /// Records a usage error of one option.
    pub(super) fn fault(&mut self, option: &str, message: impl fmt::Display) {
        self.note(format!("{option}: {message}"));
    }

    /// Records a message, without its list of names if an earlier message has the same list.
    fn note(&mut self, complaint: String) {
        let is_listed =
            |listed: &str| self.complaints.iter().any(|c| c.split_once('\n').is_some_and(|(_, l)| l == listed));
        let short = match complaint.split_once('\n') {
            Some((message, listed)) if is_listed(listed) => message.to_owned(),
            _ => complaint,
        };
        self.complaints.push(short);
    }

    /// `value`, or the recorded errors.
    pub(super) fn close<T>(self, value: Option<T>) -> Result<T, Failure> {
        match (self.other, value) {
            (None, Some(value)) if self.complaints.is_empty() => Ok(value),
            (Some(other), _) if self.complaints.is_empty() => Err(other),
            _ => Err(Failure::Usage(self.complaints)),
        }
    }
}
