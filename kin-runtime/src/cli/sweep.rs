//! `sweep`: the motion over many instants.

use std::cell::{Cell, RefCell};
use std::io::{self, Write};
use std::ops::ControlFlow;

use super::columns::quantities;
use super::degrees;
use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::followed::{FollowedMotion, Moved};
use super::instants::ArcArgs;
use super::motion_notes::note_motion;
use super::output::{Form, OutputArgs};
use super::session::Session;
use super::solved::note_freedom;
use super::task::{MotionArgs, MotionTask};
use super::vary::{Choice, VaryArgs};
use super::watch::ProgressWatch;
use crate::forces::ContactChange;
use crate::measure::Measure;
use crate::model::Model;
use crate::present::grid::{self, CsvRows};
use crate::present::number::rounded;
use crate::present::record::{InstantRow, MotionsRecord, Parameters, SweepRecord, Visit};
use crate::present::text::count;
use crate::present::units::ResultUnits;
use crate::trajectory::Trajectory;

/// Number of steps without `--steps`.
pub(super) const STEPS: usize = 100;

/// The motion over many instants, on one branch from the first to the last
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SweepArgs {
    /// Quantities by name instead of all coordinates: B.transmission, tip.x, tip.x/drive
    #[arg(value_name = "WHAT", conflicts_with = "points")]
    what: Vec<String>,
    #[command(flatten)]
    vary: VaryArgs,
    /// End the sweep where the first unilateral condition meets its limit
    #[arg(long, conflicts_with = "along_arc")]
    stop_at_events: bool,
    /// Also points, defines and joint quantities, after the coordinates
    #[arg(long)]
    points: bool,
    #[command(flatten)]
    motion: MotionArgs,
    #[command(flatten)]
    arc: ArcArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let (at, to) = (&names.at, &names.to);
        let transmission =
            names.transmission.as_ref().map(|name| format!("sweep {} --degrees", super::trial::quoted(name.clone())));
        let stop = names.analysis("sweep --stop-at-events", "up to the first limit that is met");
        vec![
            names.analysis("sweep", "one turn of the driven crank, or as far as it goes"),
            names.analysis("sweep --steps 500 --out motion.csv", ""),
            names.analysis(&format!("sweep --to {to} --points --out motion.json"), "points as well"),
            names.analysis(&format!("sweep --times 0,{at},{to} --degrees"), "instants one by one"),
            transmission.and_then(|line| names.analysis(&line, "one quantity by its name")),
            names.with("sweep --steps 20 --out motions.csv --vary", &names.vary, "a motion for each of five values"),
            names.analysis("sweep --to limit", "until the mechanism can go no further"),
            names.arc.then(|| names.analysis("sweep --along-arc", "through dead centres, all the way round")).flatten(),
            names.with("sweep --set", &names.set, "with a dimension of your own"),
            names.with("sweep --mode", &names.mode, "in this assembly mode"),
            if names.conditions { stop } else { None },
        ]
    },
    details: "\
csv has one header line and one row per instant: t, then every coordinate, its rate (NAME_dot)
and acceleration (NAME_ddot). With --vary, columns for the varied parameters come before t, and
json has a list of motions. WHAT names quantities to be listed instead: coordinates, points (tip.x,
tip.speed), defines, joint quantities (B.angle), inputs, transmission angles (B.transmission),
forces, and velocity ratios of the former to a driver or an input (tip.x/drive).

The values of inputs and given coordinates belong to the first instant, with --from limit to t = 0;
from there they continue with constant acceleration. When a unilateral condition reaches its limit,
stderr says at which t, and json lists it under `events`; stretches of t in which a condition
changes too fast to be watched, or branches meet, are under `unwatched`. If the mechanism has
masses, contacts that lift off or press again are reported in the same way, in json under
`contacts`.

With --to limit (and --from limit) the motion ends where the mechanism can go no further, and rows
are closer together near it. The last row is the limit itself, at which rates have no value, unless
only the way there is known: where a row is not defined beyond it, or velocities are integrated. If
no limit is met, the motion takes one turn of the driven crank, or one unit of time; a note says so.

