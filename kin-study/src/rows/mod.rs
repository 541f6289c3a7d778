//! The rows of a study: sampled, filtered, solved and scored, as record batches.

mod formula;
mod histogram;
mod order;
mod prepare;

pub(crate) use formula::context;
pub(crate) use histogram::{Counts, counts_schema};
pub(crate) use order::{Kept, selected};
pub(crate) use prepare::Prepared;

use crate::error::StudyError;
use crate::machine::{Scored, Values};
use datafusion::arrow::array::{
    Array, ArrayRef, AsArray, FixedSizeListArray, Float32Array, Float64Array, StringArray, StringBuilder, UInt64Array,
};
use datafusion::arrow::buffer::{NullBuffer, ScalarBuffer};
use datafusion::arrow::datatypes::Float64Type;
use datafusion::arrow::record_batch::{RecordBatch, RecordBatchOptions};
use formula::meeting;
use kin_runtime::batch::{Column, End};
use prepare::{Source, item};
use std::ops::Range;
use std::sync::Arc;

/// The rows of a piece that meet all conditions, and how many there were before.
#[derive(Debug)]
pub(crate) struct Piece {
    /// The rows that meet all conditions.
    pub(crate) batch: RecordBatch,
    /// How many there were before any condition.
    pub(crate) tried: u64,
    /// How many met the conditions before solving.
    pub(crate) solved: u64,
    /// How many of the solved rows have a motion that ended before the last instant.
    pub(crate) ended: u64,
}

impl Prepared {
    /// The rows in a range.
    pub(crate) fn rows(&self, rows: Range<u64>) -> Result<Piece, StudyError> {
        let tried = rows.end - rows.start;
        let batch = meeting(self.sampled(rows)?, &self.before)?;
        let count = batch.num_rows();
        // A parameter without a value is NaN for the mechanism.
        let numbers = |source: &Source| match *source {
            Source::Each(place) => with_nan(batch.column(place)),
            Source::Shared(_) => ScalarBuffer::default(),
        };
        let numbers: Vec<ScalarBuffer<f64>> = self.sources.iter().map(numbers).collect();
        let columns = self.sources.iter().zip(&numbers).map(|(source, numbers)| match *source {
            Source::Each(_) => Column::Each(numbers),
            Source::Shared(value) => Column::Shared(value),
        });
        let parameters: Vec<Column<'_>> = columns.collect();
        let combinations: Vec<usize> = self.combinations(&batch);
        let modes = &self.motion.modes;
        let each = |k: usize| combinations.iter().map(|combination| modes[*combination].1[k]).collect();
        let signs: Vec<Vec<f64>> = match &modes[..] {
            [_] => Vec::new(),
            several => (0..several[0].1.len()).map(each).collect(),
        };
        let signs: Vec<Column<'_>> = match &modes[..] {
            [(_, signs)] => signs.iter().map(|sign| Column::Shared(*sign)).collect(),
            _ => signs.iter().map(|signs| Column::Each(signs)).collect(),
        };
        let scored = self.machine.sweep(&parameters, &signs, count)?;
        let ended = scored.ends.iter().filter(|end| end.is_some()).count() as u64;
        let batch = meeting(self.scored(&batch, &combinations, scored)?, &self.after)?;
        Ok(Piece { batch, tried, solved: count as u64, ended })
    }

    /// The numbers of a range of rows, followed by their parameters and derived columns.
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
            columns.push(formula.values(&batch)?);
            batch = assembled(schema, columns, count)?;
        }
        Ok(batch)
    }

    /// Which combination of modes every row takes.
    fn combinations(&self, batch: &RecordBatch) -> Vec<usize> {
        let numbers = batch.column(0).as_primitive::<datafusion::arrow::datatypes::UInt64Type>();
        numbers.values().iter().map(|row| (row % self.motion.modes.len() as u64) as usize).collect()
    }

    /// The table: the columns that it shows of `batch`, the scores, and where and why motions ended.
    fn scored(&self, batch: &RecordBatch, combinations: &[usize], scored: Scored) -> Result<RecordBatch, StudyError> {
        let mut columns: Vec<ArrayRef> = self.shown.iter().map(|place| Arc::clone(batch.column(*place))).collect();
        if self.motion.modes.len() > 1 {
            let names = combinations.iter().map(|combination| self.motion.modes[*combination].0.as_str());
            columns.push(Arc::new(StringArray::from_iter_values(names)));
        }
        for score in scored.scores {
            // A score without a value, such as the angle at an arm of length zero, is null.
            let known = |(value, end): (bool, &Option<End>)| end.is_none() && value;
            columns.push(match score {
                Values::Numbers(values) => {
                    let known = values.iter().map(|value| value.is_finite()).zip(&scored.ends).map(known);
                    let known = NullBuffer::from_iter(known);
                    Arc::new(Float64Array::new(values.into(), Some(known).filter(|known| known.null_count() > 0)))
                }
                Values::Lists(width, values) => {
                    let whole = |list: &[f32]| list.iter().all(|value| value.is_finite());
                    let known = NullBuffer::from_iter(values.chunks(width).map(whole).zip(&scored.ends).map(known));
                    let values = Arc::new(Float32Array::from(values));
                    let list = FixedSizeListArray::try_new(item(), width as i32, values, Some(known));
                    Arc::new(list.map_err(|error| StudyError::Engine(Box::new(error.into())))?)
                }
            });
        }
        columns.push(Arc::new(Float64Array::from(scored.margins)));
        let time = |end: &End| self.motion.times[end.instant];
        columns.push(Arc::new(Float64Array::from_iter(scored.ends.iter().map(|end| end.as_ref().map(time)))));
        let mut limits = StringBuilder::new();
        for end in &scored.ends {
            match end.as_ref().map(|end| &end.limit) {
                Some(Some(limit)) => limits.append_value(limit.step.to_string()),
                Some(None) => limits.append_value(
                    "a number is not finite, a length is negative, the motion jumps, or an iteration leads away from its start",
                ),
                None => limits.append_null(),
            }
        }
        columns.push(Arc::new(limits.finish()));
        assembled(&self.schema, columns, combinations.len())
    }
}

/// The numbers of a column, NaN where it has none.
fn with_nan(column: &ArrayRef) -> ScalarBuffer<f64> {
    let values = column.as_primitive::<Float64Type>();
    match values.null_count() {
        0 => values.values().clone(),
        _ => values.iter().map(|value| value.unwrap_or(f64::NAN)).collect(),
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
