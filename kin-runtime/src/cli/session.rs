//! The streams of one run: results to stdout or a file, everything else to stderr.

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::rc::Rc;

use anstream::{AutoStream, ColorChoice};

use super::failure::Failure;
use super::interrupt::Interrupt;
use super::output::{Destination, OutputArgs, Target};
use super::paint;
use super::watch::ProgressWatch;
use crate::present::output::{write_atomically, write_atomically_by};

/// The surroundings of a run: where its streams go, and whether it can be interrupted.
#[derive(Clone, Debug)]
pub(super) struct Surroundings {
    /// Whether results (stdout) and messages (stderr) may be coloured.
    pub(super) colours: [bool; 2],
    /// Whether stdout is a terminal.
    pub(super) screen: bool,
    /// Whether stderr is a terminal, so that a progress bar is shown.
    pub(super) bar: bool,
    pub(super) interrupt: Interrupt,
}

impl Surroundings {
    /// Streams that are no terminals.
    #[cfg(test)]
    pub(super) fn plain() -> Self {
        Self { colours: [false; 2], screen: false, bar: false, interrupt: Interrupt::without_handlers() }
    }

    /// Those of this process. Terminals are coloured unless `NO_COLOR` or `CLICOLOR_FORCE` says otherwise.
    pub(super) fn of_process() -> Self {
        let coloured = |choice: ColorChoice| choice != ColorChoice::Never;
        let colours = [AutoStream::choice(&io::stdout()), AutoStream::choice(&io::stderr())].map(coloured);
        let (screen, bar) = (io::stdout().is_terminal(), io::stderr().is_terminal());
        Self { colours, screen, bar, interrupt: Interrupt::of_process() }
    }
}

/// One run of the program.
pub(super) struct Session<'a> {
    out: &'a mut dyn Write,
    err: &'a mut dyn Write,
    colours: [bool; 2],
    screen: bool,
    watch: Rc<ProgressWatch>,
    /// Whether the reader of the result closed its pipe before all was written.
    reader_left: bool,
}

/// The exit status if the reader closed its pipe early: that of a program which SIGPIPE ends.
const READER_LEFT: u8 = 141;

impl<'a> Session<'a> {
    pub(super) fn new(out: &'a mut dyn Write, err: &'a mut dyn Write, around: Surroundings) -> Self {
        let watch = Rc::new(ProgressWatch::new(around.interrupt, around.bar));
        Self { out, err, colours: around.colours, screen: around.screen, watch, reader_left: false }
    }

    /// The progress bar and the interruption of this run.
    pub(super) fn watch(&self) -> Rc<ProgressWatch> {
        Rc::clone(&self.watch)
    }