With --along-arc t is an unknown as well: at a dead centre the driver turns back, and the mechanism
goes on into its other closure, until all bodies are where they began. The rows are equally spaced
along the arc. Dead centres, cusps of named points and branch points are reported, in json under
`arc`; unilateral conditions and contacts are not watched. Where branches cross the motion ends,
because the equations do not determine which of them continues it.

Rows are written to csv and json as soon as they are computed. When a sweep fails midway the
finished rows are written and the status is 1. Ctrl-C ends a sweep in the same way, with status
130; a second Ctrl-C ends the program at once.",
};

/// Largest number of motions of one sweep, and what to do to have more.
const MAX_MOTIONS: (usize, &str) = (100_000, "for more, see the crate kin-study");

pub(super) fn run(args: &SweepArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let model = engine.model();
    let mut ledger = Ledger::default();
    let task = args.motion.read(&mut ledger, ("sweep", &args.output), (STEPS, args.arc), engine, session);
    let choices = ledger.take(args.vary.choices(model, MAX_MOTIONS));
    let wanted = ledger.take(quantities(model, &args.what));
    let (task, (choices, wanted)) = ledger.close(task.zip(choices.zip(wanted)))?;
    let unnamed = wanted.is_empty();
    let time = Measure::standard(model, false).into_iter().take(1);
    let measures = if unnamed { Measure::standard(model, args.points) } else { time.chain(wanted).collect() };
    let motions = SweepTask { args, task, choices, measures, unnamed, rows: Cell::new(0) };
    let (output, watch) = (&motions.task.output, session.watch());
    let streams = output.form != Form::Text;
    let mut run =
        RunningSweep { engine, watch: &watch, seen: streams && session.is_seen(output), outcomes: Vec::new() };
    match streams {
        true => streamed(&motions, &mut run, session)?,
        false => {
            let text = text(&motions, &mut run);
            if motions.rows.get() > 0 {
                session.deliver(output, &text)?;
            }
        }
    }
    watch.end();
    motions.report(model, run.outcomes, session)
}

/// The task of a sweep: a motion for every combination of the varied parameters.
struct SweepTask<'a> {
    args: &'a SweepArgs,
    task: MotionTask<'a>,
    choices: Vec<Choice>,
    /// The columns, t first.
    measures: Vec<Measure>,
    /// Whether no quantities were named, so that the columns are all coordinates.
    unnamed: bool,
    /// Number of rows written so far.
    rows: Cell<usize>,
}

/// A sweep while it runs.
struct RunningSweep<'r> {
    engine: &'r mut dyn Engine,
    watch: &'r ProgressWatch,
    /// Whether rows appear on a terminal, so that there is no progress bar.
    seen: bool,
    outcomes: Vec<MotionOutcome>,
}

/// The outcome of one motion: its rows, of how many instants, and how it ended.
struct MotionOutcome {
    rows: usize,
    instants: usize,
    moved: Result<Moved, Failure>,
}

