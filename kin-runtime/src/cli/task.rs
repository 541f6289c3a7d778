//! Options that commands share, read together so that all errors are reported at once: those of one instant, and those
//! of a motion.

use super::closures::settled;
use super::engine::Engine;
use super::failure::{Failure, Ledger, zip3};
use super::followed::FollowedMotion;
use super::instants::{ArcArgs, GridArgs, Instants, RequestedInstants, instant};
use super::options::{AngleArgs, FreedomArgs, InstantArgs, SetupArgs};
use super::output::{Destination, OutputArgs};
use super::session::Session;
use super::setup::Setup;
use super::values::TimeOrAngle;
use super::watch::ProgressWatch;
use crate::measure::Measure;

/// Options of the analysis of one instant.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct AtArgs {
    #[command(flatten)]
    instant: InstantArgs,
    #[command(flatten)]
    setup: SetupArgs,
}

/// An instant to be analysed.
pub(super) struct At<'o> {
    pub(super) t: f64,
    pub(super) setup: Setup,
    pub(super) output: Destination<'o>,
}

/// How options become a setup: [`SetupArgs::apply`], or [`SetupArgs::apply_complete`] for a command that needs all
/// inputs.
type Apply = fn(&SetupArgs, &mut dyn Engine) -> Result<Setup, Failure>;

impl AtArgs {
    /// As [`SetupArgs::without_mode`].
    pub(super) fn without_mode(&self, command: &str) -> Result<(), Failure> {
        self.setup.without_mode(command)
    }

    /// Reads the options of `command`; errors go to the ledger.
    pub(super) fn read<'o>(
        &self,
        ledger: &mut Ledger,
        (command, output): (&str, &'o OutputArgs),
        apply: Apply,
        engine: &mut dyn Engine,
        session: &Session<'_>,
    ) -> Option<At<'o>> {
        let moment = ledger.take(self.instant.time(engine.model()));
        let output = ledger.take(session.destination(output, command));
        let setup = ledger.take(apply(&self.setup, engine));
        let (moment, output, setup) = zip3(moment, output, setup)?;
        let t = ledger.take(instant("--at", moment, engine, &setup))?;
        let setup = ledger.take(settled(engine, setup, t))?;
        Some(At { t, setup, output })
    }

    /// As [`read`](Self::read), for the motion that `grid` describes if its options are given; `steps` is the default number
    /// of steps.
    pub(super) fn read_motion<'o>(
        &self,
        ledger: &mut Ledger,
        (command, output): (&str, &'o OutputArgs),
        (grid, steps, freedom): (&GridArgs, usize, FreedomArgs),
        engine: &mut dyn Engine,
        session: &Session<'_>,
    ) -> Option<MotionTask<'o>> {
        if grid.is_given() {
            let requested = grid.requested(steps, engine.model());
            return motion_task(ledger, (command, output), requested, (&self.setup, freedom), engine, session);
        }
        let at = self.read(ledger, (command, output), SetupArgs::apply_complete, engine, session)?;
        let requested = RequestedInstants::Times(vec![TimeOrAngle::At(at.t)]);
        Some(MotionTask { requested, setup: Setup { least_norm: freedom.least_norm, ..at.setup }, output: at.output })
    }
}

/// Options of a motion.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct MotionArgs {
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    pub(super) angles: AngleArgs,
}

/// A motion to be followed.
pub(super) struct MotionTask<'o> {
    pub(super) requested: RequestedInstants,
    pub(super) setup: Setup,
    pub(super) output: Destination<'o>,
}

impl MotionArgs {
    /// Reads the options of `command`, whose default number of steps is `steps`, with the options `arc`; errors go to
    /// the ledger.
    pub(super) fn read<'o>(
        &self,
        ledger: &mut Ledger,
        (command, output): (&str, &'o OutputArgs),
        (steps, arc): (usize, ArcArgs),
        engine: &mut dyn Engine,
        session: &Session<'_>,
    ) -> Option<MotionTask<'o>> {
        let requested = self.grid.requested(steps, engine.model()).and_then(|requested| arc.applied_to(requested));
        motion_task(ledger, (command, output), requested, (&self.setup, self.freedom), engine, session)
    }

    /// The walk over the instants of a task, with the values of `measures`.
    pub(super) fn walk<'w>(
        &self,
        engine: &'w dyn Engine,
        (requested, setup, instants): (&RequestedInstants, &'w Setup, &'w Instants),
        measures: &'w [Measure],
        watch: &'w ProgressWatch,
    ) -> FollowedMotion<'w> {
        FollowedMotion {
            engine,
            setup,
            instants,
            stop_at_events: false,
            open_end: requested.is_open(),
            freedom: self.freedom,
            reported: false,
            tells_missing: false,
            measures,
            degrees: self.angles.degrees,
            watch,
        }
    }
}

/// The motion over these instants, assembled at the first of them; errors go to the ledger.
fn motion_task<'o>(
    ledger: &mut Ledger,
    (command, output): (&str, &'o OutputArgs),
    requested: Result<RequestedInstants, Failure>,
    (setup, freedom): (&SetupArgs, FreedomArgs),
    engine: &mut dyn Engine,
    session: &Session<'_>,
) -> Option<MotionTask<'o>> {
    let requested = ledger.take(requested);
    let output = ledger.take(session.destination(output, command));
    let setup = ledger.take(setup.apply_complete(engine));
    let (requested, output, setup) = zip3(requested, output, setup)?;
    let setup = Setup { least_norm: freedom.least_norm, since: requested.since(), ..setup };
    let first = ledger.take(requested.first(engine, &setup))?;
    let setup = ledger.take(settled(engine, setup, first))?;
    Some(MotionTask { requested, setup, output })
}
