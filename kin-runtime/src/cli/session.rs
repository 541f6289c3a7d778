//! The streams of one run: results to stdout or a file, everything else to stderr.

use std::io::{self, Write};
use std::path::Path;

use super::failure::Failure;
use super::options::OutputArgs;
use crate::present::write_atomically;

/// One run of the program.
pub(super) struct Session<'a> {
    out: &'a mut dyn Write,
    err: &'a mut dyn Write,
}

impl<'a> Session<'a> {
    pub(super) fn new(out: &'a mut dyn Write, err: &'a mut dyn Write) -> Self {
        Self { out, err }
    }

    /// Writes a result where it was asked for.
    pub(super) fn deliver(&mut self, options: &OutputArgs, text: &str) -> Result<(), Failure> {
        self.deliver_to(options.file(), text.as_bytes())
    }

    /// Writes a result to a file, or to stdout where there is none or it is called `-`.
    pub(super) fn deliver_to(&mut self, file: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
        match file.filter(|path| *path != Path::new("-")) {
            Some(path) => write_atomically(path, bytes)
                .map_err(|e| Failure::Output(format!("--out: cannot write {}: {e}", path.display()))),
            None => {
                let written = self.out.write_all(bytes).and_then(|()| self.out.flush());
                match written {
                    // Whoever reads has seen enough (`… | head`): no fault of the answer.
                    Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(()),
                    other => other.map_err(|e| Failure::Output(format!("cannot write to stdout: {e}"))),
                }
            }
        }
    }

    /// Says something beside the result. When stderr is closed nobody wants to know.
    pub(super) fn note(&mut self, text: &str) {
        let _ = writeln!(self.err, "{}", text.trim_end());
    }

    /// Prints to stdout; the exit status.
    pub(super) fn print(&mut self, text: &str) -> u8 {
        let done = self.deliver(&OutputArgs::default(), text);
        self.finish(done)
    }

    /// Prints to stderr; the exit status.
    pub(super) fn complain(&mut self, text: &str, status: u8) -> u8 {
        self.note(text);
        status
    }

    /// The exit status of a command, its error said.
    pub(super) fn finish(&mut self, done: Result<(), Failure>) -> u8 {
        match done {
            Ok(()) => 0,
            Err(failure) => self.complain(&format!("error: {failure}"), failure.status()),
        }
    }
}
