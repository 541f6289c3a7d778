//! The progress of a run, on stderr if that is a terminal.

use super::interrupt::listen;
use crate::engine::Watch;
use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

const TEMPLATE: &str = "  {bar:32} {percent:>3} %  {place} of {total} rows, {rate}, {left} left";
/// Time between two updates of the bar.
const TICK: Duration = Duration::from_millis(200);

/// The progress bar of a run, which a thread updates until the run ends.
pub(super) struct Progress {
    watch: Watch,
    finished: Sender<()>,
    thread: JoinHandle<()>,
}

impl Progress {
    /// Starts to handle Ctrl-C, and shows a bar as soon as the number of rows is known.
    pub(super) fn begin() -> Self {
        let watch = Watch { stop: listen(), ..Watch::default() };
        let (finished, watched) = channel();
        let seen = watch.clone();
        let thread = std::thread::spawn(move || {
            let bar = bar();
            while let Err(RecvTimeoutError::Timeout) = watched.recv_timeout(TICK) {
                bar.set_length(seen.total.load(Ordering::Relaxed));
                bar.set_position(seen.done.load(Ordering::Relaxed));
            }
            bar.finish_and_clear();
        });
        Self { watch, finished, thread }
    }

    /// The numbers that the run updates, and its stop flag.
    pub(super) fn watch(&self) -> &Watch {
        &self.watch
    }

    /// Removes the bar after the run; returns whether Ctrl-C was pressed.
    pub(super) fn end(self) -> bool {
        drop(self.finished);
        // A panic of the bar's thread does not affect the run.
        let _ = self.thread.join();
        self.watch.stop.load(Ordering::SeqCst)
    }
}

fn bar() -> ProgressBar {
    let place = |state: &ProgressState, write: &mut dyn Write| {
        let _ = write!(write, "{}", HumanCount(state.pos()));
    };
    let total = |state: &ProgressState, write: &mut dyn Write| {
        let _ = write!(write, "{}", HumanCount(state.len().unwrap_or(0)));
    };
    let rate = |state: &ProgressState, write: &mut dyn Write| {
        let _ = write!(write, "{}/s", HumanCount(state.per_sec() as u64));
    };
    let left = |state: &ProgressState, write: &mut dyn Write| {
        let _ = write!(write, "{:#}", HumanDuration(state.eta()));
    };
    // The template is constant; if indicatif could not read it, its default style would be used.
    let style = ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| ProgressStyle::default_bar());
    let style = style.progress_chars("━╸─").with_key("place", place).with_key("total", total);
    ProgressBar::new(0).with_style(style.with_key("rate", rate).with_key("left", left))
}
