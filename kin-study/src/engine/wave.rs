//! A wave: as many pieces as are solved in a few seconds on all cores, merged by the engine.
//!
//! Every partition of a streaming table takes the next piece until the wave has enough or somebody asks to stop. Pieces are
//! taken in order and finished once they are taken, so the rows of a wave are a range without gaps, wherever it ends.

use super::write::Tally;
use crate::error::StudyError;
use crate::rows::{CHUNK, Counts, Prepared, context};
use datafusion::arrow::array::AsArray;
use datafusion::arrow::datatypes::{SchemaRef, UInt64Type};
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::catalog::streaming::StreamingTable;
use datafusion::error::DataFusionError;
use datafusion::execution::TaskContext;
use datafusion::physical_plan::SendableRecordBatchStream;
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::streaming::PartitionStream;
use futures::stream;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// After how long a wave takes no more pieces: so much is lost where the machine fails.
const TIME: Duration = Duration::from_secs(3);
/// Numbers that a wave holds in memory at most.
const NUMBERS: u64 = 1 << 23;

/// What the partitions of a wave share.
#[derive(Debug)]
pub(super) struct Wave {
    prepared: Arc<Prepared>,
    rows: Range<u64>,
    /// The first row of the next piece.
    next: AtomicU64,
    began: Instant,
    stop: Arc<AtomicBool>,
    progress: Arc<AtomicU64>,
    found: Mutex<(Tally, Counts)>,
}

/// What a wave has found.
#[derive(Debug)]
pub(super) struct Found {
    /// The rows that it went through.
    pub(super) rows: Range<u64>,
    /// Those that are kept.
    pub(super) batches: Vec<RecordBatch>,
    pub(super) tally: Tally,
    pub(super) counts: Counts,
}

impl Wave {
    /// A wave from the first of these rows on.
    pub(super) fn new(
        prepared: &Arc<Prepared>,
        rows: Range<u64>,
        stop: Arc<AtomicBool>,
        progress: Arc<AtomicU64>,
    ) -> Self {
        let columns = prepared.schema.fields().len() as u64;
        // The best rows of pieces take little; all rows of a wave must fit into memory.
        let most = if prepared.best.is_some() || !prepared.keeps_rows { u64::MAX } else { NUMBERS / columns };
        let pieces = (most / CHUNK as u64).max(1);
        let end = rows.start.saturating_add(pieces.saturating_mul(CHUNK as u64)).min(rows.end);
        let found = Mutex::new((Tally::default(), Counts::new(&prepared.bins)));
        Self {
            prepared: Arc::clone(prepared),
            next: AtomicU64::new(rows.start),
            rows: rows.start..end,
            began: Instant::now(),
            stop,
            progress,
            found,
        }
    }

    /// Takes the next piece; none when the wave is over.
    fn take(&self) -> Option<Range<u64>> {
        let first = self.next.load(Ordering::Relaxed) == self.rows.start;
        if self.stop.load(Ordering::Relaxed) || (!first && self.began.elapsed() > TIME) {
            return None;
        }
        let start = self.next.fetch_add(CHUNK as u64, Ordering::Relaxed);
        (start < self.rows.end).then(|| start..self.rows.end.min(start + CHUNK as u64))
    }

    fn piece(&self, rows: Range<u64>) -> Result<RecordBatch, StudyError> {
        let count = rows.end - rows.start;
        let piece = self.prepared.rows(rows)?;
        let passed = piece.batch.num_rows() as u64;
        {
            let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
            found.0 = found.0.and(&Tally { tried: piece.tried, solved: piece.solved, ended: piece.ended, passed });
            found.1.add(&self.prepared.bins, &piece.batch);
        }
        self.progress.fetch_add(count, Ordering::Relaxed);
        Ok(if self.prepared.keeps_rows { piece.batch } else { piece.batch.slice(0, 0) })
    }

    /// Runs it over so many partitions.
    pub(super) async fn run(self, partitions: usize) -> Result<Found, StudyError> {
        let wave = Arc::new(self);
        let prepared = &wave.prepared;
        let each = |_| Arc::new(Partition(Arc::clone(&wave))) as Arc<dyn PartitionStream>;
        let table = StreamingTable::try_new(Arc::clone(&prepared.schema), (0..partitions).map(each).collect())?;
        let context = context(partitions);
        context.register_table("study", Arc::new(table))?;
        let mut batches = context.sql(&kept(prepared, "study")).await?.collect().await?;
        if prepared.best.is_none() {
            let first = |batch: &RecordBatch| batch.column(0).as_primitive::<UInt64Type>().values().first().copied();
            batches.sort_by_key(first);
        }
        let reached = wave.next.load(Ordering::Relaxed).min(wave.rows.end);
        let found = wave.found.lock().unwrap_or_else(PoisonError::into_inner);
        let (tally, counts) = (found.0, found.1.clone());
        Ok(Found { rows: wave.rows.start..reached, batches, tally, counts })
    }
}

/// The rows that are kept of a table, as SQL.
pub(super) fn kept(prepared: &Prepared, table: &str) -> String {
    match &prepared.best {
        Some((count, by)) => format!("SELECT * FROM {table} ORDER BY {by}, \"row\" LIMIT {count}"),
        None => format!("SELECT * FROM {table}"),
    }
}

/// One partition: takes pieces until there are no more.
#[derive(Debug)]
struct Partition(Arc<Wave>);

impl PartitionStream for Partition {
    fn schema(&self) -> &SchemaRef {
        &self.0.prepared.schema
    }

    fn execute(&self, _: Arc<TaskContext>) -> SendableRecordBatchStream {
        let wave = Arc::clone(&self.0);
        let next = move || loop {
            match wave.piece(wave.take()?) {
                Ok(batch) if batch.num_rows() == 0 => {}
                other => return Some(other.map_err(|error| DataFusionError::External(Box::new(error)))),
            }
        };
        let schema = Arc::clone(self.schema());
        Box::pin(RecordBatchStreamAdapter::new(schema, stream::iter(std::iter::from_fn(next))))
    }
}
