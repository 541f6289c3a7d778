//! The commands of clusters.

#[cfg(feature = "cluster")]
pub(super) use with::{run_on, scheduler, worker};
#[cfg(not(feature = "cluster"))]
pub(super) use without::{run_on, scheduler, worker};

#[cfg(feature = "cluster")]
mod with {
    use crate::cli::arguments::{ClusterArgs, ListenArgs, RunArgs};
    use crate::cli::watched::ran;
    use crate::cluster::{self, Cluster, Listen, Standing};
    use crate::engine::Limits;
    use crate::error::StudyError;
    use kin_runtime::Mechanism;
    use std::net::IpAddr;
    use std::num::NonZero;
    use std::path::PathBuf;
    use std::process::ExitCode;

    pub(in crate::cli) fn run_on<M>(
        args: &RunArgs,
        cluster: ClusterArgs,
        file: &mut Option<PathBuf>,
    ) -> Result<ExitCode, StudyError>
    where
        M: Mechanism + Default + Send + Sync + 'static,
    {
        let place = match cluster.cluster {
            Some(scheduler) => Cluster::at(scheduler),
            None => Cluster::standalone(args.threads.unwrap_or_else(processors)),
        };
        let place = match cluster.tasks {
            Some(tasks) => place.tasks(tasks),
            None => place,
        };
        ran(args, file, |study, out, Limits { resume, .. }, watch| {
            cluster::run_on::<M>(&place, study, out, resume, watch)
        })
    }

    pub(in crate::cli) fn scheduler<M>(listen: ListenArgs, port: u16) -> Result<ExitCode, StudyError>
    where
        M: Mechanism + Default + Send + Sync + 'static,
    {
        warn(listen.bind);
        cluster::scheduler::<M>(&at(listen, port), |address| {
            eprintln!("scheduler at {address}; start workers: worker --scheduler {address}");
        })?;
        Ok(ExitCode::SUCCESS)
    }

    pub(in crate::cli) fn worker<M>(
        scheduler: &str,
        listen: ListenArgs,
        port: u16,
        threads: Option<NonZero<usize>>,
    ) -> Result<ExitCode, StudyError>
    where
        M: Mechanism + Default + Send + Sync + 'static,
    {
        warn(listen.bind);
        let threads = threads.unwrap_or_else(processors);
        cluster::worker::<M>(scheduler, &at(listen, port), threads, |standing| match standing {
            Standing::Waiting => eprintln!("worker waits for a scheduler at {scheduler}"),
            Standing::Joining => eprintln!("worker joins {scheduler}, threads: {threads}"),
        })?;
        eprintln!("worker ends: it was stopped, or {scheduler} counts it as lost");
        Ok(ExitCode::SUCCESS)
    }

    fn at(ListenArgs { bind, host }: ListenArgs, port: u16) -> Listen {
        Listen { bind, host, port }
    }

    fn warn(bind: IpAddr) {
        if !bind.is_loopback() {
            eprintln!("note: whoever reaches {bind} can use this process: a cluster has no password and no encryption");
        }
    }

    fn processors() -> NonZero<usize> {
        std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN)
    }
}

/// The same commands in a program that was built without clusters: each is an error that says so.
#[cfg(not(feature = "cluster"))]
#[expect(clippy::extra_unused_type_parameters, reason = "called in the same way with clusters and without")]
mod without {
    use crate::cli::arguments::{ClusterArgs, ListenArgs, RunArgs};
    use crate::error::StudyError;
    use std::num::NonZero;
    use std::path::PathBuf;
    use std::process::ExitCode;

    fn missing() -> Result<ExitCode, StudyError> {
        Err(StudyError::description(
            "this program was built without clusters: build it with kin-study's feature `cluster`",
        ))
    }

    pub(in crate::cli) fn run_on<M>(
        _: &RunArgs,
        _: ClusterArgs,
        _: &mut Option<PathBuf>,
    ) -> Result<ExitCode, StudyError> {
        missing()
    }

    pub(in crate::cli) fn scheduler<M>(_: ListenArgs, _: u16) -> Result<ExitCode, StudyError> {
        missing()
    }

    pub(in crate::cli) fn worker<M>(
        _: &str,
        _: ListenArgs,
        _: u16,
        _: Option<NonZero<usize>>,
    ) -> Result<ExitCode, StudyError> {
        missing()
    }
}
