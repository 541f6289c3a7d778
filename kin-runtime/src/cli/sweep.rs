//! `sweep`: the motion over many instants.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger, zip3};
use super::moving::{self, GridArgs, Moved, interrupted, moved, note_motion};
use super::options::{FreedomArgs, SetupArgs};
use super::output::{Form, OutputArgs};
use super::session::Session;
use super::solved::note_freedom;
use crate::motion::Motion;
use crate::present::grid;
use crate::present::json::to_json;
use crate::present::number::rounded;
use crate::present::record::{Parameters, SweepRecord};
use crate::present::text::count;
use crate::trajectory::Trajectory;

/// Steps when --steps is not there.
pub(super) const STEPS: usize = 100;

/// The motion over many instants, on one branch from the first to the last
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SweepArgs {
    #[command(flatten)]
    grid: GridArgs,
    /// End the sweep where the first unilateral condition meets its limit
    #[arg(long)]
    stop_at_events: bool,
    /// Also points, defines and joint quantities, behind the coordinates
    #[arg(long)]
    points: bool,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let stop = names.analysis("sweep --to 1 --stop-at-events", "up to the first limit that is met");
        vec![
            names.analysis("sweep --to 1", "101 instants from t = 0 to t = 1"),
            names.analysis("sweep --to 1 --steps 500 --out motion.csv", ""),
            names.analysis("sweep --from 1 --to -1 --points --out motion.json", "backwards, points as well"),
            names.analysis("sweep --times -1,0,0.5,10", "instants one by one"),
            names.with("sweep --to 1 --set", &names.set, "with another dimension"),
            names.with("sweep --to 1 --given", &names.given, "a coordinate that the drivers leave open"),
            names.with("sweep --to 1 --mode", &names.mode, "in another assembly mode"),
            if names.conditions { stop } else { None },
        ]
    },
    details: "\
csv has one header line and one row per instant: t, then every coordinate, its rate (NAME_dot)
and acceleration (NAME_ddot). Inputs and given coordinates hold at the first instant and go on
with their acceleration. Where a unilateral condition meets its limit is said on stderr, and in
json under `events`; where it changes too fast to be watched, too, and under `unwatched`.

When a sweep fails midway the finished rows are written and the status is 1. Ctrl-C ends a sweep
in the same way, with status 130; a second Ctrl-C ends the program at once.",
};

pub(super) fn run(args: &SweepArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let (asked, output) =
        (ledger.take(args.grid.asked(STEPS)), ledger.take(session.destination(&args.output, "sweep")));
    let setup = ledger.take(args.setup.apply_complete(engine));
    let times = asked.and_then(|asked| ledger.take(asked.times(|_| None)));
    let (times, output, setup) = ledger.close(zip3(times, output, setup))?;
    let engine = &*engine;
    let watch = session.watch();
    watch.begin("instants", times.len());
    let Moved { mut trajectory, mut ended, left } =
        moved(engine, &setup, &times, args.stop_at_events, args.freedom, &watch)?;
    let mut motions = Vec::new();
    if args.points {
        watch.begin("instants with their points", trajectory.states.len());
        motions = moving::motions(engine, &trajectory.states, &watch)?;
        if motions.len() < trajectory.states.len() {
            trajectory.states.truncate(motions.len());
            ended = Some(interrupted(&trajectory.states, times.len()));
        }
    }
    watch.begin("instants written", trajectory.states.len());
    // What is finished is written whatever happens.
    let written = |done: usize| {
        let _ = watch.step(done);
    };
    let text = render(output.form, engine, &trajectory, &motions, ended.is_none(), &written)?;
    watch.end();
    note_motion(session, &trajectory);
    match ended {
        None => {
            note_freedom(session, left);
            session.deliver(&output, &text)
        }
        Some(failure) => {
            let states = &trajectory.states;
            if !states.is_empty() {
                session.deliver(&output, &text)?;
                if !matches!(failure, Failure::Interrupted(_)) {
                    let instants = count(times.len(), "instant");
                    session.note(&format!("the sweep ended early: {} of {instants} written", states.len()));
                }
            }
            Err(failure)
        }
    }
}

fn render(
    form: Form,
    engine: &dyn Engine,
    trajectory: &Trajectory,
    motions: &[Motion],
    complete: bool,
    written: &dyn Fn(usize),
) -> Result<String, Failure> {
    let (model, states) = (engine.model(), &trajectory.states);
    match form {
        Form::Csv => grid::csv(model, states, motions, written).map_err(Failure::Output),
        Form::Json => {
            let parameters = Parameters::new(model, &engine.parameters());
            to_json(&SweepRecord::new(model, parameters, trajectory, motions, complete, written))
                .map_err(Failure::Output)
        }
        _ => {
            let (first, last) = (states.first(), states.last());
            let [from, to] = [first, last].map(|s| s.map_or_else(String::new, |s| rounded(s.t)));
            let heading = format!("{}, {} from t = {from} to t = {to}\n", model.name, count(states.len(), "instant"));
            Ok(heading + &grid::text(model, states, motions))
        }
    }
}
