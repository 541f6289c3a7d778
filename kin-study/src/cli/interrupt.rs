//! Ctrl-C, and SIGTERM, by which batch systems end a job: the first signal ends a run and keeps the rows that are done,
//! the second ends the program.

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// The flag that the first signal sets during a run.
static STOP_REQUESTED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// The flag that a signal sets from now on. If the system refuses a handler, a signal ends the program at once, as it
/// does by default.
pub(super) fn listen() -> Arc<AtomicBool> {
    let install = || {
        let stop_requested = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            // In this order: if the flag is set already, the first handler ends the program, as a signal does by
            // default.
            let installed = flag::register_conditional_default(signal, Arc::clone(&stop_requested))
                .and_then(|_| flag::register(signal, Arc::clone(&stop_requested)));
            drop(installed);
        }
        stop_requested
    };
    let stop_requested = Arc::clone(STOP_REQUESTED.get_or_init(install));
    stop_requested.store(false, Ordering::SeqCst);
    stop_requested
}
