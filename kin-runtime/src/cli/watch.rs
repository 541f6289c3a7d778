//! The progress bar of a long computation, and its interruption by Ctrl-C.

use std::cell::{Cell, RefCell};
use std::fmt::Write;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use super::interrupt::Interrupt;
use crate::observer::Reached;

/// A computation that takes no longer has no progress bar.
const TIME_WITHOUT_BAR: Duration = Duration::from_secs(1);
const TEMPLATE: &str = "  {bar:32} {percent:>3} %  {place} of {total} {msg}, {rate}, {left} left";

/// The progress of the long part of a command.
pub(super) struct ProgressWatch {
    interrupt: Interrupt,
    /// Whether stderr is a terminal.
    seen: bool,
    bar: RefCell<Option<ProgressBar>>,
    began: Cell<Instant>,
    drawn: Cell<bool>,
    /// Steps that were finished before the current analysis began.
    before: Cell<usize>,
}

impl ProgressWatch {
    pub(super) fn new(interrupt: Interrupt, seen: bool) -> Self {
        let (bar, began) = (RefCell::new(None), Cell::new(Instant::now()));
        Self { interrupt, seen, bar, began, drawn: Cell::new(false), before: Cell::new(0) }
    }

    /// Begins a computation of `total` steps, which are called `unit`.
    pub(super) fn begin(&self, unit: &'static str, total: usize) {
        self.interrupt.arm();
        self.began.set(Instant::now());
        self.drawn.set(false);
        self.before.set(0);
        self.bar.replace(self.seen.then(|| bar(unit, total)));
    }

    /// As [`begin`](Self::begin), without a bar.
    pub(super) fn begin_unseen(&self) {
        self.interrupt.arm();
        self.before.set(0);
        self.bar.replace(None);
    }

    /// Begins motion number `place` of `count`, with this many instants each.
    pub(super) fn begin_motion(&self, (place, count): (usize, usize), instants: usize) {
        match place {
            0 => self.begin("instants", count * instants),
            _ => self.go_on(place * instants),
        }
    }

    /// Begins the next of several analyses, after `before` finished steps.
    pub(super) fn go_on(&self, before: usize) {
        self.before.set(before);
    }

    /// Shows the progress of an analysis; ends the analysis after Ctrl-C.
    pub(super) fn observe(&self, reached: Reached<'_>) -> ControlFlow<()> {
        self.step(reached.done)
    }

    /// As [`observe`](Self::observe), for other computations.
    pub(super) fn step(&self, done: usize) -> ControlFlow<()> {
        if let Some(bar) = &*self.bar.borrow() {
            if !self.drawn.get() && self.began.get().elapsed() >= TIME_WITHOUT_BAR {
                self.drawn.set(true);
                bar.set_draw_target(ProgressDrawTarget::stderr());
            }
            bar.set_position((self.before.get() + done) as u64);
        }
        if self.interrupted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// [`step`](Self::step) from any thread.
    #[cfg(feature = "design")]
    pub(super) fn shared(&self) -> impl Fn(usize) -> ControlFlow<()> + Sync + use<> {
        let (bar, interrupt, began) = (self.bar.borrow().clone(), self.interrupt.clone(), self.began.get());
        let drawn = std::sync::atomic::AtomicBool::new(false);
        move |done| {
            if let Some(bar) = &bar {
                if began.elapsed() >= TIME_WITHOUT_BAR && !drawn.swap(true, std::sync::atomic::Ordering::Relaxed) {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                }
                bar.set_position(done as u64);
            }
            if interrupt.pressed() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }

    /// Ends the long part: the bar disappears, and Ctrl-C ends the program again.
    pub(super) fn end(&self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
        self.interrupt.disarm();
    }

    /// Does some short work that the first Ctrl-C does not interrupt.
    pub(super) fn hold<R>(&self, work: impl FnOnce() -> R) -> R {
        self.interrupt.arm();
        let result = work();
        self.interrupt.disarm();
        result
    }

    /// Whether Ctrl-C was pressed.
    pub(super) fn interrupted(&self) -> bool {
        self.interrupt.pressed()
    }

    /// Runs `work`, which writes to the terminal, while the bar is hidden.
    pub(super) fn aside<R>(&self, work: impl FnOnce() -> R) -> R {
        match &*self.bar.borrow() {
            Some(bar) if self.drawn.get() => bar.suspend(work),
            _ => work(),
        }
    }
}

fn bar(unit: &'static str, total: usize) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::hidden());
    let number = |write: &mut dyn Write, number: u64| {
        let _ = write!(write, "{}", grouped(number));
    };
    let place = move |state: &ProgressState, write: &mut dyn Write| number(write, state.pos());
    let total = move |state: &ProgressState, write: &mut dyn Write| number(write, state.len().unwrap_or(0));
    let rate = |state: &ProgressState, write: &mut dyn Write| {
        let _ = write!(write, "{}", per_time(state.per_sec()));
    };
    let left = |state: &ProgressState, write: &mut dyn Write| {
        let _ = write!(write, "{}", duration(state.eta()));
    };
    // The template is constant; if indicatif could not read it, its default style would be used.
    let style = ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| ProgressStyle::default_bar());
    let style = style.progress_chars("━╸─").with_key("place", place).with_key("total", total);
    bar.set_style(style.with_key("rate", rate).with_key("left", left));
    bar.with_message(unit)
}

/// 1234567 as 1 234 567.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            out.push(' ');
        }
        out.push(digit);
    }
    out
}

fn per_time(rate: f64) -> String {
    match rate {
        rate if rate >= 10.0 => format!("{}/s", grouped(rate.round() as u64)),
        rate if rate >= 0.1 => format!("{rate:.1}/s"),
        rate => format!("{:.1}/min", 60.0 * rate),
    }
}

/// In seconds, minutes and hours.
fn duration(time: Duration) -> String {
    match time.as_secs() {
        seconds @ ..60 => format!("{seconds} s"),
        seconds @ ..3600 => format!("{} min {:02} s", seconds / 60, seconds % 60),
        seconds => format!("{} h {:02} min", seconds / 3600, seconds / 60 % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_for_people() {
        assert_eq!([7, 123, 1234, 1_234_567].map(grouped), ["7", "123", "1 234", "1 234 567"]);
        assert_eq!([12_345.6, 10.0, 1.25, 0.01].map(per_time), ["12 346/s", "10/s", "1.2/s", "0.6/min"]);
        assert_eq!([59, 61, 3_661].map(|s| duration(Duration::from_secs(s))), ["59 s", "1 min 01 s", "1 h 01 min"]);
    }
}
