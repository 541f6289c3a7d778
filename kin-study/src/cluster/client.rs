//! A run whose rows are solved by workers.

use super::function::Function;
use super::parcel::unpacked;
use super::presence::ready;
use super::roles::{HEARTBEAT, embedded};
use super::submission::{foreign, is_foreign, submitted};
use crate::engine::{Found, Part, Report, Summary, TIME, Watch, Workers, cover, merged, most};
use crate::error::StudyError;
use crate::rows::{Prepared, context};
use crate::study::Study;
use datafusion::arrow::array::{AsArray, UInt64Array};
use datafusion::arrow::datatypes::{DataType, Field, Schema, UInt64Type};
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::datasource::MemTable;
use datafusion::error::DataFusionError;
use datafusion::logical_expr::{ScalarUDF, col, lit};
use datafusion::physical_plan::ExecutionPlan;
use kin_runtime::Mechanism;
use std::collections::BTreeMap;
use std::num::NonZero;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant, SystemTime};

/// Rows of every task in the first wave, which measures how fast the cluster is.
const FIRST: u64 = 256;
/// How often a wave is tried while there are workers.
const MAX_TRIES: usize = 5;
/// How long a client waits for a wave: for the first wave `FIRST_WAIT`, for later ones `EXTRA_WAIT` more than four
/// times the expected duration. Every further try may take twice as long as the one before.
const EXTRA_WAIT: Duration = Duration::from_secs(20);
const FIRST_WAIT: Duration = Duration::from_secs(120);
/// How long a client still waits for a wave after a request to stop.
const GRACE: Duration = Duration::from_secs(5);
/// Largest number of tasks in a wave: each takes the scheduler some milliseconds.
const TASKS: u64 = 2000;
/// Largest number of numbers in the result of a piece, so that it fits into a message.
const NUMBERS: u64 = 1 << 20;

/// Where rows are solved.
#[derive(Clone, Debug)]
pub struct Cluster {
    place: Place,
    tasks: u64,
}

#[derive(Clone, Debug)]
enum Place {
    /// On the workers of the scheduler at this address.
    Scheduler(String),
    /// On a worker in this process, with a scheduler of its own and this number of threads.
    Here(NonZero<usize>),
}

impl Cluster {
    /// The workers of the scheduler at `host:port`.
    pub fn at(scheduler: impl Into<String>) -> Self {
        Self { place: Place::Scheduler(scheduler.into()), tasks: 64 }
    }

    /// A cluster within this process, with one worker of `threads` threads, to try how a study runs on a cluster.
    pub fn standalone(threads: NonZero<usize>) -> Self {
        Self { place: Place::Here(threads), tasks: 64 }
    }

    /// The number of tasks into which every wave is cut: 64 by default, at most 2000. With fewer tasks than cores, some
    /// cores are idle; every task takes the scheduler some milliseconds.
    #[must_use]
    pub fn tasks(self, tasks: NonZero<usize>) -> Self {
        Self { tasks: (tasks.get() as u64).min(TASKS), ..self }
    }
}

/// Runs a whole study on a cluster and writes its parts to the directory; only this process writes there.
///
/// If a worker is lost, the others compute its rows of the current wave again.
///
/// # Errors
/// As [`run`](crate::run); [`StudyError::Cluster`] if the scheduler or all workers are lost, or if one of them is
/// another program. Parts that are finished by then stay.
pub fn run_on<M>(
    cluster: &Cluster,
    study: &Study,
    directory: &Path,
    resume: bool,
    watch: &Watch,
) -> Result<Report, StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    let prepared = Arc::new(Prepared::new::<M>(study)?);
    let text = study.to_toml();
    // Workers get the study as this text only.
    let again = Prepared::new::<M>(&Study::from_toml(&text)?)?;
    if again.identity != prepared.identity {
        return Err(StudyError::description(
            "the study changes when it is written to a file and read again, so that workers cannot get it",
        ));
    }
    let part = Part { rows: 0..prepared.rows, is_whole: true, resume };
    ran(cluster, (prepared, text, Function::of::<M>()?), directory, part, watch)
}

