//! A study from its first row to its last: waves, a part for each, and what is left after a stop.

use super::parts::{COUNTS, Parts, ROWS, gaps};
use super::wave::{Wave, kept};
use super::write::{Tally, tally, write};
use crate::error::StudyError;
use crate::rows::{Prepared, context, counts_schema};
use crate::study::Study;
use datafusion::datasource::MemTable;
use kin_runtime::Mechanism;
use std::fmt;
use std::num::NonZero;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// How a study runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// Threads; as many as there are processors where nobody says.
    pub threads: Option<NonZero<usize>>,
    /// Goes on with what a directory holds already.
    pub resume: bool,
}

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

/// What became of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The rows that this run was to cover.
    pub rows: Range<u64>,
    /// How many of them are done, those of earlier runs included.
    pub done: u64,
    /// How many of these met the conditions before solving.
    pub solved: u64,
    /// How many of these could not go through all instants.
    pub ended: u64,
    /// How many met all conditions.
    pub passed: u64,
    /// How many rows this run has done itself.
    pub own: u64,
    /// How long it took.
    pub time: Duration,
}

impl Report {
    /// False after a stop.
    pub fn is_complete(&self) -> bool {
        self.done == self.rows.end - self.rows.start
    }
}

/// `1000 rows: 800 solved, 12 of them not to the end, 788 kept`.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { done, solved, ended, passed, own, time, .. } = self;
        write!(f, "{done} rows: {solved} solved, {ended} of them not to the end, {passed} met all conditions")?;
        let seconds = time.as_secs_f64();
        write!(f, "; {own} in {seconds:.1} s, {:.0} rows/s", *own as f64 / seconds.max(1e-9))?;
        match self.is_complete() {
            true => Ok(()),
            false => write!(f, "; stopped, {} rows are missing", self.rows.end - self.rows.start - done),
        }
    }
}

/// Runs a whole study; its parts go to the directory.
///
/// # Errors
/// Where the study makes no sense for the mechanism, where the directory holds something else, and where a file cannot be
/// written; parts that were finished before stay.
pub fn run<M>(study: &Study, directory: &Path, limits: Limits, watch: &Watch) -> Result<Report, StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    run_part::<M>(study, directory, (0, NonZero::<u64>::MIN), limits, watch)
}

/// Runs the part `index` of `of` parts of about the same size, `index` from 0: for an array of jobs that share a directory.
///
/// # Errors
/// As [`run`], and where `index` is not below `of`.
pub fn run_part<M>(
    study: &Study,
    directory: &Path,
    (index, of): (u64, NonZero<u64>),
    limits: Limits,
    watch: &Watch,
) -> Result<Report, StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    let prepared = Prepared::new::<M>(study)?;
    if index >= of.get() {
        let message = format!("there is no part {index} of {of}: parts are counted from 0 to {}", of.get() - 1);
        return Err(StudyError::description(message));
    }
    let bound = |k: u64| (u128::from(prepared.rows) * u128::from(k) / u128::from(of.get())) as u64;
    let rows = bound(index)..bound(index + 1);
    let whole = of.get() == 1;
    cover(Arc::new(prepared), directory, rows, whole, limits, watch)
}

/// Covers some rows with parts; not generic over the mechanism.
fn cover(
    prepared: Arc<Prepared>,
    directory: &Path,
    rows: Range<u64>,
    whole: bool,
    limits: Limits,
    watch: &Watch,
) -> Result<Report, StudyError> {
    let began = Instant::now();
    let processors = std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let threads = limits.threads.unwrap_or(processors).get();
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(threads).build();
    let runtime = runtime.map_err(|error| StudyError::file(directory, error))?;
    runtime.block_on(order_is_known(&prepared))?;
    // Jobs of an array share the directory, each with rows of its own.
    let parts = Parts::open(directory, &prepared, limits.resume || !whole)?;
    let covered = parts.covered()?;
    let gaps = gaps(rows.clone(), &covered);
    watch.total.store(gaps.iter().map(|gap| gap.end - gap.start).sum(), Ordering::Relaxed);
    let mut own = 0;
    'gaps: for gap in gaps {
        if !limits.resume && gap != rows {
            return Err(StudyError::Directory(format!(
                "{} holds some of these rows already; go on with --resume, or choose another directory",
                directory.display()
            )));
        }
        let mut next = gap.start;
        while next < gap.end {
            let wave = Wave::new(&prepared, next..gap.end, Arc::clone(&watch.stop), Arc::clone(&watch.done));
            let found = runtime.block_on(wave.run(threads))?;
            if found.rows.is_empty() {
                break 'gaps;
            }
            next = found.rows.end;
            own += found.rows.end - found.rows.start;
            if !prepared.bins.is_empty() {
                let table = found.counts.table(&prepared.bins);
                let table = table.map_err(|error| StudyError::Engine(Box::new(error.into())))?;
                write(&parts.path(COUNTS, &found.rows), &counts_schema(), &[table], None)?;
            }
            // The part with the rows comes last: it says that all of the wave is there.
            write(&parts.path(ROWS, &found.rows), &prepared.schema, &found.batches, Some(&found.tally))?;
        }
    }
    let mut sum = Tally::default();
    for (covered, path) in parts.files(ROWS)? {
        if covered.start >= rows.start && covered.end <= rows.end {
            sum = sum.and(&tally(&path)?);
        }
    }
    let Tally { tried, solved, ended, passed } = sum;
    Ok(Report { rows, done: tried, solved, ended, passed, own, time: began.elapsed() })
}

/// Whether the engine understands the order of the best rows.
async fn order_is_known(prepared: &Prepared) -> Result<(), StudyError> {
    let context = context(1);
    let empty = MemTable::try_new(Arc::clone(&prepared.schema), vec![vec![]])?;
    context.register_table("study", Arc::new(empty))?;
    let planned = context.sql(&kept(prepared, "study")).await;
    planned.map(|_| ()).map_err(|error| {
        let by = prepared.best.as_ref().map_or("", |(_, by)| by.as_str());
        StudyError::description(format!("`{by}`: {}", error.strip_backtrace())).on_line(prepared.order_line)
    })
}
