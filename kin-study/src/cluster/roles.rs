//! Schedulers and workers.

use super::MESSAGE;
use super::function::Function;
use super::submission::known;
use crate::engine::Watch;
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
use std::io::{self, BufRead, BufReader, Write};
use std::net::{IpAddr, SocketAddr, TcpListener, TcpStream, ToSocketAddrs};
use std::num::NonZero;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// Between two signs of life of a worker, in seconds.
pub(super) const HEARTBEAT: u64 = 2;
/// After how many seconds without one a worker counts as lost.
const LOST: u64 = 10;
/// How long a client waits for the first worker.
const WAIT: Duration = Duration::from_secs(20);

/// Where a scheduler or a worker listens.
#[derive(Clone, Debug)]
pub struct Listen {
    /// The address of the interface; the loopback interface hears this machine alone.
    pub bind: IpAddr,
    /// The name by which the others reach this machine; the address where there is none.
    pub host: Option<String>,
    /// The port; 0 for any that is free.
    pub port: u16,
}

impl Listen {
    fn host(&self) -> String {
        self.host.clone().unwrap_or_else(|| self.bind.to_string())
    }
}

/// What went wrong at an address.
fn lost(at: impl Display) -> impl Fn(BallistaError) -> StudyError {
    move |error| StudyError::Cluster(format!("{at}: {error}"))
}

/// A session that knows the function.
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

/// Runs a scheduler until the process ends, and says where it listens. It keeps no rows, and what clients have finished stays
/// with them.
///
/// # Errors
/// Where it cannot listen there.
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
        external_host: listen.host(),
        bind_host: listen.bind.to_string(),
        bind_port: address.port(),
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
    /// The scheduler knows it, or is about to.
    Joining,
}

/// Runs a worker for the scheduler at `host:port` with so many threads, until the process is told to end (Ctrl-C, SIGTERM). It
/// waits for a scheduler that does not answer yet.
///
/// # Errors
/// Where it cannot listen there, where the scheduler is another program, and where something else answers.
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
    let (scheduler_host, scheduler_port) = parts(scheduler)?;
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
        external_host: Some(listen.host()),
        port,
        grpc_port,
        scheduler_host,
        scheduler_port,
        scheduler_connect_timeout_seconds: WAIT.as_secs() as u16,
        vcores: threads.get(),
        task_scheduling_policy: TaskSchedulingPolicy::PushStaged,
        work_dir: Some(directory.path().to_string_lossy().into_owned()),
        job_data_ttl_seconds: 600,
        job_data_clean_up_interval_seconds: 60,
        grpc_max_decoding_message_size: MESSAGE,
        grpc_max_encoding_message_size: MESSAGE,
        executor_heartbeat_interval_seconds: HEARTBEAT,
        override_function_registry: Some(Arc::new(registry(function))),
        override_config_producer: Some(configurations()),
        ..ExecutorProcessConfig::default()
    };
    runtime.block_on(start_executor_process(Arc::new(config))).map_err(lost(scheduler))
}

/// The port of a worker and the next one; two that are free for port 0.
fn ports(listen: &Listen) -> io::Result<[u16; 2]> {
    if listen.port != 0 {
        return Ok([listen.port, listen.port.saturating_add(1)]);
    }
    let free = [0; 2].map(|port| TcpListener::bind(SocketAddr::new(listen.bind, port)));
    let [one, other] = free;
    Ok([one?.local_addr()?.port(), other?.local_addr()?.port()])
}

/// Host and port.
fn parts(address: &str) -> Result<(String, u16), StudyError> {
    let found = address.rsplit_once(':').and_then(|(host, port)| Some((host.to_owned(), port.parse().ok()?)));
    found.ok_or_else(|| StudyError::description(format!("`{address}` is no address of a scheduler: write HOST:PORT")))
}

/// A scheduler and a worker within this process; where the scheduler listens.
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

/// Waits until a scheduler has workers.
pub(super) fn ready(scheduler: &str, watch: &Watch) -> Result<(), StudyError> {
    let (host, port) = parts(scheduler)?;
    let began = Instant::now();
    loop {
        match ask(&host, port) {
            Ok(true) => return Ok(()),
            Err(Silence::SomethingElse) => return Err(something_else(scheduler)),
            Err(Silence::Nobody(error)) => {
                return Err(StudyError::Cluster(format!("no scheduler answers at {scheduler}: {error}")));
            }
            Ok(false) if began.elapsed() > WAIT || watch.stop.load(Ordering::Relaxed) => {
                let message = format!("{scheduler} has no workers; start some: `worker --scheduler {scheduler}`");
                return Err(StudyError::Cluster(message));
            }
            Ok(false) => std::thread::sleep(Duration::from_millis(200)),
        }
    }
}

/// Why no scheduler answers.
enum Silence {
    Nobody(io::Error),
    SomethingElse,
}

fn something_else(scheduler: &str) -> StudyError {
    StudyError::Cluster(format!("what answers at {scheduler} is no scheduler"))
}

/// Whether the scheduler at an address has workers.
fn ask(host: &str, port: u16) -> Result<bool, Silence> {
    let mut last = io::Error::new(io::ErrorKind::NotFound, "no such host");
    for address in (host, port).to_socket_addrs().map_err(Silence::Nobody)? {
        match TcpStream::connect_timeout(&address, Duration::from_secs(5)) {
            Ok(stream) => return has_workers(stream, host),
            Err(error) => last = error,
        }
    }
    Err(Silence::Nobody(last))
}

/// What a scheduler says of itself by HTTP: 200 if it has workers, 503 if it has none.
fn has_workers(mut stream: TcpStream, host: &str) -> Result<bool, Silence> {
    let mut line = String::new();
    let mut answer = || {
        stream.set_read_timeout(Some(Duration::from_secs(5)))?;
        write!(stream, "GET /readyz HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n")?;
        BufReader::new(&stream).read_line(&mut line)
    };
    answer().map_err(Silence::Nobody)?;
    match line.split_whitespace().nth(1) {
        Some("200") => Ok(true),
        Some("503") => Ok(false),
        _ => Err(Silence::SomethingElse),
    }
}
