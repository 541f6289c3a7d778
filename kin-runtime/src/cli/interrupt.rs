//! Ctrl-C: the first ends the current computation, whose finished part is kept; the second ends the program.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::SIGINT;
use signal_hook::flag;

/// Whether Ctrl-C was pressed, and whether it ends the program at once.
#[derive(Clone, Debug)]
pub(super) struct Interrupt {
    pressed: Arc<AtomicBool>,
    deadly: Arc<AtomicBool>,
    /// Whether signal handlers may be installed.
    has_handlers: bool,
}

impl Interrupt {
    /// Without signal handlers: Ctrl-C keeps its default effect.
    pub(super) fn without_handlers() -> Self {
        let flag = |value| Arc::new(AtomicBool::new(value));
        Self { pressed: flag(false), deadly: flag(true), has_handlers: false }
    }

    /// Ctrl-C of this process; earlier ones are forgotten.
    pub(super) fn of_process() -> Self {
        static FLAGS: OnceLock<Interrupt> = OnceLock::new();
        let interrupt = Self { has_handlers: true, ..FLAGS.get_or_init(Self::without_handlers).clone() };
        interrupt.pressed.store(false, Ordering::Relaxed);
        interrupt
    }

    /// From now on the first Ctrl-C only sets a flag.
    pub(super) fn arm(&self) {
        static INSTALLED: OnceLock<bool> = OnceLock::new();
        if !self.has_handlers || self.pressed() {
            return;
        }
        self.deadly.store(false, Ordering::SeqCst);
        let install = || {
            // In this order: the first handler ends the program if an earlier Ctrl-C has set `deadly`.
            flag::register_conditional_default(SIGINT, Arc::clone(&self.deadly))
                .and_then(|_| flag::register(SIGINT, Arc::clone(&self.pressed)))
                .and_then(|_| flag::register(SIGINT, Arc::clone(&self.deadly)))
                .is_ok()
        };
        // If the system refuses a handler, Ctrl-C ends the program at once, as it does by default.
        INSTALLED.get_or_init(install);
    }

    /// From now on a Ctrl-C ends the program at once.
    pub(super) fn disarm(&self) {
        self.deadly.store(true, Ordering::SeqCst);
    }

    /// Whether Ctrl-C was pressed while it only set a flag.
    pub(super) fn pressed(&self) -> bool {
        self.pressed.load(Ordering::Relaxed)
    }
}
