//! Plans that a scheduler hands to its workers.

use super::MESSAGE;
use crate::error::StudyError;
use crate::rows::context;
use ballista_core::config::BallistaConfig;
use ballista_core::execution_plans::execute_physical_plan;
use ballista_core::extension::SessionConfigExt;
use datafusion::arrow::datatypes::{DataType, Field, Schema};
use datafusion::arrow::record_batch::RecordBatch;
use datafusion::datasource::MemTable;
use datafusion::error::DataFusionError;
use datafusion::logical_expr::{ScalarUDF, col, lit};
use datafusion::physical_plan::ExecutionPlan;
use datafusion::physical_plan::common::collect;
use datafusion::prelude::SessionConfig;
use datafusion_proto::protobuf::PhysicalPlanNode;
use std::sync::Arc;
use std::time::Duration;

/// How long a scheduler may take to read a plan.
const READ: Duration = Duration::from_secs(3);

/// The result of a plan that the workers of a scheduler execute.
pub(super) async fn submitted(
    scheduler: &str,
    session: &str,
    plan: Arc<dyn ExecutionPlan>,
) -> Result<Vec<RecordBatch>, DataFusionError> {
    let config = SessionConfig::new_with_ballista().with_ballista_grpc_client_max_message_size(MESSAGE as usize);
    let codec = config.ballista_physical_extension_codec();
    let (url, settings): (String, BallistaConfig) = (format!("http://{scheduler}"), config.ballista_config());
    let session = session.to_owned();
    let stream =
        execute_physical_plan::<PhysicalPlanNode>(url, &settings, plan, codec.as_ref(), session, config).await?;
    collect(stream).await
}

/// Checks that a scheduler has a function, by a plan that evaluates the function for no rows.
///
/// # Errors
/// The scheduler is another program.
pub(super) async fn known(scheduler: &str, function: &ScalarUDF) -> Result<(), StudyError> {
    let number = |name| Field::new(name, DataType::UInt64, false);
    let schema = Arc::new(Schema::new(vec![number("start"), number("end")]));
    let table = MemTable::try_new(Arc::clone(&schema), vec![vec![RecordBatch::new_empty(schema)]])?;
    let found = function.call(vec![lit(""), col("start"), col("end")]).alias("found");
    let plan = context(1).read_table(Arc::new(table))?.select(vec![found])?.create_physical_plan().await?;
    // It answers at once if it cannot read the plan, and otherwise as soon as there are workers.
    match tokio::time::timeout(READ, submitted(scheduler, "kin-study-worker", plan)).await {
        Ok(Err(error)) if is_foreign(&error, function.name()) => Err(foreign(scheduler)),
        _ => Ok(()),
    }
}

/// Whether an error means that a member of the cluster is another program: the error of a scheduler names the unknown
/// function, that of a worker only says that it cannot read the task.
pub(super) fn is_foreign(error: &DataFusionError, function: &str) -> bool {
    let text = error.strip_backtrace();
    let unknown = ["no UDF named", "not provided for scalar function"];
    text.contains(function) && unknown.iter().any(|words| text.contains(words))
        || text.contains("task could not be prepared or was rejected")
}

/// The error for a member that is another program.
pub(super) fn foreign(scheduler: &str) -> StudyError {
    StudyError::Cluster(format!(
        "{scheduler}: the scheduler or a worker is another program, or another build of it; start the same file everywhere"
    ))
}
