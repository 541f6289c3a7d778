//! The best rows, in an order that is written as in SQL.

use super::formula::{compared_with_nulls, compiled, context, null_for_nan, refuse_random};
use crate::error::StudyError;
use datafusion::arrow::compute::{SortColumn, SortOptions, lexsort_to_indices, take_record_batch};
use datafusion::arrow::datatypes::SchemaRef;
use datafusion::arrow::error::ArrowError;
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::common::DFSchema;
use datafusion::common::tree_node::{Transformed, TreeNode};
use datafusion::dataframe::DataFrame;
use datafusion::datasource::MemTable;
use datafusion::error::DataFusionError;
use datafusion::execution::context::SessionContext;
use datafusion::logical_expr::LogicalPlan;
use datafusion::physical_expr::PhysicalExpr;
use datafusion::prelude::Expr;
use futures::FutureExt;
use std::sync::Arc;

/// Largest number of best rows: they are held in memory.
const MAX_BEST_ROWS: usize = 1 << 31;

/// Which rows are kept.
#[derive(Clone, Debug)]
pub(crate) enum Kept {
    /// None: only histograms are wanted.
    None,
    /// All that meet the conditions.
    All,
    /// The best of those that meet the conditions.
    Best(Best),
}

/// The first `count` rows in an order.
#[derive(Clone, Debug)]
pub(crate) struct Best {
    count: usize,
    by: String,
    keys: Vec<(Arc<dyn PhysicalExpr>, SortOptions)>,
}

impl Best {
    /// The first `count` rows of a table with these columns in the order `by`; rows that are equal in it are in the
    /// order of their numbers.
    pub(super) fn new(count: usize, by: &str, schema: &SchemaRef) -> Result<Self, StudyError> {
        let wrong = |error: DataFusionError| StudyError::description(format!("`{by}`: {}", error.strip_backtrace()));
        if !(1..=MAX_BEST_ROWS).contains(&count) {
            let message = format!("the best 1 to {MAX_BEST_ROWS} rows can be kept; to keep none, write `rows = false`");
            return Err(StudyError::description(message));
        }
        let best = Self { count, by: by.to_owned(), keys: Vec::new() };
        let context = context(1);
        let empty = MemTable::try_new(Arc::clone(schema), vec![vec![]]).map_err(wrong)?;
        context.register_table("study", Arc::new(empty)).map_err(wrong)?;
        // A plan over tables in memory is ready at once.
        let planned = context.sql(&best.sql("study")).now_or_never();
        let unplanned = || DataFusionError::Plan("it is no order".to_owned());
        let planned = planned.unwrap_or_else(|| Err(unplanned())).map_err(wrong)?;
        let order = order(planned.logical_plan()).ok_or_else(|| wrong(unplanned()))?;
        let table = DFSchema::try_from_qualified_schema("study", schema).map_err(wrong)?;
        let key = |key: &datafusion::logical_expr::SortExpr| {
            refuse_random(by, &key.expr)?;
            let options = SortOptions { descending: !key.asc, nulls_first: key.nulls_first };
            let value = valued(key.expr.clone(), &table).map_err(wrong)?;
            Ok((compiled(&context, value, &table).map_err(wrong)?, options))
        };
        let keys = order.iter().map(key).collect::<Result<_, StudyError>>()?;
        Ok(Self { keys, ..best })
    }

    /// The SQL query for these rows of a table.
    pub(crate) fn sql(&self, table: &str) -> String {
        format!("SELECT * FROM {table} ORDER BY {}, \"row\" LIMIT {}", self.by, self.count)
    }

    /// The best rows of a batch, in order. If it has no more rows than are wanted, they stay in their own order.
    pub(crate) fn of(&self, batch: RecordBatch) -> Result<RecordBatch, StudyError> {
        if batch.num_rows() <= self.count {
            return Ok(batch);
        }
        let engine = |error: ArrowError| StudyError::Engine(Box::new(error.into()));
        let column = |(key, options): &(Arc<dyn PhysicalExpr>, SortOptions)| {
            let values = key.evaluate(&batch)?.into_array(batch.num_rows())?;
            Ok(SortColumn { values, options: Some(*options) })
        };
        let columns = self.keys.iter().map(column).collect::<Result<Vec<_>, DataFusionError>>()?;
        let places = lexsort_to_indices(&columns, Some(self.count)).map_err(engine)?;
        take_record_batch(&batch, &places).map_err(engine)
    }
}

impl Kept {
    /// The SQL query for the rows of a table that are kept.
    pub(crate) fn sql(&self, table: &str) -> String {
        match self {
            Self::Best(best) => best.sql(table),
            Self::None | Self::All => format!("SELECT * FROM {table}"),
        }
    }

    /// The rows of a batch that may be kept: they include all of its rows that are kept of any table with this batch in
    /// it.
    pub(crate) fn of(&self, batch: RecordBatch) -> Result<RecordBatch, StudyError> {
        match self {
            Self::None => Ok(batch.slice(0, 0)),
            Self::All => Ok(batch),
            Self::Best(best) => best.of(batch),
        }
    }
}

/// The value of an expression by which rows are ordered, null where it has none: such rows come last.
fn valued(expression: Expr, schema: &DFSchema) -> Result<Expr, DataFusionError> {
    null_for_nan(compared_with_nulls(expression, schema)?, schema)
}

/// The rows of a query of [`Kept::sql`]; those without a value come last in its order.
pub(crate) async fn selected(context: &SessionContext, sql: &str) -> Result<DataFrame, DataFusionError> {
    let plan = context.sql(sql).await?.into_unoptimized_plan();
    let plan = plan.transform_up(|node| match node {
        LogicalPlan::Sort(mut sort) => {
            for key in &mut sort.expr {
                key.expr = valued(key.expr.clone(), sort.input.schema())?;
            }
            Ok(Transformed::yes(LogicalPlan::Sort(sort)))
        }
        other => Ok(Transformed::no(other)),
    })?;
    Ok(DataFrame::new(context.state(), plan.data))
}

/// The outermost order of a plan.
fn order(plan: &LogicalPlan) -> Option<&[datafusion::logical_expr::SortExpr]> {
    match plan {
        LogicalPlan::Sort(sort) => Some(&sort.expr),
        LogicalPlan::Limit(limit) => order(&limit.input),
        _ => None,
    }
}
