//! Ctrl-C, and the signal by which batch systems end a job: the first one ends a run and keeps what is done, the second one
//! ends the program.

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by the first signal while a run listens.
static ASKED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// The flag that a signal sets from now on. Where the system refuses, a signal ends the program at once, as everywhere else.
pub(super) fn listen() -> Arc<AtomicBool> {
    let install = || {
        let asked = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            // In this order: a signal that finds the flag set ends the program as if nobody listened.
            let installed = flag::register_conditional_default(signal, Arc::clone(&asked))
                .and_then(|_| flag::register(signal, Arc::clone(&asked)));
            drop(installed);
        }
        asked
    };
    let asked = Arc::clone(ASKED.get_or_init(install));
    asked.store(false, Ordering::SeqCst);
    asked
}
