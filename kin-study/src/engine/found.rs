//! What is found in some rows: those that are kept, and numbers about all of them.

use super::write::Tally;
use crate::error::StudyError;
use crate::rows::{Counts, Prepared};
use datafusion::arrow::array::AsArray;
use datafusion::arrow::datatypes::UInt64Type;
use datafusion::arrow::record_batch::RecordBatch;
use std::ops::Range;

/// Numbers about rows.
#[derive(Clone, Debug)]
pub(super) struct Summary {
    pub(super) tally: Tally,
    pub(super) counts: Counts,
}

impl Summary {
    /// Of no rows.
    pub(super) fn new(prepared: &Prepared) -> Self {
        Self { tally: Tally::default(), counts: Counts::new(&prepared.bins) }
    }

    /// Adds those of other rows.
    pub(super) fn and(&mut self, other: &Self) {
        self.tally = self.tally.and(&other.tally);
        self.counts.and(&other.counts);
    }
}

/// What is found in some rows.
#[derive(Debug)]
pub(super) struct Found {
    /// The rows that were gone through.
    pub(super) rows: Range<u64>,
    /// Those that are kept.
    pub(super) batches: Vec<RecordBatch>,
    pub(super) summary: Summary,
}

/// Solves one piece: what may be kept of it, and the numbers about all of its rows.
pub(super) fn solve(prepared: &Prepared, rows: Range<u64>) -> Result<(RecordBatch, Summary), StudyError> {
    let piece = prepared.rows(rows)?;
    let mut summary = Summary::new(prepared);
    let passed = piece.batch.num_rows() as u64;
    summary.tally = Tally { tried: piece.tried, solved: piece.solved, ended: piece.ended, passed };
    summary.counts.add(&prepared.bins, &piece.batch);
    Ok((prepared.kept.of(piece.batch)?, summary))
}

/// Batches in the order of their first rows.
pub(super) fn in_order(mut batches: Vec<RecordBatch>) -> Vec<RecordBatch> {
    batches.sort_by_key(|batch| batch.column(0).as_primitive::<UInt64Type>().values().first().copied());
    batches
}
