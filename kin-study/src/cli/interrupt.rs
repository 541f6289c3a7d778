//! Ctrl-C: the first one ends a run and keeps what is done, the second one ends the program.

use signal_hook::consts::SIGINT;
use signal_hook::flag;
use std::sync::Arc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by the first Ctrl-C while a run listens.
static ASKED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// The flag that a Ctrl-C sets from now on. Where the system refuses, Ctrl-C ends the program at once, as everywhere else.
pub(super) fn listen() -> Arc<AtomicBool> {
    let install = || {
        let asked = Arc::new(AtomicBool::new(false));
        // In this order: a Ctrl-C that finds the flag set ends the program as if nobody listened.
        let installed = flag::register_conditional_default(SIGINT, Arc::clone(&asked))
            .and_then(|_| flag::register(SIGINT, Arc::clone(&asked)));
        drop(installed);
        asked
    };
    let asked = Arc::clone(ASKED.get_or_init(install));
    asked.store(false, Ordering::SeqCst);
    asked
}
