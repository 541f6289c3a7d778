//! SQL expressions over the columns of a study: derived parameters and conditions.

use crate::error::StudyError;
use datafusion::arrow::array::{Array, ArrayRef, AsArray, BooleanArray, Float64Array, new_null_array};
use datafusion::arrow::compute::{cast, concat, filter_record_batch, prep_null_mask_filter};
use datafusion::arrow::datatypes::{DataType, Float64Type, Schema};
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::common::DFSchema;
use datafusion::common::tree_node::{Transformed, TreeNode, TreeNodeRecursion};
use datafusion::error::DataFusionError;
use datafusion::execution::context::SessionContext;
use datafusion::functions::math::expr_fn::isnan;
use datafusion::logical_expr::simplify::SimplifyContext;
use datafusion::logical_expr::{BinaryExpr, ExprSchemable, Operator, Volatility, lit, when};
use datafusion::optimizer::simplify_expressions::ExprSimplifier;
use datafusion::physical_expr::PhysicalExpr;
use datafusion::prelude::{Expr, SessionConfig};
use datafusion::scalar::ScalarValue;
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
        let wrong = |error: DataFusionError| StudyError::description(format!("`{text}`: {}", error.strip_backtrace()));
        let table = DFSchema::try_from(schema.clone()).map_err(wrong)?;
        let expression = context.parse_sql_expr(text, &table).map_err(wrong)?;
        refuse_random(text, &expression)?;
        let expression = compared_with_nulls(expression, &table).map_err(wrong)?;
        let expression = compiled(context, expression, &table).map_err(wrong)?;
        let found = expression.data_type(schema).map_err(wrong)?;
        // What fails without any row fails in all rows.
        expression.evaluate(&RecordBatch::new_empty(Arc::new(schema.clone()))).map_err(wrong)?;
        let fits = if to == DataType::Boolean { found == to } else { found.is_numeric() };
        match fits {
            true => Ok(Self { expression, to }),
            false if to == DataType::Boolean => {
                Err(StudyError::description(format!("`{text}` is no condition; one would be `l1 < l2`")))
            }
            false => Err(StudyError::description(format!("`{text}` is no number"))),
        }
    }

    /// Its value in every row; null where it has none, as the root of a negative number.
    pub(crate) fn values(&self, batch: &RecordBatch) -> Result<ArrayRef, StudyError> {
        match (self.evaluate(batch), batch.num_rows()) {
            (Ok(values), _) => Ok(values),
            (Err(error), 0) => Err(StudyError::Engine(Box::new(error))),
            (Err(_), 1) => Ok(new_null_array(&self.to, 1)),
            // A function that fails in one row fails for all that it is given.
            (Err(_), count) => {
                let half = count / 2;
                let [first, second] =
                    [batch.slice(0, half), batch.slice(half, count - half)].map(|part| self.values(&part));
                let values = concat(&[first?.as_ref(), second?.as_ref()]);
                values.map_err(|error| StudyError::Engine(Box::new(error.into())))
            }
        }
    }

    fn evaluate(&self, batch: &RecordBatch) -> Result<ArrayRef, DataFusionError> {
        let values = self.expression.evaluate(batch)?.into_array(batch.num_rows())?;
        let values = if values.data_type() == &self.to { values } else { cast(&values, &self.to)? };
        Ok(if self.to == DataType::Float64 { without_nan(&values) } else { values })
    }
}

/// An expression that is compiled for one schema. It is simplified first, because the engine evaluates some functions, such
/// as `coalesce`, only as the expressions that they stand for.
pub(super) fn compiled(
    context: &SessionContext,
    expression: Expr,
    table: &DFSchema,
) -> Result<Arc<dyn PhysicalExpr>, DataFusionError> {
    let known = SimplifyContext::builder().with_schema(Arc::new(table.clone()));
    let known = known.with_config_options(Arc::clone(context.state().config_options()));
    let simplifier = ExprSimplifier::new(known.build());
    let expression = simplifier.simplify(simplifier.coerce(expression, table)?)?;
    context.create_physical_expr(expression, table)
}

/// The numbers of a column, with null in place of NaN. The engine compares NaN as the greatest of all numbers, and files
/// leave it out of the least and the greatest value that they store of a column.
pub(super) fn without_nan(column: &ArrayRef) -> ArrayRef {
    let values = column.as_primitive::<Float64Type>();
    Arc::new(Float64Array::from_iter(values.iter().map(|value| value.filter(|value| !value.is_nan()))))
}