impl SweepTask<'_> {
    fn are_several(&self) -> bool {
        self.choices.len() > 1
    }

    /// Follows the motion of one combination of parameters: `each` runs the walk that it is given, if its instants can be
    /// found.
    fn follow(
        &self,
        (place, choice): (usize, &Choice),
        run: &mut RunningSweep<'_>,
        each: impl FnOnce(&dyn Engine, Result<&FollowedMotion<'_>, Failure>) -> Result<Moved, Failure>,
    ) {
        let MotionTask { requested, setup, .. } = &self.task;
        choice.set(run.engine);
        let outcome = match requested.instants(run.engine, setup) {
            Err(failure) => MotionOutcome { rows: 0, instants: 0, moved: each(run.engine, Err(failure)) },
            Ok(instants) => {
                match (place, run.seen) {
                    (0, true) => run.watch.begin_unseen(),
                    _ => run.watch.begin_motion((place, self.choices.len()), instants.len()),
                }
                let before = self.rows.get();
                let walk = self.args.motion.walk(run.engine, (requested, setup, &instants), &self.measures, run.watch);
                let stop_at_events = self.args.stop_at_events;
                let tells_missing = !self.args.what.is_empty();
                let moved = each(run.engine, Ok(&FollowedMotion { stop_at_events, tells_missing, ..walk }));
                MotionOutcome { rows: self.rows.get() - before, instants: instants.len(), moved }
            }
        };
        run.outcomes.push(outcome);
    }

    /// Counts rows that were written.
    fn count(&self, rows: usize) {
        self.rows.set(self.rows.get() + rows);
    }

    /// Prints the notes of all motions; returns the first failure.
    fn report(&self, model: &'static Model, all: Vec<MotionOutcome>, session: &mut Session<'_>) -> Result<(), Failure> {
        let mut failure = None;
        let finished = all.len();
        for (MotionOutcome { rows, instants, moved }, choice) in all.into_iter().zip(&self.choices) {
            let name = choice.name(model);
            let ended = match moved {
                Ok(moved) => {
                    note_motion(session, &moved, self.are_several().then_some(&name));
                    if moved.ended.is_none() {
                        note_freedom(session, moved.open);
                    }
                    moved.ended
                }
                Err(failure) => Some(failure),
            };
            let Some(ended) = ended else { continue };
            let interrupted = matches!(ended, Failure::Interrupted(_));
            if rows > 0 && !interrupted {
                let instants = count(instants, "instant");
                session.note(&format!("the sweep ended early: {rows} of {instants} written"));
            }
            if self.are_several() && !interrupted {
                session.note(&format!("note: {name}: {ended}"));
            }
            failure = failure.or(Some(ended));
        }
        match failure {
            Some(Failure::Interrupted(_)) if self.are_several() => {
                let motions = count(self.choices.len(), "motion");
                Err(Failure::Interrupted(format!("{} of {motions} finished, the next one in part", finished - 1)))
            }
            Some(failure) => Err(failure),
            None => Ok(()),
        }
    }
}

/// Writes every row as soon as it is computed.
fn streamed(motions: &SweepTask<'_>, run: &mut RunningSweep<'_>, session: &mut Session<'_>) -> Result<(), Failure> {
    let output = &motions.task.output;
    let written = session.stream(output, |out| {
        match output.form {
            Form::Json => json(motions, run, out)?,
            _ => csv(motions, run, out)?,
        }
        // Without a row an existing file keeps its contents.
        if motions.rows.get() == 0 { Err(io::Error::other("there is nothing to write")) } else { Ok(()) }
    });
    let ended = |outcome: &MotionOutcome| outcome.moved.as_ref().map_or(true, |moved| moved.ended.is_some());
    let failed = run.outcomes.iter().any(ended);
    if motions.rows.get() > 0 || !failed { written } else { Ok(()) }
}

fn csv(motions: &SweepTask<'_>, run: &mut RunningSweep<'_>, out: &mut dyn Write) -> io::Result<()> {
    let model = run.engine.model();
    let varied = motions.choices.first().map(|choice| choice.pairs(model).map(|(name, _)| name));
    let names = varied.into_iter().flatten().chain(motions.measures.iter().map(Measure::name));
    let mut csv = CsvRows::new(names, out)?;
    let mut failed = None;
    for (index, choice) in motions.choices.iter().enumerate() {
        let values: Vec<f64> = choice.pairs(model).map(|(_, value)| value).collect();
        motions.follow((index, choice), run, |_, walk| {
            walk?.each(&mut |row| match csv.row(values.iter().chain(row.values).copied()) {
                Ok(()) => {
                    motions.count(1);
                    ControlFlow::Continue(())
                }
                Err(error) => {
                    failed = Some(error);
                    ControlFlow::Break(())
                }
            })
        });
        if failed.is_some() || run.watch.interrupted() {
            break;
        }
    }
    failed.map_or_else(|| csv.flush(), Err)
}

