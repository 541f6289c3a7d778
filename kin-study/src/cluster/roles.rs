//! Schedulers and workers.

use super::MESSAGE;
use super::function::Function;
use super::presence::{Silence, WAIT, ask, parts, something_else};
use super::submission::known;
use crate::error::StudyError;
use ballista_core::config::TaskSchedulingPolicy;
use ballista_core::error::BallistaError;
use ballista_core::extension::SessionConfigExt;
use ballista_core::registry::BallistaFunctionRegistry;
use ballista_core::serde::BallistaCodec;
use ballista_core::serde::protobuf::scheduler_grpc_client::SchedulerGrpcClient;
use ballista_core::utils::default_session_builder;
use ballista_core::{ConfigProducer, RuntimeProducer};
use ballista_executor::executor_process::{ExecutorProcessConfig, start_executor_process};
use ballista_executor::new_standalone_executor_from_builder;
use ballista_scheduler::SessionBuilder;
use ballista_scheduler::cluster::BallistaCluster;
use ballista_scheduler::config::SchedulerConfig;
use ballista_scheduler::scheduler_process::{create_scheduler, start_grpc_service_with_listener};
use ballista_scheduler::standalone::new_standalone_scheduler_with_builder;
use datafusion::execution::runtime_env::RuntimeEnvBuilder;
use datafusion::logical_expr::ScalarUDF;
use datafusion::prelude::SessionConfig;
use datafusion_proto::protobuf::{LogicalPlanNode, PhysicalPlanNode};
use kin_runtime::Mechanism;
use std::fmt::Display;
use std::io;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::num::NonZero;
use std::sync::Arc;
use std::time::Duration;

/// Seconds between two heartbeats of a worker.
pub(super) const HEARTBEAT: u64 = 2;
/// Seconds without a heartbeat after which a worker counts as lost.
const LOST: u64 = 10;
/// Seconds after which the data of a finished job are removed; its state, and data that nobody removed, stay ten times
/// as long.
const KEPT: u64 = 60;

/// Where a scheduler or a worker listens.
#[derive(Clone, Debug)]
pub struct Listen {
    /// The address of the interface. On the loopback interface, only processes of this machine can connect.
    pub bind: IpAddr,
    /// The name by which other machines reach this one; `None` stands for the address in `bind`. It is required if that
    /// address stands for all interfaces (0.0.0.0).
    pub host: Option<String>,
    /// The port; 0 for any free one. A worker also takes the next port or, if this is 0, another free one.
    pub port: u16,
}

impl Listen {
    fn host(&self) -> Result<String, StudyError> {
        match &self.host {
            Some(host) => Ok(host.clone()),
            None if self.bind.is_unspecified() => Err(StudyError::description(format!(
                "{} stands for all interfaces of this machine: say by which name the others reach it, --host HOST",
                self.bind
            ))),
            None => Ok(self.bind.to_string()),
        }
    }
}

/// The error of this study for an error of Ballista at an address.
fn lost(at: impl Display) -> impl Fn(BallistaError) -> StudyError {
    move |error| StudyError::Cluster(format!("{at}: {error}"))
}

/// Makes sessions in which the function is registered.
fn sessions(function: &ScalarUDF) -> SessionBuilder {
    let function = Arc::new(function.clone());
    Arc::new(move |config| {
        let mut state = default_session_builder(config)?;
        datafusion::execution::FunctionRegistry::register_udf(&mut state, Arc::clone(&function))?;
        Ok(state)
    })
}

fn registry(function: &ScalarUDF) -> BallistaFunctionRegistry {
    let mut registry = BallistaFunctionRegistry::default();
    registry.scalar_functions.insert(function.name().to_owned(), Arc::new(function.clone()));
    registry
}

fn configurations() -> ConfigProducer {
    Arc::new(|| SessionConfig::new_with_ballista().with_ballista_grpc_client_max_message_size(MESSAGE as usize))
}

/// Runs a scheduler until the process ends; calls `listens` with its address as soon as it listens. It stores no rows:
/// finished rows are in the directory of the client.
///
/// # Errors
/// It cannot listen at this address.
pub fn scheduler<M>(listen: &Listen, mut listens: impl FnMut(SocketAddr)) -> Result<(), StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    schedule(&Function::of::<M>()?, listen, &mut listens)
}

/// Not generic, so that it is compiled once.
fn schedule(function: &ScalarUDF, listen: &Listen, listens: &mut dyn FnMut(SocketAddr)) -> Result<(), StudyError> {
    let address = SocketAddr::new(listen.bind, listen.port);
    let failed = |error: io::Error| StudyError::Cluster(format!("{address}: {error}"));
    let listener = TcpListener::bind(address).map_err(failed)?;
    listener.set_nonblocking(true).map_err(failed)?;
    let address = listener.local_addr().map_err(failed)?;
    let config = SchedulerConfig {
        external_host: listen.host()?,
        bind_host: listen.bind.to_string(),
        bind_port: address.port(),
        finished_job_data_clean_up_interval_seconds: KEPT,
        finished_job_state_clean_up_interval_seconds: 10 * KEPT,
        executor_timeout_seconds: LOST,
        expire_dead_executor_interval_seconds: HEARTBEAT,
        no_executors_grace_period_seconds: LOST,
        grpc_server_max_decoding_message_size: MESSAGE,
        grpc_server_max_encoding_message_size: MESSAGE,
        grpc_client_max_message_size: MESSAGE,
        override_session_builder: Some(sessions(function)),
        override_config_producer: Some(configurations()),
        ..SchedulerConfig::default()
    };
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().map_err(failed)?;
    runtime.block_on(async {
        let cluster = BallistaCluster::new_from_config(&config).await.map_err(lost(address))?;
        let scheduler = create_scheduler::<LogicalPlanNode, PhysicalPlanNode>(cluster, Arc::new(config));
        let scheduler = scheduler.await.map_err(lost(address))?;
        let listener = tokio::net::TcpListener::from_std(listener).map_err(failed)?;
        listens(address);
        start_grpc_service_with_listener(listener, scheduler).await.map_err(lost(address))
    })
}

