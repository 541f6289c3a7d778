//! A run whose rows are solved by workers.

use super::function::Function;
use super::parcel::unpacked;
use super::roles::{HEARTBEAT, embedded, ready};
use crate::engine::{Found, Part, Report, Summary, TIME, Watch, Workers, cover, merged, most};
use crate::error::StudyError;
use crate::rows::{CHUNK, Prepared, context};
use crate::study::Study;
use ballista_core::config::BallistaConfig;
use ballista_core::execution_plans::execute_physical_plan;
use ballista_core::extension::SessionConfigExt;
use datafusion::arrow::array::{AsArray, UInt64Array};
use datafusion::arrow::datatypes::{DataType, Field, Schema};
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::datasource::MemTable;
use datafusion::error::DataFusionError;
use datafusion::logical_expr::{ScalarUDF, col, lit};
use datafusion::physical_plan::ExecutionPlan;
use datafusion::physical_plan::common::collect;
use datafusion::prelude::SessionConfig;
use datafusion_proto::protobuf::PhysicalPlanNode;
use kin_runtime::Mechanism;
use std::num::NonZero;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant, SystemTime};

/// The largest message between the members of a cluster, in bytes.
pub(super) const MESSAGE: u32 = 64 << 20;
/// Rows of every task in the first wave, which tells how fast the cluster is.
const FIRST: u64 = 256;
/// How often a wave is tried while there are workers.
const TRIES: usize = 8;
/// Numbers in a parcel at most, so that it fits into a message.
const NUMBERS: u64 = 1 << 20;

/// Where rows are solved.
#[derive(Clone, Debug)]
pub struct Cluster {
    place: Place,
    tasks: u64,
}

#[derive(Clone, Debug)]
enum Place {
    /// At the workers of a scheduler.
    Scheduler(String),
    /// At a scheduler and a worker in this process.
    Here(NonZero<usize>),
}

impl Cluster {
    /// The workers of the scheduler at `host:port`.
    pub fn at(scheduler: impl Into<String>) -> Self {
        Self { place: Place::Scheduler(scheduler.into()), tasks: 64 }
    }

    /// A cluster within this process, with a worker of so many threads: to try what a study does there.
    pub fn standalone(threads: NonZero<usize>) -> Self {
        Self { place: Place::Here(threads), tasks: 64 }
    }

    /// Into how many tasks every wave is cut, 64 where nobody says. With fewer than the cluster has cores some of them wait.
    #[must_use]
    pub fn tasks(self, tasks: NonZero<usize>) -> Self {
        Self { tasks: tasks.get() as u64, ..self }
    }
}

/// Runs a whole study on a cluster; its parts go to the directory, which only this process writes.
///
/// A worker that is lost costs what it was at work on and what it has found in these seconds, which others compute again.
///
/// # Errors
/// As [`run`](crate::run); [`StudyError::Cluster`] where the scheduler or all workers are lost, and where they are another
/// program. Parts that were finished before stay.
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
    // Workers know the text alone.
    let again = Prepared::new::<M>(&Study::from_toml(&text)?)?;
    if again.identity != prepared.identity {
        return Err(StudyError::description("this study is another one when it is written as a file and read again"));
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
    let own = Arc::clone(&prepared);
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
        prepared: own, function, text, scheduler, session, is_far, tasks, runtime, watch: watching, next,
    };
    cover(&prepared, directory, part, &mut remote, watch)
}

/// The workers of a cluster.
struct Remote {
    prepared: Arc<Prepared>,
    function: ScalarUDF,
    /// The study.
    text: String,
    scheduler: String,
    /// The name under which the scheduler knows this run.
    session: String,
    /// Whether it is another process.
    is_far: bool,
    tasks: u64,
    runtime: tokio::runtime::Runtime,
    watch: Watch,
    /// How many rows the next wave takes.
    next: u64,
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
        let mut batches = Vec::new();
        for parcels in self.answers(&rows)? {
            for parcel in parcels.column(0).as_binary::<i32>().iter().flatten() {
                let (own, found) = unpacked(parcel, &self.prepared).map_err(DataFusionError::from)?;
                batches.extend(own);
                summary.and(&found);
            }
        }
        if summary.tally.tried != count {
            let tried = summary.tally.tried;
            return Err(StudyError::Cluster(format!("{}: {tried} of {count} rows came back", self.scheduler)));
        }
        let table = MemTable::try_new(Arc::clone(&self.prepared.schema), vec![batches])?;
        let batches = self.runtime.block_on(merged(&self.prepared, Arc::new(table), 1))?;
        self.watch.done.fetch_add(count, Ordering::Relaxed);
        let rate = count as f64 / began.elapsed().as_secs_f64().max(1e-3);
        let next = (rate * TIME.as_secs_f64()) as u64;
        self.next = next.min(count.saturating_mul(8)).max(self.tasks * FIRST);
        Ok(Found { rows, batches, summary })
    }
}

