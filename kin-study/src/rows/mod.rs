//! The rows of a study: sampled, filtered, solved and scored, as record batches.

mod formula;
mod histogram;
mod prepare;

pub(crate) use formula::{CHUNK, context};
pub(crate) use histogram::{Counts, counts_schema};
pub(crate) use prepare::Prepared;

use crate::error::StudyError;
use crate::machine::Scored;
use datafusion::arrow::array::{ArrayRef, AsArray, Float64Array, StringArray, StringBuilder, UInt64Array};
use datafusion::arrow::buffer::NullBuffer;
use datafusion::arrow::datatypes::Float64Type;
use datafusion::arrow::record_batch::{RecordBatch, RecordBatchOptions};
use formula::meeting;
use kin_runtime::batch::Column;
use std::ops::Range;
use std::sync::Arc;

/// Some rows of a study, and what became of the others.
#[derive(Debug)]
pub(crate) struct Piece {
    /// The rows that meet all conditions.
    pub(crate) batch: RecordBatch,
    /// How many there were before any condition.
    pub(crate) tried: u64,
    /// How many met the conditions before solving.
    pub(crate) solved: u64,
    /// How many of these could not go through all instants.
    pub(crate) ended: u64,
}

impl Prepared {
    /// The rows in a range.
    pub(crate) fn rows(&self, rows: Range<u64>) -> Result<Piece, StudyError> {
        let tried = rows.end - rows.start;
        let batch = meeting(self.sampled(rows)?, &self.before)?;
        let count = batch.num_rows();
        let numbers = |name: &str| batch.column_by_name(name).map(|column| column.as_primitive::<Float64Type>());
        let parameters: Vec<Column<'_>> = self
            .sources
            .iter()
            .map(|(name, default)| match numbers(name) {
                Some(column) => Column::Each(column.values()),
                None => Column::Shared(*default),
            })
            .collect();
        let combinations: Vec<usize> = self.combinations(&batch);
        let modes = &self.motion.modes;
        let signs: Vec<Vec<f64>> = (0..modes[0].1.len())
            .map(|k| combinations.iter().map(|combination| modes[*combination].1[k]).collect())
            .collect();
        let signs: Vec<Column<'_>> = signs.iter().map(|signs| Column::Each(signs)).collect();
        let scored = self.machine.sweep(&parameters, &signs, count)?;
        let ended = scored.ends.iter().filter(|end| end.is_some()).count() as u64;
        let batch = meeting(self.scored(&batch, &combinations, &scored)?, &self.after)?;
        Ok(Piece { batch, tried, solved: count as u64, ended })
    }

    /// Parameters and derived columns of a range of rows, behind their numbers.
    fn sampled(&self, rows: Range<u64>) -> Result<RecordBatch, StudyError> {
        let count = (rows.end - rows.start) as usize;
        let modes = self.motion.modes.len() as u64;
        let mut columns: Vec<ArrayRef> = vec![Arc::new(UInt64Array::from_iter_values(rows.clone()))];
        for parameter in 0..self.sampled {
            let numbers = rows.clone().map(|row| self.sampler.at(row / modes, parameter));
            columns.push(Arc::new(Float64Array::from_iter_values(numbers)));
        }
        columns
            .extend(self.constants.iter().map(|value| Arc::new(Float64Array::from_value(*value, count)) as ArrayRef));
        let mut batch = assembled(&self.inputs[0], columns, count)?;
        for (formula, schema) in self.derived.iter().zip(&self.inputs[1..]) {
            let mut columns = batch.columns().to_vec();
            let values = formula.values(&batch)?;
            // A quotient by zero is null in places; to a mechanism it is no number.
            let values = values.as_primitive::<Float64Type>();
            let numbers = values.iter().map(|value| value.unwrap_or(f64::NAN));
            columns.push(Arc::new(Float64Array::from_iter_values(numbers)));
            batch = assembled(schema, columns, count)?;
        }
        Ok(batch)
    }

    /// Which combination of modes every row takes.
    fn combinations(&self, batch: &RecordBatch) -> Vec<usize> {
        let numbers = batch.column(0).as_primitive::<datafusion::arrow::datatypes::UInt64Type>();
        numbers.values().iter().map(|row| (row % self.motion.modes.len() as u64) as usize).collect()
    }

    /// The table: what is shown of the sampled columns, scores, and how it ended.
    fn scored(&self, batch: &RecordBatch, combinations: &[usize], scored: &Scored) -> Result<RecordBatch, StudyError> {
        let mut columns: Vec<ArrayRef> = self.shown.iter().map(|place| Arc::clone(batch.column(*place))).collect();
        if self.motion.modes.len() > 1 {
            let names = combinations.iter().map(|combination| self.motion.modes[*combination].0.as_str());
            columns.push(Arc::new(StringArray::from_iter_values(names)));
        }
        let complete = NullBuffer::from_iter(scored.ends.iter().map(Option::is_none));
        let complete = (complete.null_count() > 0).then_some(complete);
        for score in &scored.scores {
            columns.push(Arc::new(Float64Array::new(score.clone().into(), complete.clone())));
        }
        columns.push(Arc::new(Float64Array::from(scored.margins.clone())));
        let time = |end: &kin_runtime::batch::End| self.motion.times[end.instant];
        columns.push(Arc::new(Float64Array::from_iter(scored.ends.iter().map(|end| end.as_ref().map(time)))));
        let mut limits = StringBuilder::new();
        for end in &scored.ends {
            match end.as_ref().map(|end| &end.limit) {
                Some(Some(limit)) => limits.append_value(limit.step.to_string()),
                Some(None) => limits.append_value("a number is not finite"),
                None => limits.append_null(),
            }
        }
        columns.push(Arc::new(limits.finish()));
        assembled(&self.schema, columns, combinations.len())
    }
}

fn assembled(
    schema: &datafusion::arrow::datatypes::SchemaRef,
    columns: Vec<ArrayRef>,
    count: usize,
) -> Result<RecordBatch, StudyError> {
    let options = RecordBatchOptions::new().with_row_count(Some(count));
    let batch = RecordBatch::try_new_with_options(Arc::clone(schema), columns, &options);
    batch.map_err(|error| StudyError::Engine(Box::new(error.into())))
}
