//! How often columns fall into intervals.

use crate::error::StudyError;
use crate::study::Histogram;
use crate::suggest::unknown;
use datafusion::arrow::array::{AsArray, Float64Array, StringArray, UInt64Array};
use datafusion::arrow::datatypes::{DataType, Field, Float64Type, Schema, SchemaRef};
use datafusion::arrow::error::ArrowError;
use datafusion::arrow::record_batch::RecordBatch;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Largest number of bins of a histogram.
const MAX_BINS: usize = 1_000_000;

/// A histogram, and the place of its column in the table.
#[derive(Clone, Debug)]
pub(crate) struct Bins {
    histogram: Histogram,
    column: usize,
}

/// The columns of the table of counts.
pub(crate) fn counts_schema() -> SchemaRef {
    let number = |name| Field::new(name, DataType::Float64, false);
    let count = Field::new("count", DataType::UInt64, false);
    Arc::new(Schema::new(vec![Field::new("of", DataType::Utf8, false), number("from"), number("to"), count]))
}

impl Bins {
    pub(super) fn new(histogram: &Histogram, schema: &Schema) -> Result<Self, StudyError> {
        let is_number = |field: &&Arc<Field>| field.data_type() == &DataType::Float64;
        let known = schema.fields().iter().filter(is_number).map(|field| field.name().as_str());
        let place = schema.fields().iter().position(|field| is_number(&field) && *field.name() == histogram.of);
        let column = place.ok_or_else(|| StudyError::description(unknown("column", &histogram.of, known)))?;
        let Histogram { from, to, bins, .. } = *histogram;
        match from.is_finite() && to.is_finite() && from < to && (1..=MAX_BINS).contains(&bins) {
            true => Ok(Self { histogram: histogram.clone(), column }),
            false => Err(StudyError::description(format!("a histogram needs from < to and 1 to {MAX_BINS} bins"))),
        }
    }

    /// The ends of its bins.
    fn ends(&self) -> impl Iterator<Item = [f64; 2]> {
        let Histogram { from, to, bins, .. } = self.histogram;
        let width = (to - from) / bins as f64;
        (0..bins).map(move |k| [from + k as f64 * width, from + (k + 1) as f64 * width])
    }
}

/// The place of the first histogram with a bin that an earlier one of the same column has, too, and what is wrong: in
/// the table of counts a bin is known by its column and its ends.
pub(super) fn first_repeated(all: &[Bins]) -> Option<(usize, String)> {
    let mut known = BTreeSet::new();
    let mut repeated = |bins: &Bins, [from, to]: [f64; 2]| {
        let is_new = known.insert((bins.column, [from, to].map(f64::to_bits)));
        let column = &bins.histogram.of;
        (!is_new).then(|| format!("two histograms of `{column}` have a bin from {from} to {to}; choose other bins"))
    };
    all.iter().enumerate().find_map(|(place, bins)| Some((place, bins.ends().find_map(|ends| repeated(bins, ends))?)))
}

/// The counts of some histograms.
#[derive(Clone, Debug)]
pub(crate) struct Counts(Vec<Vec<u64>>);

impl Counts {
    /// Nothing counted yet.
    pub(crate) fn new(bins: &[Bins]) -> Self {
        Self(bins.iter().map(|bins| vec![0; bins.histogram.bins]).collect())
    }

    /// Counts the rows of a table, except those without a number.
    pub(crate) fn add(&mut self, bins: &[Bins], batch: &RecordBatch) {
        for (counts, Bins { histogram, column }) in self.0.iter_mut().zip(bins) {
            let scale = histogram.bins as f64 / (histogram.to - histogram.from);
            let values = batch.column(*column).as_primitive::<Float64Type>();
            for value in values.iter().flatten().filter(|value| !value.is_nan()) {
                // The conversion turns negative numbers into 0.
                let place = ((value - histogram.from) * scale) as usize;
                counts[place.min(histogram.bins - 1)] += 1;
            }
        }
    }

    /// Adds the counts of other rows.
    pub(crate) fn and(&mut self, other: &Self) {
        let pairs = self.0.iter_mut().flatten().zip(other.0.iter().flatten());
        pairs.for_each(|(count, other)| *count += other);
    }

    /// The counts of all bins of one histogram after another.
    #[cfg(feature = "cluster")]
    pub(crate) fn numbers(&self) -> impl Iterator<Item = u64> {
        self.0.iter().flatten().copied()
    }

    /// The counts with these [`numbers`](Self::numbers).
    #[cfg(feature = "cluster")]
    pub(crate) fn of(bins: &[Bins], numbers: impl IntoIterator<Item = u64>) -> Self {
        let mut counts = Self::new(bins);
        counts.0.iter_mut().flatten().zip(numbers).for_each(|(count, number)| *count = number);
        counts
    }

    /// The table of all counts.
    pub(crate) fn table(&self, bins: &[Bins]) -> Result<RecordBatch, ArrowError> {
        let (mut columns, mut from, mut to, mut count) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (counts, bins) in self.0.iter().zip(bins) {
            for (counted, [start, end]) in counts.iter().zip(bins.ends()) {
                columns.push(bins.histogram.of.as_str());
                from.push(start);
                to.push(end);
                count.push(*counted);
            }
        }
        RecordBatch::try_new(
            counts_schema(),
            vec![
                Arc::new(StringArray::from(columns)),
                Arc::new(Float64Array::from(from)),
                Arc::new(Float64Array::from(to)),
                Arc::new(UInt64Array::from(count)),
            ],
        )
    }
}