impl Remote {
    /// What the workers find in some rows. A worker that is lost takes with it what it has found, so that all is computed
    /// again by those that are left.
    fn answers(&self, rows: &Range<u64>) -> Result<Vec<RecordBatch>, StudyError> {
        let mut tries = 0;
        loop {
            let error = match self.runtime.block_on(self.parcels(rows)) {
                Ok(answers) => return Ok(answers),
                Err(error) => error,
            };
            tries += 1;
            let goes_on = || self.is_far && !self.is_foreign(&error) && ready(&self.scheduler, &self.watch).is_ok();
            if tries == TRIES || self.watch.stop.load(Ordering::Relaxed) || !goes_on() {
                return Err(self.lost(&error));
            }
            std::thread::sleep(Duration::from_secs(HEARTBEAT));
        }
    }

    /// Whether an error says that a member of the cluster is another program: a scheduler says which function it does not
    /// know, and a worker only that it cannot read the task.
    fn is_foreign(&self, error: &DataFusionError) -> bool {
        let text = error.strip_backtrace();
        let is_unknown = text.contains(self.function.name()) && text.contains("no UDF named");
        is_unknown || text.contains("task could not be prepared or was rejected")
    }

    /// What the workers find in some rows.
    async fn parcels(&self, rows: &Range<u64>) -> Result<Vec<RecordBatch>, DataFusionError> {
        let config = SessionConfig::new_with_ballista();
        let config = config.with_ballista_grpc_client_max_message_size(MESSAGE as usize);
        let codec = config.ballista_physical_extension_codec();
        let session = self.session.clone();
        let (url, settings): (String, BallistaConfig) =
            (format!("http://{}", self.scheduler), config.ballista_config());
        let plan = self.plan(rows).await?;
        let stream =
            execute_physical_plan::<PhysicalPlanNode>(url, &settings, plan, codec.as_ref(), session, config).await?;
        collect(stream).await
    }

    /// A table whose partitions are the tasks, each with a row for every piece, and the function of these.
    async fn plan(&self, rows: &Range<u64>) -> Result<Arc<dyn ExecutionPlan>, DataFusionError> {
        let number = |name| Field::new(name, DataType::UInt64, false);
        let schema = Arc::new(Schema::new(vec![number("start"), number("end")]));
        let largest = (NUMBERS / self.prepared.numbers()).clamp(1, CHUNK as u64);
        let task = |pieces: Vec<Range<u64>>| {
            let numbers = |of: fn(&Range<u64>) -> u64| UInt64Array::from_iter_values(pieces.iter().map(of));
            let [starts, ends] = [numbers(|piece| piece.start), numbers(|piece| piece.end)];
            Ok(vec![RecordBatch::try_new(Arc::clone(&schema), vec![Arc::new(starts), Arc::new(ends)])?])
        };
        let tasks = cut(rows, self.tasks, largest).into_iter().map(task);
        let tasks = tasks.collect::<Result<Vec<_>, DataFusionError>>()?;
        let table = MemTable::try_new(Arc::clone(&schema), tasks)?;
        let found = self.function.call(vec![lit(self.text.as_str()), col("start"), col("end")]).alias("found");
        context(1).read_table(Arc::new(table))?.select(vec![found])?.create_physical_plan().await
    }

    /// What an error of the engine means here.
    fn lost(&self, error: &DataFusionError) -> StudyError {
        let scheduler = &self.scheduler;
        StudyError::Cluster(if self.is_foreign(error) {
            format!(
                "{scheduler}: the scheduler or a worker is another program, or another build of it; start the same file \
                 everywhere"
            )
        } else {
            format!("{scheduler}: {}", error.strip_backtrace())
        })
    }
}

/// Rows as pieces of at most `largest` rows, and these as so many tasks of about the same size.
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
