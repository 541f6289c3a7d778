//! A study prepared for its mechanism: names resolved, formulas compiled, columns laid out.

use super::formula::{CHUNK, Formula, context};
use super::histogram::{Bins, first_repeated};
use super::order::{Best, Kept};
use crate::error::StudyError;
use crate::machine::{Machine, Motion, bind};
use crate::sampling::Sampler;
use crate::study::Study;
use crate::suggest::unknown;
use datafusion::arrow::datatypes::{DataType, Field, FieldRef, Schema, SchemaRef};
use datafusion::execution::context::SessionContext;
use kin_runtime::Mechanism;
use kin_runtime::model::{Model, ParameterInfo};
use std::sync::Arc;

/// Names that are reserved for columns of kin-study itself.
const OWN: [&str; 5] = ["row", "mode", "margin", "ended", "limit"];

/// A study that fits its mechanism.
#[derive(Debug)]
pub(crate) struct Prepared {
    pub(super) machine: Box<dyn Machine>,
    pub(super) motion: Motion,
    pub(super) sampler: Sampler,
    /// How many columns are sampled.
    pub(super) sampled: usize,
    /// The values of the constant columns after the sampled ones: parameters of the mechanism that the study does not
    /// name.
    pub(super) constants: Vec<f64>,
    /// The formulas of the derived columns, which come after the constant ones.
    pub(super) derived: Vec<Formula>,
    /// The input columns before the first formula, and after every formula.
    pub(super) inputs: Vec<SchemaRef>,
    /// Where the parameters of the mechanism come from.
    pub(super) sources: Vec<Source>,
    pub(super) before: Vec<Formula>,
    /// The indices of the input columns that the table shows.
    pub(super) shown: Vec<usize>,
    /// The columns of the table.
    pub(crate) schema: SchemaRef,
    pub(super) after: Vec<Formula>,
    pub(crate) bins: Vec<Bins>,
    /// How many rows there are.
    pub(crate) rows: u64,
    /// Which rows are kept.
    pub(crate) kept: Kept,
    /// The text that identifies the study: studies with the same text have the same rows.
    pub(crate) identity: String,
}

/// Where a parameter of the mechanism comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// The input column with this index.
    Each(usize),
    /// The same number in all rows.
    Shared(f64),
}

fn number(name: &str) -> Field {
    Field::new(name, DataType::Float64, false)
}

/// The type of the numbers in the list of a path.
pub(super) fn item() -> FieldRef {
    Arc::new(Field::new("item", DataType::Float32, false))
}

impl Prepared {
    /// How many numbers a row of the table has.
    pub(crate) fn numbers(&self) -> u64 {
        let count = |field: &FieldRef| match field.data_type() {
            DataType::FixedSizeList(_, width) => *width as u64,
            _ => 1,
        };
        self.schema.fields().iter().map(count).sum()
    }

    /// The number of rows of a piece with at most `numbers` numbers. A row with a path has many.
    pub(crate) fn rows_of_piece(&self, numbers: u64) -> u64 {
        (numbers / self.numbers()).clamp(1, CHUNK as u64)
    }

    /// Prepares a study for a mechanism.
    pub(crate) fn new<M>(study: &Study) -> Result<Self, StudyError>
    where
        M: Mechanism + Default + Send + Sync + 'static,
    {
        let (machine, motion) = bind::<M>(study)?;
        Self::of(study, machine, motion)
    }