/// A number with null in place of NaN; anything else as it is.
pub(super) fn null_for_nan(expression: Expr, schema: &DFSchema) -> Result<Expr, DataFusionError> {
    match expression.get_type(schema) {
        Ok(DataType::Float64) => when(isnan(expression.clone()), lit(ScalarValue::Float64(None))).otherwise(expression),
        _ => Ok(expression),
    }
}

/// True for the operators that compare two values.
fn compares(operator: Operator) -> bool {
    use Operator::{Eq, Gt, GtEq, IsDistinctFrom, IsNotDistinctFrom, Lt, LtEq, NotEq};
    matches!(operator, Eq | NotEq | Lt | LtEq | Gt | GtEq | IsDistinctFrom | IsNotDistinctFrom)
}

/// Functions that ask whether their arguments have values.
const ASK_FOR_VALUES: [&str; 4] = ["coalesce", "nvl", "nvl2", "nullif"];

/// The expression with null in place of NaN wherever it compares numbers or asks for values: what has no value meets no
/// condition.
pub(super) fn compared_with_nulls(expression: Expr, schema: &DFSchema) -> Result<Expr, DataFusionError> {
    let known = |part: Box<Expr>| null_for_nan(*part, schema).map(Box::new);
    let compared = expression.transform_up(|part| match part {
        Expr::BinaryExpr(BinaryExpr { left, op, right }) if compares(op) => {
            Ok(Transformed::yes(Expr::BinaryExpr(BinaryExpr { left: known(left)?, op, right: known(right)? })))
        }
        Expr::Between(mut between) => {
            between.expr = known(between.expr)?;
            between.low = known(between.low)?;
            between.high = known(between.high)?;
            Ok(Transformed::yes(Expr::Between(between)))
        }
        Expr::IsNull(part) => Ok(Transformed::yes(Expr::IsNull(known(part)?))),
        Expr::IsNotNull(part) => Ok(Transformed::yes(Expr::IsNotNull(known(part)?))),
        Expr::ScalarFunction(mut call) if ASK_FOR_VALUES.contains(&call.func.name()) => {
            call.args = call.args.into_iter().map(|part| null_for_nan(part, schema)).collect::<Result<_, _>>()?;
            Ok(Transformed::yes(Expr::ScalarFunction(call)))
        }
        Expr::InList(mut list) => {
            list.expr = known(list.expr)?;
            Ok(Transformed::yes(Expr::InList(list)))
        }
        other => Ok(Transformed::no(other)),
    })?;
    Ok(compared.data)
}

/// An error if a function gives another value in every run.
pub(super) fn refuse_random(text: &str, expression: &Expr) -> Result<(), StudyError> {
    let why = |function: String| {
        format!("`{text}`: `{function}` gives another value in every run; rows must be the same in all runs")
    };
    first_that_varies(expression).map_or(Ok(()), |function| Err(StudyError::description(why(function))))
}

/// The name of the first function whose value does not only depend on its arguments.
fn first_that_varies(expression: &Expr) -> Option<String> {
    let mut found = None;
    let visited = expression.apply(|part| match part {
        Expr::ScalarFunction(call) if call.func.signature().volatility != Volatility::Immutable => {
            found = Some(format!("{}()", call.func.name()));
            Ok(TreeNodeRecursion::Stop)
        }
        _ => Ok(TreeNodeRecursion::Continue),
    });
    debug_assert!(visited.is_ok(), "the visit of an expression does not fail");
    found
}

/// The rows that meet all conditions; a condition that is null is not met.
pub(crate) fn meeting(batch: RecordBatch, conditions: &[Formula]) -> Result<RecordBatch, StudyError> {
    let mut batch = batch;
    for condition in conditions {
        let values = condition.values(&batch)?;
        let Some(mask) = values.as_any().downcast_ref::<BooleanArray>() else { continue };
        let mask = if mask.nulls().is_some() { prep_null_mask_filter(mask) } else { mask.clone() };
        if mask.true_count() < batch.num_rows() {
            let filtered = filter_record_batch(&batch, &mask);
            batch = filtered.map_err(|error| StudyError::Engine(Box::new(error.into())))?;
        }
    }
    Ok(batch)
}
