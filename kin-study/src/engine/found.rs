//! The results of a range of rows: those that are kept, and a summary of all of them.

use super::write::Tally;
use crate::error::StudyError;
use crate::rows::{Counts, Kept, Prepared, context, selected};
use datafusion::arrow::array::AsArray;
use datafusion::arrow::datatypes::UInt64Type;
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::catalog::TableProvider;
use std::ops::Range;
use std::sync::Arc;

/// A summary of rows: how many there are of each kind, and the counts of histograms.
#[derive(Clone, Debug)]
pub(crate) struct Summary {
    pub(crate) tally: Tally,
    pub(crate) counts: Counts,
}

impl Summary {
    /// The summary of no rows.
    pub(crate) fn new(prepared: &Prepared) -> Self {
        Self { tally: Tally::default(), counts: Counts::new(&prepared.bins) }
    }

    /// Adds the summary of other rows.
    pub(crate) fn and(&mut self, other: &Self) {
        self.tally = self.tally.and(&other.tally);
        self.counts.and(&other.counts);
    }
}

/// The results of a range of rows.
#[derive(Debug)]
pub(crate) struct Found {
    /// The rows that were computed.
    pub(crate) rows: Range<u64>,
    /// The rows that are kept.
    pub(crate) batches: Vec<RecordBatch>,
    pub(crate) summary: Summary,
}

/// Solves one piece: the rows of it that may be kept, and the summary of all of its rows.
pub(crate) fn solve(prepared: &Prepared, rows: Range<u64>) -> Result<(RecordBatch, Summary), StudyError> {
    let piece = prepared.rows(rows)?;
    let mut summary = Summary::new(prepared);
    let passed = piece.batch.num_rows() as u64;
    summary.tally = Tally { tried: piece.tried, solved: piece.solved, ended: piece.ended, passed };
    summary.counts.add(&prepared.bins, &piece.batch);
    Ok((prepared.kept.of(piece.batch)?, summary))
}

/// The rows of a table that a study keeps, in its order.
pub(crate) async fn merged(
    prepared: &Prepared,
    table: Arc<dyn TableProvider>,
    partitions: usize,
) -> Result<Vec<RecordBatch>, StudyError> {
    let context = context(partitions);
    context.register_table("study", table)?;
    let batches = selected(&context, &prepared.kept.sql("study")).await?.collect().await?;
    Ok(if matches!(prepared.kept, Kept::All) { in_order(batches) } else { batches })
}

/// Batches in the order of their first rows.
fn in_order(mut batches: Vec<RecordBatch>) -> Vec<RecordBatch> {
    batches.sort_by_key(|batch| batch.column(0).as_primitive::<UInt64Type>().values().first().copied());
    batches
}

/// What computes the rows of a study: the threads of this process, or the workers of a cluster.
pub(crate) trait Workers {
    /// Computes rows in order from the first of `rows` on, for some seconds; none after a request to stop. Adds their
    /// number to [`Watch::done`](super::Watch::done).
    fn wave(&mut self, rows: Range<u64>) -> Result<Found, StudyError>;
}