/// What a worker is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// No scheduler answers yet.
    Waiting,
    /// The scheduler answers, and the worker registers with it.
    Joining,
}

/// Runs a worker with `threads` threads for the scheduler at `host:port` until Ctrl-C or SIGTERM. While no scheduler
/// answers, it waits; `stands` is called with what it is doing.
///
/// # Errors
/// It cannot listen at this address, the scheduler is another program, or the program that answers is no scheduler.
pub fn worker<M>(
    scheduler: &str,
    listen: &Listen,
    threads: NonZero<usize>,
    mut stands: impl FnMut(Standing),
) -> Result<(), StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    work(&Function::of::<M>()?, scheduler, listen, threads, &mut stands)
}

fn work(
    function: &ScalarUDF,
    scheduler: &str,
    listen: &Listen,
    threads: NonZero<usize>,
    stands: &mut dyn FnMut(Standing),
) -> Result<(), StudyError> {
    let failed = |error: io::Error| StudyError::Cluster(format!("a worker cannot start: {error}"));
    let ((scheduler_host, scheduler_port), host) = (parts(scheduler)?, listen.host()?);
    if listen.port != 0 {
        TcpListener::bind(SocketAddr::new(listen.bind, listen.port)).map_err(failed)?;
    }
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().map_err(failed)?;
    for waited in 0.. {
        match ask(&scheduler_host, scheduler_port) {
            Ok(_) => break,
            Err(Silence::Nobody(_)) if waited == 0 => stands(Standing::Waiting),
            Err(Silence::Nobody(_)) => {}
            Err(Silence::SomethingElse) => return Err(something_else(scheduler)),
        }
        std::thread::sleep(Duration::from_millis(500));
    }
    runtime.block_on(known(scheduler, function))?;
    stands(Standing::Joining);
    let directory = tempfile::Builder::new().prefix("kin-study-worker-").tempdir().map_err(failed)?;
    let [port, grpc_port] = ports(listen).map_err(failed)?;
    let config = ExecutorProcessConfig {
        bind_host: listen.bind.to_string(),
        external_host: Some(host),
        port,
        grpc_port,
        scheduler_host,
        scheduler_port,
        scheduler_connect_timeout_seconds: WAIT.as_secs() as u16,
        vcores: threads.get(),
        task_scheduling_policy: TaskSchedulingPolicy::PushStaged,
        work_dir: Some(directory.path().to_string_lossy().into_owned()),
        job_data_ttl_seconds: 10 * KEPT,
        job_data_clean_up_interval_seconds: KEPT,
        grpc_max_decoding_message_size: MESSAGE,
        grpc_max_encoding_message_size: MESSAGE,
        executor_heartbeat_interval_seconds: HEARTBEAT,
        override_function_registry: Some(Arc::new(registry(function))),
        override_config_producer: Some(configurations()),
        ..ExecutorProcessConfig::default()
    };
    runtime.block_on(start_executor_process(Arc::new(config))).map_err(lost(scheduler))
}

/// The port of a worker and the next one; for port 0 two free ones.
fn ports(listen: &Listen) -> io::Result<[u16; 2]> {
    if listen.port != 0 {
        return Ok([listen.port, listen.port.saturating_add(1)]);
    }
    let free = [0; 2].map(|port| TcpListener::bind(SocketAddr::new(listen.bind, port)));
    let [worker, next] = free;
    Ok([worker?.local_addr()?.port(), next?.local_addr()?.port()])
}

/// Starts a scheduler and a worker within this process; returns the address of the scheduler.
pub(super) async fn embedded(function: &ScalarUDF, threads: NonZero<usize>) -> Result<String, StudyError> {
    let failed = lost("within this process");
    let codec = BallistaCodec::default();
    let address = new_standalone_scheduler_with_builder(sessions(function), configurations(), codec.clone());
    let scheduler = format!("127.0.0.1:{}", address.await.map_err(&failed)?.port());
    let client = SchedulerGrpcClient::connect(format!("http://{scheduler}")).await;
    let client = client.map_err(|error| StudyError::Cluster(format!("{scheduler}: {error}")))?;
    let runtimes: RuntimeProducer = Arc::new(|_| RuntimeEnvBuilder::new().build().map(Arc::new));
    let worker = new_standalone_executor_from_builder(
        client,
        threads.get(),
        configurations(),
        runtimes,
        codec,
        registry(function),
    );
    worker.await.map_err(&failed)?;
    Ok(scheduler)
}
