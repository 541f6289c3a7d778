//! The streams of one run: results to stdout or a file, everything else to stderr.

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::rc::Rc;

use anstream::{AutoStream, ColorChoice};

use super::failure::Failure;
use super::interrupt::Interrupt;
use super::output::{Destination, OutputArgs, Target};
use super::paint;
use super::watch::Watch;
use crate::present::output::{write_atomically, write_atomically_by};

/// What there is around a run: who reads its streams.
#[derive(Clone, Debug)]
pub(super) struct Surroundings {
    /// Whether results may be coloured, and whether what is said beside them may.
    pub(super) colours: [bool; 2],
    /// Whether results appear on a screen.
    pub(super) screen: bool,
    /// Whether somebody sees a bar on stderr.
    pub(super) bar: bool,
    pub(super) interrupt: Interrupt,
}

impl Surroundings {
    /// Files.
    #[cfg(test)]
    pub(super) fn plain() -> Self {
        Self { colours: [false; 2], screen: false, bar: false, interrupt: Interrupt::unheard() }
    }

    /// Those of this process: colours on a terminal alone, as `NO_COLOR` and `CLICOLOR_FORCE` have it.
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
    watch: Rc<Watch>,
    /// Whether a reader of the result left before its end.
    reader_left: bool,
}

/// The exit status where a reader left before all was written: that of a program which SIGPIPE ends.
const READER_LEFT: u8 = 141;

impl<'a> Session<'a> {
    pub(super) fn new(out: &'a mut dyn Write, err: &'a mut dyn Write, around: Surroundings) -> Self {
        let watch = Rc::new(Watch::new(around.interrupt, around.bar));
        Self { out, err, colours: around.colours, screen: around.screen, watch, reader_left: false }
    }

    /// Who watches what takes long.
    pub(super) fn watch(&self) -> Rc<Watch> {
        Rc::clone(&self.watch)
    }

    /// What `command` is to write, and where to; pictures and pages are nothing for a screen full of text.
    pub(super) fn destination<'o>(&self, options: &'o OutputArgs, command: &str) -> Result<Destination<'o>, Failure> {
        let to = options.destination(command)?;
        if self.screen && to.target == Target::Out && !to.form.is_readable() {
            let (form, ending) = (to.form.name(), to.form.endings()[0]);
            let what = format!("{form} is nothing for a terminal; write --out FILE.{ending}, or pipe it on");
            return Err(Failure::option("--out", what));
        }
        Ok(to)
    }

    /// Writes a result where it was asked for.
    pub(super) fn deliver(&mut self, to: &Destination<'_>, text: &str) -> Result<(), Failure> {
        match self.colours[0] && to.is_for_people() {
            true => self.deliver_bytes(to, paint::result(text).as_bytes()),
            false => self.deliver_bytes(to, text.as_bytes()),
        }
    }

    /// Writes a result that may be no text.
    pub(super) fn deliver_bytes(&mut self, to: &Destination<'_>, bytes: &[u8]) -> Result<(), Failure> {
        self.write(to.target, bytes)?;
        to.contradiction().iter().for_each(|note| self.note(note));
        Ok(())
    }

    /// Whether a result appears on a screen, where a bar would be between its lines.
    pub(super) fn is_seen(&self, to: &Destination<'_>) -> bool {
        self.screen && to.target == Target::Out
    }

    /// Writes a result bit by bit. An error of `write` leaves a file as it was before.
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
        self.said(to.target, written)?;
        to.contradiction().iter().for_each(|note| self.note(note));
        Ok(())
    }

    fn write(&mut self, target: Target<'_>, bytes: &[u8]) -> Result<(), Failure> {
        let written = match target {
            Target::Out => self.out.write_all(bytes).and_then(|()| self.out.flush()),
            Target::Err => self.err.write_all(bytes).and_then(|()| self.err.flush()),
            Target::File(path) => self.watch.hold(|| write_atomically(path, bytes)),
        };
        self.said(target, written)
    }

    fn said(&mut self, target: Target<'_>, written: io::Result<()>) -> Result<(), Failure> {
        match written {
            // Whoever reads has seen enough (`… | head`): there is nobody to tell, but not all was written.
            Err(e) if e.kind() == io::ErrorKind::BrokenPipe => {
                self.reader_left = true;
                Ok(())
            }
            other => other.map_err(|e| Failure::Output(format!("{target}: {}", reason(&e)))),
        }
    }

    /// Says something beside the result. When stderr is closed nobody wants to know.
    pub(super) fn note(&mut self, text: &str) {
        let text = text.trim_end();
        let watch = self.watch();
        let _ = watch.aside(|| match self.colours[1] {
            true => writeln!(self.err, "{}", paint::remark(text)),
            false => writeln!(self.err, "{text}"),
        });
    }

    /// Prints help; the exit status.
    pub(super) fn help(&mut self, text: &clap::builder::StyledStr) -> u8 {
        let text = if self.colours[0] { text.ansi().to_string() } else { text.to_string() };
        let done = self.write(Target::Out, text.as_bytes());
        self.finish(done)
    }

    /// Prints an error of the arguments; the exit status.
    pub(super) fn refuse(&mut self, text: &clap::builder::StyledStr, more: &str) -> u8 {
        let text = if self.colours[1] { text.ansi().to_string() } else { text.to_string() };
        let _ = write!(self.err, "{}{more}", text.trim_end());
        2
    }

    /// The exit status of a command, its error said.
    pub(super) fn finish(&mut self, done: Result<(), Failure>) -> u8 {
        self.watch.end();
        match done {
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

/// Writes by way of a buffer, whose rest is thrown away where `write` fails.
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

/// An error of the system without its number.
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