fn json(motions: &SweepTask<'_>, run: &mut RunningSweep<'_>, out: &mut dyn Write) -> io::Result<()> {
    let (model, degrees) = (run.engine.model(), motions.args.motion.angles.degrees);
    let shared = RefCell::new(run);
    let record = |index: usize, write: &mut dyn FnMut(&SweepRecord<'_>)| {
        let run = &mut **shared.borrow_mut();
        let choice = &motions.choices[index];
        motions.follow((index, choice), run, |engine, walk| {
            let (walk, failure) = walk.map_or_else(|failure| (None, Some(failure)), |walk| (Some(walk), None));
            let moved = RefCell::new(failure.map(Err));
            let measures: &[Measure] = if motions.unnamed { &[] } else { &motions.measures[1..] };
            let each = |visit: Visit<'_>| {
                let Some(walk) = walk else { return };
                let walk = FollowedMotion { measures, reported: motions.args.points, ..*walk };
                moved.replace(Some(walk.each(&mut |row| {
                    let motion = row.motion.map(|motion| degrees::motion(model, motion, walk.degrees));
                    let state = degrees::state(model, row.state, walk.degrees);
                    visit(&InstantRow { state: &state, motion: motion.as_deref(), values: row.values })?;
                    motions.count(1);
                    ControlFlow::Continue(())
                })));
            };
            let ended = |write: &mut dyn FnMut(&Trajectory, &[ContactChange], bool)| match &*moved.borrow() {
                Some(Ok(moved)) => {
                    write(&moved.trajectory, &moved.contacts, moved.ended.is_none() && !moved.at_its_end);
                }
                _ => write(&Trajectory::new(model), &[], false),
            };
            write(&SweepRecord {
                model,
                varied: motions.are_several().then(|| choice.pairs(model).collect()),
                parameters: Parameters::new(model, &engine.parameters()),
                units: ResultUnits::of(model).in_degrees(degrees).record(),
                quantities: measures,
                walk: &each,
                ended: &ended,
            });
            let moved = moved.into_inner();
            moved.unwrap_or_else(|| Err(Failure::Analysis("nothing was computed".to_owned())))
        });
        run.watch.interrupted()
    };
    if motions.are_several() {
        let varied = motions.choices[0].pairs(model).map(|(name, _)| name).collect();
        let motions = MotionsRecord { model, varied, count: motions.choices.len(), record: &record };
        serde_json::to_writer(&mut *out, &motions)?;
    } else {
        let mut written = Ok(());
        record(0, &mut |record| written = serde_json::to_writer(&mut *out, record));
        written?;
    }
    out.write_all(b"\n")
}

fn text(motions: &SweepTask<'_>, run: &mut RunningSweep<'_>) -> String {
    let model = run.engine.model();
    let mut out = String::new();
    for (index, choice) in motions.choices.iter().enumerate() {
        motions.follow((index, choice), run, |_, walk| {
            let moved = walk?.with_states()?;
            let rows = moved.columns.first().map_or(0, Vec::len);
            motions.count(rows);
            if rows > 0 {
                out.push_str(if out.is_empty() { "" } else { "\n" });
                out.push_str(&table(motions, model, choice, &moved));
            }
            Ok(moved)
        });
        if run.watch.interrupted() {
            break;
        }
    }
    out
}

fn table(motions: &SweepTask<'_>, model: &Model, choice: &Choice, moved: &Moved) -> String {
    let names = motions.measures.iter().map(|measure| measure.name().to_owned());
    let columns: Vec<grid::Column> = names.zip(moved.columns.iter().cloned()).collect();
    let times = &moved.columns[0];
    let [from, to] = [times.first(), times.last()].map(|t| t.map_or_else(String::new, |t| rounded(*t)));
    let angles = if motions.args.motion.angles.degrees { ", angles in degrees" } else { "" };
    let name = choice.name(model);
    let varied = if name.is_empty() { String::new() } else { format!(", {name}") };
    let heading =
        format!("{}{varied}, {} from t = {from} to t = {to}{angles}\n", model.name, count(times.len(), "instant"));
    heading + &grid::text(&columns, if motions.unnamed { 3 } else { 1 })
}