/// Not generic, so that it is compiled once.
fn ran(
    cluster: &Cluster,
    (prepared, text, function): (Arc<Prepared>, String, ScalarUDF),
    directory: &Path,
    part: Part,
    watch: &Watch,
) -> Result<Report, StudyError> {
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build();
    let runtime = runtime.map_err(|error| StudyError::Cluster(error.to_string()))?;
    let scheduler = match &cluster.place {
        Place::Scheduler(scheduler) => {
            ready(scheduler, watch)?;
            scheduler.clone()
        }
        Place::Here(threads) => runtime.block_on(embedded(&function, *threads))?,
    };
    let shared = Arc::clone(&prepared);
    let tasks = match &cluster.place {
        Place::Scheduler(_) => cluster.tasks,
        // A worker in the same process takes a task every tenth of a second.
        Place::Here(threads) => cluster.tasks.min(threads.get() as u64),
    };
    let is_far = matches!(cluster.place, Place::Scheduler(_));
    let (watching, next) = (watch.clone(), tasks * FIRST);
    // Two machines may give two runs the same process number.
    let since = SystemTime::UNIX_EPOCH.elapsed().unwrap_or_default();
    let session = format!("kin-study-{}-{}", std::process::id(), since.as_nanos());
    #[rustfmt::skip]
    let mut remote = Remote {
        prepared: shared, function, text, scheduler, session, is_far, tasks, runtime, watch: watching, next, rate: None,
    };
    cover(&prepared, directory, part, &mut remote, watch)
}

/// The workers of a cluster.
struct Remote {
    prepared: Arc<Prepared>,
    function: ScalarUDF,
    /// The study as TOML text.
    text: String,
    scheduler: String,
    /// The name of this run at the scheduler.
    session: String,
    /// Whether the scheduler is another process.
    is_far: bool,
    tasks: u64,
    runtime: tokio::runtime::Runtime,
    watch: Watch,
    /// How many rows the next wave takes.
    next: u64,
    /// Rows per second of the last wave.
    rate: Option<f64>,
}

impl Workers for Remote {
    fn wave(&mut self, rows: Range<u64>) -> Result<Found, StudyError> {
        let most = most(&self.prepared).min(rows.end - rows.start).max(1);
        let count = if self.watch.stop.load(Ordering::Relaxed) { 0 } else { self.next.min(most) };
        let rows = rows.start..rows.start + count;
        let mut summary = Summary::new(&self.prepared);
        if count == 0 {
            return Ok(Found { rows, batches: Vec::new(), summary });
        }
        let began = Instant::now();
        let Some(answers) = self.answers(&rows)? else {
            return Ok(Found { rows: rows.start..rows.start, batches: Vec::new(), summary });
        };
        // A worker that counted as lost may answer after all. Results that arrive twice are equal, and are counted
        // once.
        let mut parcels = BTreeMap::new();
        for answer in &answers {
            let starts = answer.column(0).as_primitive::<UInt64Type>().values();
            parcels.extend(starts.iter().zip(answer.column(1).as_binary::<i32>().iter().flatten()));
        }
        let mut batches = Vec::new();
        for parcel in parcels.into_values() {
            let (rows_of_parcel, found) = unpacked(parcel, &self.prepared).map_err(DataFusionError::from)?;
            batches.extend(rows_of_parcel);
            summary.and(&found);
        }
        if summary.tally.tried != count {
            let tried = summary.tally.tried;
            let message = format!("{}: {tried} of {count} rows came back", self.scheduler);
            return Err(resumable(StudyError::Cluster(message)));
        }
        let table = MemTable::try_new(Arc::clone(&self.prepared.schema), vec![batches])?;
        let batches = self.runtime.block_on(merged(&self.prepared, Arc::new(table), 1))?;
        self.watch.done.fetch_add(count, Ordering::Relaxed);
        let rate = count as f64 / began.elapsed().as_secs_f64().max(1e-3);
        self.rate = Some(rate);
        let next = (rate * TIME.as_secs_f64()) as u64;
        self.next = next.min(count.saturating_mul(8)).max(self.tasks * FIRST);
        Ok(Found { rows, batches, summary })
    }
}

