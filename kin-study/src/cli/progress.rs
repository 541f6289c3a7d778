//! How far a run is, on stderr where that is a terminal.

use super::interrupt::listen;
use crate::engine::Watch;
use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

const TEMPLATE: &str = "  {bar:32} {percent:>3} %  {place} of {total} rows, {rate}, {left} left";
/// Between two looks at how far it is.
const TICK: Duration = Duration::from_millis(200);

/// Watches a run until it ends.
pub(super) struct Progress {
    watch: Watch,
    over: Sender<()>,
    thread: JoinHandle<()>,
}

impl Progress {
    /// Listens for Ctrl-C, and shows a bar as soon as it is known how many rows there are.
    pub(super) fn begin() -> Self {
        let watch = Watch { stop: listen(), ..Watch::default() };
        let (over, told) = channel();
        let seen = watch.clone();
        let thread = std::thread::spawn(move || {
            let bar = bar();
            while let Err(RecvTimeoutError::Timeout) = told.recv_timeout(TICK) {
                bar.set_length(seen.total.load(Ordering::Relaxed));
                bar.set_position(seen.done.load(Ordering::Relaxed));
            }
            bar.finish_and_clear();
        });
        Self { watch, over, thread }
    }

    /// Who looks on.
    pub(super) fn watch(&self) -> &Watch {
        &self.watch
    }

    /// The run is over; whether Ctrl-C was pressed.
    pub(super) fn end(self) -> bool {
        drop(self.over);
        // A bar that failed has shown less than it should; the run itself is not touched.
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
    // A template that indicatif cannot read would leave its own.
    let style = ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| ProgressStyle::default_bar());
    let style = style.progress_chars("━╸─").with_key("place", place).with_key("total", total);
    ProgressBar::new(0).with_style(style.with_key("rate", rate).with_key("left", left))
}
