//! SQL expressions over the columns of a study: derived parameters and conditions.

use crate::error::StudyError;
use datafusion::arrow::array::{Array, ArrayRef, BooleanArray};
use datafusion::arrow::compute::{cast, filter_record_batch, prep_null_mask_filter};
use datafusion::arrow::datatypes::{DataType, Schema};
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::common::DFSchema;
use datafusion::execution::context::SessionContext;
use datafusion::physical_expr::PhysicalExpr;
use datafusion::prelude::SessionConfig;
use std::sync::Arc;

/// Number of rows of a piece, which are solved together, and of a batch of the engine.
pub(crate) const CHUNK: usize = 4096;

/// A context of the engine in which the case of names matters, so that `L1` and `l1` are different.
pub(crate) fn context(partitions: usize) -> SessionContext {
    let config = SessionConfig::new().with_target_partitions(partitions).with_batch_size(CHUNK);
    let config = config.set_bool("datafusion.sql_parser.enable_ident_normalization", false);
    // Nulls come last in every order, so that a design without a score is never the best one.
    SessionContext::new_with_config(config.set_str("datafusion.sql_parser.default_null_ordering", "nulls_last"))
}

/// An expression that is compiled for one schema.
#[derive(Clone, Debug)]
pub(crate) struct Formula {
    expression: Arc<dyn PhysicalExpr>,
    to: DataType,
}

impl Formula {
    /// A number that follows from columns.
    pub(crate) fn number(context: &SessionContext, text: &str, schema: &Schema) -> Result<Self, StudyError> {
        Self::new(context, text, schema, DataType::Float64)
    }

    /// A condition on columns.
    pub(crate) fn condition(context: &SessionContext, text: &str, schema: &Schema) -> Result<Self, StudyError> {
        Self::new(context, text, schema, DataType::Boolean)
    }

    fn new(context: &SessionContext, text: &str, schema: &Schema, to: DataType) -> Result<Self, StudyError> {
        let wrong = |error: datafusion::error::DataFusionError| {
            StudyError::description(format!("`{text}`: {}", error.strip_backtrace()))
        };
        let table = DFSchema::try_from(schema.clone()).map_err(wrong)?;
        let expression = context.parse_sql_expr(text, &table).map_err(wrong)?;
        let expression = context.create_physical_expr(expression, &table).map_err(wrong)?;
        let found = expression.data_type(schema).map_err(wrong)?;
        let fits = if to == DataType::Boolean { found == to } else { found.is_numeric() };
        match fits {
            true => Ok(Self { expression, to }),
            false if to == DataType::Boolean => {
                Err(StudyError::description(format!("`{text}` is no condition; one would be `l1 < l2`")))
            }
            false => Err(StudyError::description(format!("`{text}` is no number"))),
        }
    }

    /// Its value in every row.
    pub(crate) fn values(&self, batch: &RecordBatch) -> Result<ArrayRef, StudyError> {
        let values = self.expression.evaluate(batch)?.into_array(batch.num_rows())?;
        if values.data_type() == &self.to {
            return Ok(values);
        }
        cast(&values, &self.to).map_err(|error| StudyError::Engine(Box::new(error.into())))
    }
}

/// The rows that meet all conditions; a condition that is null is not met.
pub(crate) fn meeting(batch: RecordBatch, conditions: &[Formula]) -> Result<RecordBatch, StudyError> {
    let mut batch = batch;
    for condition in conditions {
        let values = condition.values(&batch)?;
        let Some(met) = values.as_any().downcast_ref::<BooleanArray>() else { continue };
        let met = if met.nulls().is_some() { prep_null_mask_filter(met) } else { met.clone() };
        if met.true_count() < batch.num_rows() {
            let filtered = filter_record_batch(&batch, &met);
            batch = filtered.map_err(|error| StudyError::Engine(Box::new(error.into())))?;
        }
    }
    Ok(batch)
}
