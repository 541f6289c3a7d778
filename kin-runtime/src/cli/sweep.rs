//! `sweep`: the motion over many instants.

use std::cell::{Cell, RefCell};
use std::io::{self, Write};
use std::ops::ControlFlow;

use super::degrees;
use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger, zip3};
use super::moving::{GridArgs, Moved, Walk, note_motion};
use super::options::{AngleArgs, FreedomArgs, SetupArgs};
use super::output::{Destination, Form, OutputArgs};
use super::session::Session;
use super::solved::note_freedom;
use crate::forces::ContactChange;
use crate::model::Model;
use crate::motion::Motion;
use crate::present::grid::{self, CsvRows};
use crate::present::number::rounded;
use crate::present::record::{Parameters, SweepRecord, Visit};
use crate::present::text::count;
use crate::present::units::Units;
use crate::state::State;
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
    angles: AngleArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let (at, to) = (&names.at, &names.to);
        let stop = names.analysis("sweep --stop-at-events", "up to the first limit that is met");
        vec![
            names.analysis("sweep", "one turn of the driven crank, or as far as it goes"),
            names.analysis("sweep --steps 500 --out motion.csv", ""),
            names.analysis(&format!("sweep --to {to} --points --out motion.json"), "points as well"),
            names.analysis(&format!("sweep --times 0,{at},{to} --degrees"), "instants one by one"),
            names.with("sweep --set", &names.set, "with another dimension"),
            names.with("sweep --mode", &names.mode, "in another assembly mode"),
            if names.conditions { stop } else { None },
        ]
    },
    details: "\
csv has one header line and one row per instant: t, then every coordinate, its rate (NAME_dot)
and acceleration (NAME_ddot). Inputs and given coordinates hold at the first instant and go on
with their acceleration. Where a unilateral condition meets its limit is said on stderr, and in
json under `events`; where it changes too fast to be watched, too, and under `unwatched`. With
masses, contacts that lift off or press again are told likewise, and in json under `contacts`.

Rows go to csv and json as they come, however many there are. When a sweep fails midway the
finished rows are written and the status is 1. Ctrl-C ends a sweep in the same way, with status
130; a second Ctrl-C ends the program at once.",
};

pub(super) fn run(args: &SweepArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let (asked, output) =
        (ledger.take(args.grid.asked(STEPS, engine.model())), ledger.take(session.destination(&args.output, "sweep")));
    let setup = ledger.take(args.setup.apply_complete(engine));
    let (asked, output, setup) = ledger.close(zip3(asked, output, setup))?;
    let engine = &*engine;
    let open_end = asked.is_open();
    let times = asked.times(engine, &setup)?;
    let watch = session.watch();
    if session.is_seen(&output) && output.form != Form::Text {
        watch.begin_unseen();
    } else {
        watch.begin("instants", times.len());
    }
    let (stop_at_events, freedom, reported) = (args.stop_at_events, args.freedom, args.points);
    let walk =
        Walk { engine, setup: &setup, times: &times, stop_at_events, open_end, freedom, reported, watch: &watch };
    let (rows, moved) = match output.form {
        Form::Text => {
            let moved = walk.kept()?;
            watch.end();
            let rows = moved.trajectory.states.len();
            if rows > 0 {
                session.deliver(&output, &text(engine.model(), &moved, args.angles.degrees))?;
            }
            (rows, moved)
        }
        _ => streamed(&walk, &output, args.angles.degrees, session)?,
    };
    watch.end();
    note_motion(session, &moved);
    let Some(failure) = moved.ended else {
        note_freedom(session, moved.left);
        return Ok(());
    };
    if rows > 0 && !matches!(failure, Failure::Interrupted(_)) {
        session.note(&format!("the sweep ended early: {rows} of {} written", count(times.len(), "instant")));
    }
    Err(failure)
}

/// Writes every row as soon as it is there: how many, and what else there is to say.
fn streamed(
    walk: &Walk<'_>,
    output: &Destination<'_>,
    degrees: bool,
    session: &mut Session<'_>,
) -> Result<(usize, Moved), Failure> {
    let model = walk.engine.model();
    let rows = Cell::new(0);
    let moved = RefCell::new(None);
    let each = |visit: Visit<'_>| {
        let shown = &mut |state: &State, motion: Option<&Motion>| {
            let motion = motion.map(|motion| degrees::motion(model, motion, degrees));
            visit(&degrees::state(model, state, degrees), motion.as_deref())?;
            rows.set(rows.get() + 1);
            ControlFlow::Continue(())
        };
        moved.replace(Some(walk.each(shown)));
    };
    let written = session.stream(output, |out| {
        match output.form {
            Form::Json => json(walk, degrees, &each, &moved, out)?,
            _ => csv(model, walk.reported, &each, out)?,
        }
        // Without a row a file keeps what it has.
        if rows.get() == 0 { Err(io::Error::other("there is nothing to write")) } else { Ok(()) }
    });
    let moved = moved.into_inner().unwrap_or_else(|| Err(Failure::Analysis("nothing was computed".to_owned())))?;
    if rows.get() > 0 || moved.ended.is_none() {
        written?;
    }
    Ok((rows.get(), moved))
}

/// What shows every row to somebody.
type Each<'e> = &'e dyn Fn(Visit<'_>);

fn csv(model: &Model, reported: bool, each: Each<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut csv = CsvRows::new(model, reported, out)?;
    let mut failed = None;
    each(&mut |state, motion| match csv.row(state, motion) {
        Ok(()) => ControlFlow::Continue(()),
        Err(error) => {
            failed = Some(error);
            ControlFlow::Break(())
        }
    });
    failed.map_or_else(|| csv.flush(), Err)
}

fn json(
    walk: &Walk<'_>,
    degrees: bool,
    each: Each<'_>,
    moved: &RefCell<Option<Result<Moved, Failure>>>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let model = walk.engine.model();
    let ended = |write: &mut dyn FnMut(&Trajectory, &[ContactChange], bool)| {
        if let Some(Ok(moved)) = &*moved.borrow() {
            write(&moved.trajectory, &moved.contacts, moved.ended.is_none() && moved.limit.is_none());
        }
    };
    let parameters = Parameters::new(model, &walk.engine.parameters());
    let units = Units::of(model).in_degrees(degrees).record();
    serde_json::to_writer(&mut *out, &SweepRecord { model, parameters, units, walk: each, ended: &ended })?;
    out.write_all(b"\n")
}

fn text(model: &Model, moved: &Moved, degrees: bool) -> String {
    let states: Vec<State> =
        moved.trajectory.states.iter().map(|s| degrees::state(model, s, degrees).into_owned()).collect();
    let motions: Vec<Motion> = moved.motions.iter().map(|m| degrees::motion(model, m, degrees).into_owned()).collect();
    let (first, last) = (states.first(), states.last());
    let [from, to] = [first, last].map(|s| s.map_or_else(String::new, |s| rounded(s.t)));
    let angles = if degrees { ", angles in degrees" } else { "" };
    let heading = format!("{}, {} from t = {from} to t = {to}{angles}\n", model.name, count(states.len(), "instant"));
    heading + &grid::text(model, &states, &motions)
}