impl Remote {
    /// The results of the workers for some rows; `None` if a stop is requested and they take longer than `GRACE` after
    /// that. The results of a lost worker are lost with it and are computed again by the remaining ones.
    fn answers(&self, rows: &Range<u64>) -> Result<Option<Vec<RecordBatch>>, StudyError> {
        let count = (rows.end - rows.start) as f64;
        let mut patience =
            self.rate.map_or(FIRST_WAIT, |rate| EXTRA_WAIT + Duration::from_secs_f64(4.0 * count / rate));
        for tried in 1.. {
            let answer = self.runtime.block_on(async {
                let plan = self.plan(rows).await?;
                let answers = submitted(&self.scheduler, &self.session, plan);
                tokio::select! {
                    answers = answers => answers.map(Some),
                    () = self.abandoned() => Ok(None),
                    () = tokio::time::sleep(patience) => {
                        let message = format!("no answer in {} s", patience.as_secs());
                        Err(DataFusionError::Execution(message))
                    }
                }
            });
            let error = match answer {
                Ok(answers) => return Ok(answers),
                Err(error) if is_foreign(&error, self.function.name()) => return Err(foreign(&self.scheduler)),
                Err(error) => error,
            };
            if self.is_far {
                ready(&self.scheduler, &self.watch).map_err(resumable)?;
            }
            if tried == MAX_TRIES || !self.is_far {
                let (scheduler, error) = (&self.scheduler, error.strip_backtrace());
                return Err(resumable(StudyError::Cluster(format!("{scheduler}: {error}"))));
            }
            patience *= 2;
            std::thread::sleep(Duration::from_secs(HEARTBEAT));
        }
        Ok(None)
    }

    /// Waits for a request to stop, and `GRACE` longer.
    async fn abandoned(&self) {
        while !self.watch.stop.load(Ordering::Relaxed) {
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
        tokio::time::sleep(GRACE).await;
    }

    /// The plan of a wave: a table whose partitions are the tasks, each with a row (start, end) for every piece, and
    /// the function applied to these rows.
    async fn plan(&self, rows: &Range<u64>) -> Result<Arc<dyn ExecutionPlan>, DataFusionError> {
        let number = |name| Field::new(name, DataType::UInt64, false);
        let schema = Arc::new(Schema::new(vec![number("start"), number("end")]));
        let largest = self.prepared.rows_of_piece(NUMBERS);
        let task = |pieces: Vec<Range<u64>>| {
            let numbers = |end_of: fn(&Range<u64>) -> u64| UInt64Array::from_iter_values(pieces.iter().map(end_of));
            let [starts, ends] = [numbers(|piece| piece.start), numbers(|piece| piece.end)];
            Ok(vec![RecordBatch::try_new(Arc::clone(&schema), vec![Arc::new(starts), Arc::new(ends)])?])
        };
        let tasks = cut(rows, self.tasks, largest).into_iter().map(task);
        let tasks = tasks.collect::<Result<Vec<_>, DataFusionError>>()?;
        let table = MemTable::try_new(Arc::clone(&schema), tasks)?;
        let found = self.function.call(vec![lit(self.text.as_str()), col("start"), col("end")]).alias("found");
        context(1).read_table(Arc::new(table))?.select(vec![col("start"), found])?.create_physical_plan().await
    }
}

/// An error after which the run can be resumed.
fn resumable(error: StudyError) -> StudyError {
    StudyError::Cluster(format!("{error}\nwhat is done is kept; go on with --resume"))
}

/// Cuts rows into `tasks` tasks of about the same size, and every task into pieces of at most `largest` rows.
fn cut(rows: &Range<u64>, tasks: u64, largest: u64) -> Vec<Vec<Range<u64>>> {
    let count = rows.end - rows.start;
    let bound = |task: u64| rows.start + (u128::from(count) * u128::from(task) / u128::from(tasks)) as u64;
    let ranges = (0..tasks).map(|task| bound(task)..bound(task + 1)).filter(|range| !range.is_empty());
    let pieces = |range: Range<u64>| {
        let end = range.end;
        range.step_by(largest as usize).map(|start| start..end.min(start + largest)).collect()
    };
    ranges.map(pieces).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_in_one_piece() {
        for (rows, tasks, largest) in [(0..10, 3, 2), (5..6, 64, 4096), (1000..101_000, 7, 4096), (0..64, 64, 1)] {
            let cut = cut(&rows, tasks, largest);
            let joined: Vec<u64> = cut.iter().flatten().flat_map(Clone::clone).collect();
            assert_eq!(joined, rows.clone().collect::<Vec<_>>());
            assert!(cut.len() as u64 <= tasks && cut.iter().flatten().all(|piece| piece.end - piece.start <= largest));
            let sizes = cut.iter().map(|task| task.iter().map(|piece| piece.end - piece.start).sum::<u64>());
            let (least, most) = sizes.fold((u64::MAX, 0), |(least, most), size| (least.min(size), most.max(size)));
            assert!(most - least <= 1);
        }
    }
}
