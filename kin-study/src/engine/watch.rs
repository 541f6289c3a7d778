//! The progress of a run, and its stop flag.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64};

/// The progress of a run, and the flag that stops it. Both may be read and set from any thread.
#[derive(Clone, Debug, Default)]
pub struct Watch {
    /// Number of rows that this run has to compute, 0 until it is known.
    pub total: Arc<AtomicU64>,
    /// Number of rows that this run has computed.
    pub done: Arc<AtomicU64>,
    /// If true, the run ends after the pieces that are being solved; rows that are done are kept.
    pub stop: Arc<AtomicBool>,
}