    fn of(study: &Study, machine: Box<dyn Machine>, motion: Motion) -> Result<Self, StudyError> {
        names_are_free(study)?;
        names_are_known(study, machine.model())?;
        let ranges = study.parameters.iter().map(|(name, range)| {
            let line = study.line(&format!("parameters.{name}"));
            let wrong = |message: String| StudyError::description(format!("{name}: {message}")).on_line(line);
            range.check().map_err(wrong).map(|()| range.clone())
        });
        let ranges = ranges.collect::<Result<Vec<_>, _>>()?;
        let sampled = ranges.len();
        let line = study.line("rows").or(study.line("sampling"));
        let sampler = Sampler::new(ranges, study.sampling, study.rows, study.seed)
            .map_err(|message| StudyError::description(message).on_line(line))?;
        let rows = sampler.rows().checked_mul(motion.modes.len() as u64).filter(|rows| *rows < 1 << 53);
        let rows = rows.ok_or_else(|| StudyError::description("there are too many rows to count").on_line(line))?;
        if rows == 0 {
            return Err(StudyError::description("a study has at least one row").on_line(line));
        }

        let context = context(1);
        let named = |name: &str| {
            study.parameters.iter().any(|(known, _)| known == name)
                || study.derived.iter().any(|(known, _)| known == name)
        };
        let parameters = || machine.model().parameters.iter().zip(&motion.defaults);
        let (constant_names, constants): (Vec<&str>, Vec<f64>) =
            parameters().filter(|(info, _)| !named(info.name)).map(|(info, value)| (info.name, *value)).unzip();
        let mut fields = vec![Field::new("row", DataType::UInt64, false)];
        fields.extend(study.parameters.iter().map(|(name, _)| number(name)));
        fields.extend(constant_names.into_iter().map(number));
        let mut shown: Vec<usize> = (0..=sampled).collect();
        let mut inputs = vec![Arc::new(Schema::new(fields.clone()))];
        let mut derived = Vec::new();
        for (name, text) in &study.derived {
            let compiled = Formula::number(&context, text, &inputs[inputs.len() - 1]);
            derived.push(compiled.map_err(|error| error.on_line(study.line(&format!("derived.{name}"))))?);
            shown.push(fields.len());
            fields.push(number(name).with_nullable(true));
            inputs.push(Arc::new(Schema::new(fields.clone())));
        }
        let source = |(info, value): (&ParameterInfo, &f64)| {
            let place = fields.iter().position(|field| named(info.name) && field.name() == info.name);
            place.map_or(Source::Shared(*value), Source::Each)
        };
        let sources = parameters().map(source).collect();
        let before = conditions(&context, study, "before", &study.before, &inputs[inputs.len() - 1])?;

        let mut columns: Vec<Field> = shown.iter().map(|place| fields[*place].clone()).collect();
        columns.extend((motion.modes.len() > 1).then(|| Field::new("mode", DataType::Utf8, false)));
        columns.extend(study.scores.iter().map(|(name, score)| {
            let data_type = match score.list(motion.times.len()) {
                Some(width) => DataType::FixedSizeList(item(), width as i32),
                None => DataType::Float64,
            };
            Field::new(name, data_type, true)
        }));
        columns.push(number("margin"));
        columns.push(Field::new("ended", DataType::Float64, true));
        columns.push(Field::new("limit", DataType::Utf8, true));
        let schema = Arc::new(Schema::new(columns));
        let after = conditions(&context, study, "after", &study.after, &schema)?;
        let bins = study.histograms.iter().enumerate().map(|(place, histogram)| {
            Bins::new(histogram, &schema)
                .map_err(|error| error.on_line(study.line(&format!("keep.histograms.{place}"))))
        });
        let bins = bins.collect::<Result<Vec<_>, _>>()?;
        if let Some((place, message)) = first_repeated(&bins) {
            return Err(StudyError::description(message).on_line(study.line(&format!("keep.histograms.{place}"))));
        }
        let (name, signs) = (machine.model().name, motion.modes.first().map(|(signs, _)| signs.as_str()));
        let identity = format!(
            "{name}\n{:?}\nequations, guesses, loads and functions: {:016x}\nmode: {signs:?}\n{study:#?}\n",
            motion.defaults, motion.fingerprint,
        );
        let kept = match &study.best {
            _ if study.no_rows => Kept::None,
            None => Kept::All,
            Some((count, by)) => {
                let best = Best::new(*count, by, &schema);
                Kept::Best(best.map_err(|error| error.on_line(study.line("keep.by")))?)
            }
        };
        #[rustfmt::skip]
        let prepared = Self {
            machine, motion, sampler, sampled, constants, derived, inputs, sources, before, shown, schema, after, bins, rows,
            kept, identity,
        };
        Ok(prepared)
    }
}

fn conditions(
    context: &SessionContext,
    study: &Study,
    key: &str,
    texts: &[String],
    schema: &Schema,
) -> Result<Vec<Formula>, StudyError> {
    let compiled = texts.iter().enumerate().map(|(place, text)| {
        let line = study.line(&format!("conditions.{key}.{place}"));
        Formula::condition(context, text, schema).map_err(|error| error.on_line(line))
    });
    compiled.collect()
}

/// An error if a sampled name neither is a parameter of the mechanism nor occurs in the formula of a derived column.
fn names_are_known(study: &Study, model: &Model) -> Result<(), StudyError> {
    let known = || model.parameters.iter().map(|parameter| parameter.name);
    for (name, _) in &study.parameters {
        let stands_in = |text: &String| text.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == name);
        if !known().any(|other| other == name) && !study.derived.iter().any(|(_, text)| stands_in(text)) {
            let message = unknown("parameter", name, known());
            return Err(StudyError::description(message).on_line(study.line(&format!("parameters.{name}"))));
        }
    }
    Ok(())
}

/// An error if two columns have the same name.
fn names_are_free(study: &Study) -> Result<(), StudyError> {
    let parameters = study.parameters.iter().map(|(name, _)| ("parameters", name));
    let derived = study.derived.iter().map(|(name, _)| ("derived", name));
    let scores = study.scores.iter().map(|(name, _)| ("scores", name));
    let mut known: Vec<&str> = OWN.to_vec();
    for (table, name) in parameters.chain(derived).chain(scores) {
        if known.contains(&name.as_str()) {
            let message = format!("there is a column `{name}` already; choose another name");
            return Err(StudyError::description(message).on_line(study.line(&format!("{table}.{name}"))));
        }
        known.push(name);
    }
    Ok(())
}
