//! SQL over the parts of a study.

use super::parts::{COUNTS, Parts, ROWS};
use super::write::temporary;
use crate::error::StudyError;
use crate::rows::{context, selected};
use datafusion::arrow::csv::WriterBuilder;
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::arrow::util::pretty::pretty_format_batches;
use datafusion::dataframe::DataFrame;
use datafusion::execution::context::SessionContext;
use datafusion::parquet::arrow::ArrowWriter;
use datafusion::prelude::ParquetReadOptions;
use futures::StreamExt;
use std::fmt;
use std::future::Future;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// The result of a query.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Its rows, batch by batch.
    pub batches: Vec<RecordBatch>,
}

/// A table of text.
impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match pretty_format_batches(&self.batches) {
            Ok(table) => table.fmt(f),
            Err(error) => error.fmt(f),
        }
    }
}

/// Queries the directory of a study by SQL: its rows are the table `study`, the counts of its histograms the table
/// `histogram`. The result is held in memory.
///
/// # Errors
/// The directory has no parts, or the engine rejects the query.
pub fn query(directory: &Path, sql: &str) -> Result<Answer, StudyError> {
    wait(async {
        let answer = asked(directory, sql).await?;
        Ok(Answer { batches: answer.collect().await? })
    })
}

/// As [`query`], with the result written to a file batch by batch: as CSV if its name ends in `.csv`, as Parquet if it
/// ends in `.parquet`. Returns the number of rows.
///
/// # Errors
/// As [`query`], and if the file has another extension or cannot be written; an existing file stays as it was then.
pub fn query_to_file(directory: &Path, sql: &str, path: &Path) -> Result<u64, StudyError> {
    let failed = |error: io::Error| StudyError::file(path, error);
    let engine = |error: datafusion::error::DataFusionError| StudyError::from(error);
    let is = |ending: &str| path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending));
    if !is("csv") && !is("parquet") {
        let message = format!("{} ends neither in .csv nor in .parquet", path.display());
        return Err(StudyError::description(message));
    }
    wait(async {
        let mut stream = asked(directory, sql).await?.execute_stream().await?;
        let target = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let file = temporary(target).map_err(failed)?;
        let mut rows = 0;
        let schema = stream.schema();
        if is("csv") {
            let mut writer = WriterBuilder::new().with_header(true).build(BufWriter::new(file.as_file()));
            writer.write(&RecordBatch::new_empty(schema)).map_err(|error| engine(error.into()))?;
            while let Some(batch) = stream.next().await {
                let batch = batch?;
                rows += batch.num_rows() as u64;
                writer.write(&batch).map_err(|error| engine(error.into()))?;
            }
            writer.into_inner().into_inner().map_err(|error| failed(error.into_error()))?;
        } else {
            let mut writer = ArrowWriter::try_new(BufWriter::new(file.as_file()), schema, None)
                .map_err(|error| engine(error.into()))?;
            while let Some(batch) = stream.next().await {
                let batch = batch?;
                rows += batch.num_rows() as u64;
                writer.write(&batch).map_err(|error| engine(error.into()))?;
            }
            let inner = writer.into_inner().map_err(|error| engine(error.into()))?;
            inner.into_inner().map_err(|error| failed(error.into_error()))?;
        }
        file.persist(path).map_err(|error| failed(error.error))?;
        Ok(rows)
    })
}

/// Executes work of the engine on all processors and waits for it.
fn wait<T>(work: impl Future<Output = Result<T, StudyError>>) -> Result<T, StudyError> {
    let runtime = tokio::runtime::Builder::new_multi_thread().build();
    runtime.map_err(|error| StudyError::file(Path::new("threads"), error))?.block_on(work)
}

/// The query over all parts.
async fn asked(directory: &Path, sql: &str) -> Result<DataFrame, StudyError> {
    let parts = Parts::of(directory);
    parts.is_no_pattern()?;
    let rows = parts.files(ROWS)?;
    if rows.is_empty() {
        let message = format!("{} has no rows of a study; `run` or `chunk` writes them", parts.directory().display());
        return Err(StudyError::Directory(message));
    }
    let covered = parts.covered()?;
    let processors = std::thread::available_parallelism().map_or(1, |count| count.get());
    let context = context(processors);
    register(&context, "parts", rows).await?;
    context.register_table("study", selected(&context, &parts.view()?).await?.into_view())?;
    // Counts are written before rows: those without rows belong to a wave that was not finished.
    let mut counts = parts.files(COUNTS)?;
    counts.retain(|(rows, _)| covered.contains(rows));
    if !counts.is_empty() {
        register(&context, "counts", counts).await?;
        let sum = "SELECT \"of\", \"from\", \"to\", CAST(sum(\"count\") AS BIGINT) AS \"count\" FROM counts \
                   GROUP BY \"of\", \"from\", \"to\" ORDER BY \"of\", \"from\"";
        context.register_table("histogram", context.sql(sum).await?.into_view())?;
    }
    Ok(context.sql(sql).await?)
}

async fn register(
    context: &SessionContext,
    name: &str,
    files: Vec<(std::ops::Range<u64>, PathBuf)>,
) -> Result<(), StudyError> {
    let paths: Vec<String> = files.into_iter().map(|(_, path)| path.to_string_lossy().into_owned()).collect();
    let table = context.read_parquet(paths, ParquetReadOptions::default()).await?;
    context.register_table(name, table.into_view())?;
    Ok(())
}
