//! A wave: as many pieces (of 4096 rows, or fewer if a row is long) as are solved in a few seconds on all cores, merged by
//! the engine.
//!
//! Every partition of a streaming table takes the next piece until the wave is full or a stop is requested. Pieces are
//! taken in order, and every piece that is taken is finished, so that the rows of a wave are a range without gaps.

use super::found::{Found, Summary, Workers, merged, solve};
use super::watch::Watch;
use crate::error::StudyError;
use crate::rows::{Kept, Prepared};
use datafusion::arrow::datatypes::SchemaRef;
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::catalog::streaming::StreamingTable;
use datafusion::error::DataFusionError;
use datafusion::execution::TaskContext;
use datafusion::physical_plan::SendableRecordBatchStream;
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::streaming::PartitionStream;
use futures::stream;
use std::io;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time after which a wave takes no more pieces. If the machine fails, the work of about this time is lost.
pub(crate) const TIME: Duration = Duration::from_secs(3);
/// Largest number of numbers that a wave holds in memory.
const NUMBERS: u64 = 1 << 23;

/// Largest number of rows of a wave. If all rows are kept, they must fit into memory; the best ones of every piece take
/// little of it.
pub(crate) fn most(prepared: &Prepared) -> u64 {
    if matches!(prepared.kept, Kept::All) { NUMBERS / prepared.numbers() } else { u64::MAX }
}

/// The threads of this process.
#[derive(Debug)]
pub(super) struct Threads {
    prepared: Arc<Prepared>,
    count: usize,
    runtime: tokio::runtime::Runtime,
    watch: Watch,
}

impl Threads {
    /// Starts `count` threads.
    pub(super) fn new(prepared: &Arc<Prepared>, count: usize, watch: &Watch) -> io::Result<Self> {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(count).build()?;
        Ok(Self { prepared: Arc::clone(prepared), count, runtime, watch: watch.clone() })
    }
}

impl Workers for Threads {
    fn wave(&mut self, rows: Range<u64>) -> Result<Found, StudyError> {
        let Watch { stop, done, .. } = &self.watch;
        let wave = Wave::new(&self.prepared, rows, Arc::clone(stop), Arc::clone(done));
        self.runtime.block_on(wave.run(self.count))
    }
}

/// What the partitions of a wave share.
#[derive(Debug)]
struct Wave {
    prepared: Arc<Prepared>,
    rows: Range<u64>,
    /// Number of rows of a piece.
    piece: u64,
    /// The first row of the next piece.
    next: AtomicU64,
    began: Instant,
    stop: Arc<AtomicBool>,
    progress: Arc<AtomicU64>,
    summary: Mutex<Summary>,
}

impl Wave {
    /// A wave from the first of these rows on.
    fn new(prepared: &Arc<Prepared>, rows: Range<u64>, stop: Arc<AtomicBool>, progress: Arc<AtomicU64>) -> Self {
        // All numbers of a piece are held in memory, even if only the best rows are kept.
        let piece = prepared.rows_of_piece(NUMBERS);
        let pieces = (most(prepared) / piece).max(1);
        let end = rows.start.saturating_add(pieces.saturating_mul(piece)).min(rows.end);
        let summary = Mutex::new(Summary::new(prepared));
        Self {
            prepared: Arc::clone(prepared),
            next: AtomicU64::new(rows.start),
            rows: rows.start..end,
            piece,
            began: Instant::now(),
            stop,
            progress,
            summary,
        }
    }

    /// Takes the next piece; `None` if the wave takes no more.
    fn take(&self) -> Option<Range<u64>> {
        let first = self.next.load(Ordering::Relaxed) == self.rows.start;
        if self.stop.load(Ordering::Relaxed) || (!first && self.began.elapsed() > TIME) {
            return None;
        }
        let start = self.next.fetch_add(self.piece, Ordering::Relaxed);
        (start < self.rows.end).then(|| start..self.rows.end.min(start + self.piece))
    }

    fn piece(&self, rows: Range<u64>) -> Result<RecordBatch, StudyError> {
        let count = rows.end - rows.start;
        let (batch, summary) = solve(&self.prepared, rows)?;
        self.summary.lock().unwrap_or_else(PoisonError::into_inner).and(&summary);
        self.progress.fetch_add(count, Ordering::Relaxed);
        Ok(batch)
    }

    /// Solves the pieces of the wave in `partitions` partitions.
    async fn run(self, partitions: usize) -> Result<Found, StudyError> {
        let wave = Arc::new(self);
        let prepared = &wave.prepared;
        let each = |_| Arc::new(Partition(Arc::clone(&wave))) as Arc<dyn PartitionStream>;
        let table = StreamingTable::try_new(Arc::clone(&prepared.schema), (0..partitions).map(each).collect())?;
        let batches = merged(prepared, Arc::new(table), partitions).await?;
        let reached = wave.next.load(Ordering::Relaxed).min(wave.rows.end);
        let summary = wave.summary.lock().unwrap_or_else(PoisonError::into_inner).clone();
        Ok(Found { rows: wave.rows.start..reached, batches, summary })
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
