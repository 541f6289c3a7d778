//! Who looks on while a study runs.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64};

/// Who looks on: how many rows are done, and whether to stop. Both may be read and set from any thread.
#[derive(Clone, Debug, Default)]
pub struct Watch {
    /// Rows that this run has to do, once that is known.
    pub total: Arc<AtomicU64>,
    /// Rows of this run that are done.
    pub done: Arc<AtomicU64>,
    /// Set to true, it ends the run after the pieces that are being solved; what is done is kept.
    pub stop: Arc<AtomicBool>,
}