    /// The form of the result of `command` and its target; pictures and pages are not written to a terminal.
    pub(super) fn destination<'o>(&self, options: &'o OutputArgs, command: &str) -> Result<Destination<'o>, Failure> {
        let to = options.destination(command)?;
        if self.screen && to.target == Target::Out && !to.form.is_readable() {
            let (form, ending) = (to.form.name(), to.form.endings()[0]);
            let message =
                format!("{form} is not shown on a terminal; write --out FILE.{ending}, or pipe it to another program");
            return Err(Failure::option("--out", message));
        }
        Ok(to)
    }

    /// Writes a result to its target.
    pub(super) fn deliver(&mut self, to: &Destination<'_>, text: &str) -> Result<(), Failure> {
        match self.colours[0] && to.is_for_people() {
            true => self.deliver_bytes(to, paint::result(text).as_bytes()),
            false => self.deliver_bytes(to, text.as_bytes()),
        }
    }

    /// Writes a result that may be binary.
    pub(super) fn deliver_bytes(&mut self, to: &Destination<'_>, bytes: &[u8]) -> Result<(), Failure> {
        self.write(to.target, bytes)?;
        to.contradiction().iter().for_each(|note| self.note(note));
        Ok(())
    }

    /// Whether the result itself goes to a terminal, so that a progress bar would appear between its lines.
    pub(super) fn is_seen(&self, to: &Destination<'_>) -> bool {
        self.screen && to.target == Target::Out
    }

    /// Writes a result piece by piece. If `write` fails, a file keeps its old contents.
    pub(super) fn stream(
        &mut self,
        to: &Destination<'_>,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let written = match to.target {
            Target::Out => buffered(&mut *self.out, write),
            Target::Err => buffered(&mut *self.err, write),
            Target::File(path) => write_atomically_by(path, |file| buffered(file, write)),
        };
        self.check_written(to.target, written)?;
        to.contradiction().iter().for_each(|note| self.note(note));
        Ok(())
    }

    fn write(&mut self, target: Target<'_>, bytes: &[u8]) -> Result<(), Failure> {
        let written = match target {
            Target::Out => self.out.write_all(bytes).and_then(|()| self.out.flush()),
            Target::Err => self.err.write_all(bytes).and_then(|()| self.err.flush()),
            Target::File(path) => self.watch.hold(|| write_atomically(path, bytes)),
        };
        self.check_written(target, written)
    }

    fn check_written(&mut self, target: Target<'_>, written: io::Result<()>) -> Result<(), Failure> {
        match written {
            // The reader has closed the pipe (`… | head`). That is no error to report, but the exit status shows it.
            Err(e) if e.kind() == io::ErrorKind::BrokenPipe => {
                self.reader_left = true;
                Ok(())
            }
            other => other.map_err(|e| Failure::Output(format!("{target}: {}", reason(&e)))),
        }
    }

    /// Writes a message to stderr. If that fails, it cannot be reported anywhere and is ignored.
    pub(super) fn note(&mut self, text: &str) {
        let text = text.trim_end();
        let watch = self.watch();
        let _ = watch.aside(|| match self.colours[1] {
            true => writeln!(self.err, "{}", paint::remark(text)),
            false => writeln!(self.err, "{text}"),
        });
    }

    /// Prints help; returns the exit status.
    pub(super) fn help(&mut self, text: &clap::builder::StyledStr) -> u8 {
        let text = if self.colours[0] { text.ansi().to_string() } else { text.to_string() };
        let outcome = self.write(Target::Out, text.as_bytes());
        self.finish(outcome)
    }

    /// Prints an error of the arguments; returns the exit status.
    pub(super) fn refuse(&mut self, text: &clap::builder::StyledStr, more: &str) -> u8 {
        let text = if self.colours[1] { text.ansi().to_string() } else { text.to_string() };
        let _ = write!(self.err, "{}{more}", text.trim_end());
        2
    }

    /// Prints the error of a command, if there is one; returns the exit status.
    pub(super) fn finish(&mut self, outcome: Result<(), Failure>) -> u8 {
        self.watch.end();
        match outcome {
            Ok(()) if self.reader_left => READER_LEFT,
            Ok(()) => 0,
            Err(Failure::Interrupted(how_far)) => {
                self.note(&format!("interrupted: {how_far}"));
                Failure::Interrupted(how_far).status()
            }
            Err(failure) => {
                for complaint in failure.complaints() {
                    self.note(&format!("error: {complaint}"));
                }
                failure.status()
            }
        }
    }
}

/// Writes through a buffer. If `write` fails, the rest of the buffer is discarded.
fn buffered<W: Write>(out: W, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut buffer = io::BufWriter::with_capacity(1 << 16, out);
    match write(&mut buffer) {
        Ok(()) => buffer.flush(),
        Err(error) => {
            let _ = buffer.into_parts();
            Err(error)
        }
    }
}

/// The text of a system error without its number.
fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    text.split_once(" (os error").map_or(text.as_str(), |(words, _)| words).to_owned()
}

impl std::fmt::Display for Target<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Out => f.write_str("cannot write to stdout"),
            Self::Err => f.write_str("cannot write to stderr"),
            Self::File(path) => write!(f, "--out: cannot write {}", Path::display(path)),
        }
    }
}
