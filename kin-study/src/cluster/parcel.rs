//! The results of a range of rows as bytes: an Arrow stream of the kept rows, with the summary of all rows in its
//! metadata.

use crate::engine::{Summary, Tally};
use crate::rows::{Counts, Prepared};
use datafusion::arrow::datatypes::Schema;
use datafusion::arrow::error::ArrowError;
use datafusion::arrow::ipc::reader::StreamReader;
use datafusion::arrow::ipc::writer::StreamWriter;
use datafusion::arrow::record_batch::{RecordBatch, RecordBatchOptions};
use std::collections::HashMap;
use std::sync::Arc;

/// The metadata key for the counts of all histograms.
const COUNTS: &str = "kin.counts";

/// The kept rows and the summary of all rows, as bytes.
pub(super) fn packed(batch: RecordBatch, summary: &Summary) -> Result<Vec<u8>, ArrowError> {
    let mut metadata: HashMap<String, String> =
        summary.tally.entries().map(|(key, number)| (key.to_owned(), number.to_string())).into();
    let counts: Vec<String> = summary.counts.numbers().map(|count| count.to_string()).collect();
    metadata.insert(COUNTS.to_owned(), counts.join(","));
    let schema = Arc::new(Schema::new_with_metadata(batch.schema().fields().clone(), metadata));
    let mut writer = StreamWriter::try_new(Vec::new(), &schema)?;
    writer.write(&batch.with_schema(schema)?)?;
    writer.into_inner()
}

/// The kept rows and the summary that these bytes contain.
pub(super) fn unpacked(bytes: &[u8], prepared: &Prepared) -> Result<(Vec<RecordBatch>, Summary), ArrowError> {
    let reader = StreamReader::try_new(bytes, None)?;
    let schema = reader.schema();
    let metadata = schema.metadata();
    let tally = Tally::of(|key| metadata.get(key)?.parse().ok());
    let counts = metadata.get(COUNTS).map_or("", String::as_str);
    let counts = Counts::of(&prepared.bins, counts.split(',').filter_map(|count| count.parse().ok()));
    let with_schema = |batch: Result<RecordBatch, ArrowError>| {
        let batch = batch?;
        let options = RecordBatchOptions::new().with_row_count(Some(batch.num_rows()));
        RecordBatch::try_new_with_options(Arc::clone(&prepared.schema), batch.columns().to_vec(), &options)
    };
    Ok((reader.map(with_schema).collect::<Result<_, _>>()?, Summary { tally, counts }))
}
