//! Runs a study from its first row to its last: in waves, with a part for each; a stopped run can be resumed.

use super::found::Workers;
use super::lease::Lease;
use super::parts::{COUNTS, Parts, ROWS, gaps};
use super::watch::Watch;
use super::wave::Threads;
use super::write::{Tally, tally, write};
use crate::error::StudyError;
use crate::rows::{Prepared, counts_schema};
use crate::study::Study;
use kin_runtime::Mechanism;
use std::fmt;
use std::num::NonZero;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// How a study runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// The number of threads; `None` stands for the number of processors.
    pub threads: Option<NonZero<usize>>,
    /// Whether the directory may hold rows of this study already, which are not computed again.
    pub resume: bool,
}

/// The result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The rows that this run was to compute.
    pub rows: Range<u64>,
    /// How many of them are done, those of earlier runs included.
    pub done: u64,
    /// How many rows met the conditions before solving. This and the two numbers below include only parts that lie
    /// within `rows`: a part of an earlier run that was cut in another way may extend beyond them.
    pub solved: u64,
    /// How many of the solved rows have a motion that ended before the last instant.
    pub ended: u64,
    /// How many met all conditions.
    pub passed: u64,
    /// How many rows this run has computed itself.
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

/// `1000 rows: 800 solved, 12 of them ended early, 788 met all conditions; 1000 in 0.5 s, 2000 rows/s`.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { done, solved, ended, passed, own, time, .. } = self;
        write!(f, "{done} rows: {solved} solved, {ended} of them ended early, {passed} met all conditions")?;
        let seconds = time.as_secs_f64();
        write!(f, "; {own} in {seconds:.1} s, {:.0} rows/s", *own as f64 / seconds.max(1e-9))?;
        match self.is_complete() {
            true => Ok(()),
            false => write!(f, "; stopped, {} rows are missing", self.rows.end - self.rows.start - done),
        }
    }
}

/// Runs a whole study and writes its parts to the directory.
///
/// # Errors
/// The study does not fit the mechanism, the directory holds another study, or a file cannot be written. Parts that are
/// finished by then stay.
pub fn run<M>(study: &Study, directory: &Path, limits: Limits, watch: &Watch) -> Result<Report, StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    run_part::<M>(study, directory, (0, NonZero::<u64>::MIN), limits, watch)
}

/// Runs the part `index` of `of` parts of about the same size, counted from 0: for an array of jobs that share a
/// directory.
///
/// # Errors
/// As [`run`], and if `index` is not less than `of`.
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
    let prepared = Arc::new(prepared);
    let rows = part(prepared.rows, index, of);
    let processors = std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let threads = limits.threads.unwrap_or(processors).get();
    let mut workers = Threads::new(&prepared, threads, watch).map_err(|error| StudyError::file(directory, error))?;
    let part = Part { rows, is_whole: of.get() == 1, resume: limits.resume };
    cover(&prepared, directory, part, &mut workers, watch)
}

/// The rows that a run is to compute.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) rows: Range<u64>,
    /// Whether these are all rows of the study.
    pub(crate) is_whole: bool,
    /// Whether the directory may hold some of them already.
    pub(crate) resume: bool,
}

/// The indices of those of `of` parts, as [`run_part`] counts them, that have rows missing in a directory: the jobs to
/// be started again after some of an array have failed.
///
/// # Errors
/// The study does not fit the mechanism, or the directory holds another study or cannot be read.
pub fn missing<M>(study: &Study, directory: &Path, of: NonZero<u64>) -> Result<Vec<u64>, StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    let prepared = Prepared::new::<M>(study)?;
    let parts = Parts::of(directory);
    let covered = if parts.holds(&prepared)? { parts.covered()? } else { Vec::new() };
    let mut indices = Vec::new();
    for gap in gaps(0..prepared.rows, &covered) {
        let mut row = gap.start;
        while row < gap.end {
            let index = part_with(row, prepared.rows, of);
            if indices.last() != Some(&index) {
                indices.push(index);
            }
            row = part(prepared.rows, index, of).end;
        }
    }
    Ok(indices)
}

/// The rows of a part.
fn part(rows: u64, index: u64, parts: NonZero<u64>) -> Range<u64> {
    let bound = |k: u64| (u128::from(rows) * u128::from(k) / u128::from(parts.get())) as u64;
    bound(index)..bound(index + 1)
}

/// The index of the part with a row.
fn part_with(row: u64, rows: u64, parts: NonZero<u64>) -> u64 {
    (((u128::from(row) + 1) * u128::from(parts.get()) - 1) / u128::from(rows)) as u64
}

/// Computes the rows that no part covers yet and writes them; not generic over the mechanism.
pub(crate) fn cover(
    prepared: &Prepared,
    directory: &Path,
    Part { rows, is_whole, resume }: Part,
    workers: &mut dyn Workers,
    watch: &Watch,
) -> Result<Report, StudyError> {
    let began = Instant::now();
    // Jobs of an array share the directory, each with rows of its own.
    let parts = Parts::open(directory, prepared, resume || !is_whole)?;
    let _lease = Lease::take(directory, &rows, is_whole)?;
    let covered = parts.covered()?;
    let gaps = gaps(rows.clone(), &covered);
    watch.total.store(gaps.iter().map(|gap| gap.end - gap.start).sum(), Ordering::Relaxed);
    let mut computed = 0;
    'gaps: for gap in gaps {
        if !resume && gap != rows {
            return Err(StudyError::Directory(format!(
                "{} holds some of these rows already; go on with --resume, or choose another directory",
                directory.display()
            )));
        }
        let mut next = gap.start;
        while next < gap.end {
            let found = workers.wave(next..gap.end)?;
            if found.rows.is_empty() {
                break 'gaps;
            }
            next = found.rows.end;
            computed += found.rows.end - found.rows.start;
            if !prepared.bins.is_empty() {
                let table = found.summary.counts.table(&prepared.bins);
                let table = table.map_err(|error| StudyError::Engine(Box::new(error.into())))?;
                write(&parts.path(COUNTS, &found.rows), &counts_schema(), &[table], None)?;
            }
            // The file with the rows is written last: its existence means that the wave is complete.
            write(&parts.path(ROWS, &found.rows), &prepared.schema, &found.batches, Some(&found.summary.tally))?;
        }
    }
    let (mut done, mut sum) = (0, Tally::default());
    for (covered, path) in parts.files(ROWS)? {
        done += covered.end.min(rows.end).saturating_sub(covered.start.max(rows.start));
        if covered.start >= rows.start && covered.end <= rows.end {
            sum = sum.and(&tally(&path)?);
        }
    }
    let Tally { solved, ended, passed, .. } = sum;
    Ok(Report { rows, done, solved, ended, passed, own: computed, time: began.elapsed() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_in_the_part_of_its_index() {
        for (rows, of) in [(1, 1), (10, 3), (3, 10), (7, 7), (1 << 52, 999), (5, 1_000_000_000_000)] {
            let of = NonZero::new(of).expect("it is not 0");
            for row in [0, rows / 3, rows / 2, rows - 1] {
                assert!(part(rows, part_with(row, rows, of), of).contains(&row), "row {row} of {rows} in {of} parts");
            }
        }
    }
}
