//! Ctrl-C: the first ends what is being done, with everything that is finished; the second ends the program.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::SIGINT;
use signal_hook::flag;

/// Whether Ctrl-C was pressed, and whether it ends the program at once.
#[derive(Clone, Debug)]
pub(super) struct Interrupt {
    asked: Arc<AtomicBool>,
    deadly: Arc<AtomicBool>,
    /// Whether the process lets us know.
    heard: bool,
}

impl Interrupt {
    /// Signals stay what they are.
    pub(super) fn unheard() -> Self {
        let flag = |value| Arc::new(AtomicBool::new(value));
        Self { asked: flag(false), deadly: flag(true), heard: false }
    }

    /// Ctrl-C of this process, as if it had not been pressed before.
    pub(super) fn of_process() -> Self {
        static FLAGS: OnceLock<Interrupt> = OnceLock::new();
        let interrupt = Self { heard: true, ..FLAGS.get_or_init(Self::unheard).clone() };
        interrupt.asked.store(false, Ordering::Relaxed);
        interrupt
    }

    /// From now on one Ctrl-C is only noted.
    pub(super) fn arm(&self) {
        static INSTALLED: OnceLock<bool> = OnceLock::new();
        if !self.heard || self.asked() {
            return;
        }
        self.deadly.store(false, Ordering::SeqCst);
        let install = || {
            // In this order: a Ctrl-C that finds the flag set by an earlier one ends the program as if nobody listened.
            flag::register_conditional_default(SIGINT, Arc::clone(&self.deadly))
                .and_then(|_| flag::register(SIGINT, Arc::clone(&self.asked)))
                .and_then(|_| flag::register(SIGINT, Arc::clone(&self.deadly)))
                .is_ok()
        };
        // Where the system refuses, Ctrl-C ends the program at once, as everywhere else.
        INSTALLED.get_or_init(install);
    }

    /// From now on a Ctrl-C ends the program at once.
    pub(super) fn disarm(&self) {
        self.deadly.store(true, Ordering::SeqCst);
    }

    /// Whether Ctrl-C was pressed while it was only noted.
    pub(super) fn asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
}
