//! `sweep`: the motion over many instants.

use std::cell::{Cell, RefCell};
use std::io::{self, Write};
use std::ops::ControlFlow;

use super::columns::quantities;
use super::degrees;
use super::engine::{Engine, Setup};
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger, zip3};
use super::instants::{ArcArgs, Asked, GridArgs, Instants};
use super::moving::{Moved, Walk, note_motion};
use super::options::{AngleArgs, FreedomArgs, SetupArgs};
use super::output::{Destination, Form, OutputArgs};
use super::session::Session;
use super::solved::note_freedom;
use super::vary::{Choice, VaryArgs};
use super::watch::Watch;
use crate::forces::ContactChange;
use crate::measure::Measure;
use crate::model::Model;
use crate::present::grid::{self, CsvRows};
use crate::present::number::rounded;
use crate::present::record::{MotionsRecord, Parameters, Row, SweepRecord, Visit};
use crate::present::text::count;
use crate::present::units::Units;
use crate::trajectory::Trajectory;

/// Steps when --steps is not there.
pub(super) const STEPS: usize = 100;

/// The motion over many instants, on one branch from the first to the last
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SweepArgs {
    /// Quantities by name, not all coordinates: B.transmission, tip.x, tip.x/drive
    #[arg(value_name = "WHAT", conflicts_with = "points")]
    what: Vec<String>,
    #[command(flatten)]
    vary: VaryArgs,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    arc: ArcArgs,
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
            names.with("sweep --set", &names.set, "with another dimension"),
            names.with("sweep --mode", &names.mode, "in another assembly mode"),
            if names.conditions { stop } else { None },
        ]
    },
    details: "\
csv has one header line and one row per instant: t, then every coordinate, its rate (NAME_dot)
and acceleration (NAME_ddot). With --vary the varied parameters stand before t; json has a list
of motions then. WHAT names quantities instead: coordinates, points (tip.x, tip.speed), defines,
joint quantities (B.angle), inputs, transmission angles (B.transmission), forces, and velocity
ratios of the former to a driver or an input (tip.x/drive).

Inputs and given coordinates hold at the first instant and go on with their acceleration. Where a
unilateral condition meets its limit is said on stderr, and in json under `events`; where it
changes too fast to be watched, too, and under `unwatched`. With masses, contacts that lift off or
press again are told likewise, and in json under `contacts`.

With --to limit (and --from limit) the motion ends where the mechanism does: the last row is the
limit itself, at which rates have no value, and the rows before it lie closer together. Where no
limit is met the motion is one turn long, or one unit of time, and that is said.

With --along-arc t is an unknown as well: at a dead centre the driver turns back, and the mechanism
goes on into its other closure, until all bodies are where they began. The rows are equally far
apart on that way. Dead centres, cusps of named points and branch points are told, in json under
`arc`. Where branches cross the motion ends, as nothing says which of them is meant.

Rows go to csv and json as they come, however many there are. When a sweep fails midway the
finished rows are written and the status is 1. Ctrl-C ends a sweep in the same way, with status
130; a second Ctrl-C ends the program at once.",
};

/// Motions of one sweep at most.
const MOST: (usize, &str) = (100_000, "more are a study of their own");

pub(super) fn run(args: &SweepArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let model = engine.model();
    let mut ledger = Ledger::default();
    let (asked, output) = (
        args.grid.asked(STEPS, model).and_then(|asked| args.arc.of(asked)),
        session.destination(&args.output, "sweep"),
    );
    let (asked, output) = (ledger.take(asked), ledger.take(output));
    let setup = ledger.take(args.setup.apply_complete(engine));
    let choices = ledger.take(args.vary.choices(model, MOST));
    let wanted = ledger.take(quantities(model, &args.what));
    let ((asked, output, setup), (choices, wanted)) =
        ledger.close(zip3(asked, output, setup).zip(choices.zip(wanted)))?;
    let whole = wanted.is_empty();
    let time = Measure::standard(model, false).into_iter().take(1);
    let measures = if whole { Measure::standard(model, args.points) } else { time.chain(wanted).collect() };
    let motions = Motions { args, setup, choices, asked, measures, whole, rows: Cell::new(0) };
    let mut moved = Vec::new();
    match output.form {
        Form::Text => {
            let text = text(&motions, engine, session, &mut moved);
            if motions.rows.get() > 0 {
                session.deliver(&output, &text)?;
            }
        }
        _ => streamed(&motions, engine, &output, session, &mut moved)?,
    }
    session.watch().end();
    motions.tell(model, moved, session)
}

/// What a sweep is to do: a motion for every choice of the varied parameters.
struct Motions<'a> {
    args: &'a SweepArgs,
    setup: Setup,
    choices: Vec<Choice>,
    asked: Asked,
    /// The columns, t first.
    measures: Vec<Measure>,
    /// Whether the columns are those of nobody's choice.
    whole: bool,
    /// Rows that were shown to somebody.
    rows: Cell<usize>,
}

/// How far a motion came, of how many instants, and the rows that it has.
struct Came {
    rows: usize,
    instants: usize,
    moved: Result<Moved, Failure>,
}

impl Motions<'_> {
    fn are_several(&self) -> bool {
        self.choices.len() > 1
    }

    /// Follows the motion of one choice; `each` is given the way to do it.
    fn follow(
        &self,
        place: usize,
        engine: &mut dyn Engine,
        session: (&Watch, bool),
        each: impl FnOnce(&Walk<'_>) -> Result<Moved, Failure>,
    ) -> Came {
        let (watch, seen) = session;
        self.choices[place].set(engine);
        let instants = match self.asked.instants(engine, &self.setup) {
            Ok(instants) => instants,
            Err(failure) => return Came { rows: 0, instants: 0, moved: Err(failure) },
        };
        match (place, seen) {
            (0, true) => watch.begin_unseen(),
            (0, false) => watch.begin("instants", self.choices.len() * instants.len()),
            _ => watch.go_on(place * instants.len()),
        }
        let before = self.rows.get();
        let moved = each(&self.walk(engine, &instants, watch));
        Came { rows: self.rows.get() - before, instants: instants.len(), moved }
    }

    fn walk<'w>(&'w self, engine: &'w dyn Engine, instants: &'w Instants, watch: &'w Watch) -> Walk<'w> {
        Walk {
            engine,
            setup: &self.setup,
            instants,
            stop_at_events: self.args.stop_at_events,
            open_end: self.asked.is_open(),
            freedom: self.args.freedom,
            reported: false,
            measures: &self.measures,
            degrees: self.args.angles.degrees,
            watch,
        }
    }

    /// Says what there is to say of the motions; gives the first failure.
    fn tell(&self, model: &'static Model, all: Vec<Came>, session: &mut Session<'_>) -> Result<(), Failure> {
        let mut failure = None;
        let finished = all.len();
        for (Came { rows, instants, moved }, choice) in all.into_iter().zip(&self.choices) {
            let ended = match moved {
                Ok(moved) => {
                    note_motion(session, &moved);
                    if moved.ended.is_none() {
                        note_freedom(session, moved.left);
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
                session.note(&format!("note: {}: {ended}", choice.name(model)));
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

/// Writes every row as soon as it is there.
fn streamed(
    motions: &Motions<'_>,
    engine: &mut dyn Engine,
    output: &Destination<'_>,
    session: &mut Session<'_>,
    all: &mut Vec<Came>,
) -> Result<(), Failure> {
    let (watch, seen) = (session.watch(), session.is_seen(output));
    let written = session.stream(output, |out| {
        match output.form {
            Form::Json => json(motions, engine, (&watch, seen), all, out)?,
            _ => csv(motions, engine, (&watch, seen), all, out)?,
        }
        // Without a row a file keeps what it has.
        if motions.rows.get() == 0 { Err(io::Error::other("there is nothing to write")) } else { Ok(()) }
    });
    let failed = all.iter().any(|came| came.moved.as_ref().map_or(true, |moved| moved.ended.is_some()));
    if motions.rows.get() > 0 || !failed { written } else { Ok(()) }
}

fn csv(
    motions: &Motions<'_>,
    engine: &mut dyn Engine,
    session: (&Watch, bool),
    all: &mut Vec<Came>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let model = engine.model();
    let varied = motions.choices.first().map(|choice| choice.pairs(model).map(|(name, _)| name));
    let names = varied.into_iter().flatten().chain(motions.measures.iter().map(Measure::name));
    let mut csv = CsvRows::new(names, out)?;
    let mut failed = None;
    for (place, choice) in motions.choices.iter().enumerate() {
        let values: Vec<f64> = choice.pairs(model).map(|(_, value)| value).collect();
        let came = motions.follow(place, engine, session, |walk| {
            walk.each(&mut |row| match csv.row(values.iter().chain(row.values).copied()) {
                Ok(()) => {
                    motions.rows.set(motions.rows.get() + 1);
                    ControlFlow::Continue(())
                }
                Err(error) => {
                    failed = Some(error);
                    ControlFlow::Break(())
                }
            })
        });
        all.push(came);
        if failed.is_some() || session.0.interrupted() {
            break;
        }
    }
    failed.map_or_else(|| csv.flush(), Err)
}

fn json(
    motions: &Motions<'_>,
    engine: &mut dyn Engine,
    session: (&Watch, bool),
    all: &mut Vec<Came>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let model = engine.model();
    let shared = RefCell::new((engine, all));
    let record = |place: usize, write: &mut dyn FnMut(&SweepRecord<'_>)| {
        let (engine, all) = &mut *shared.borrow_mut();
        let choice = &motions.choices[place];
        let came = motions.follow(place, &mut **engine, session, |walk| {
            let moved = RefCell::new(None);
            let each = |visit: Visit<'_>| {
                let walk = Walk { measures: if motions.whole { &[] } else { &motions.measures[1..] }, ..*walk };
                let walk = Walk { reported: motions.args.points, ..walk };
                moved.replace(Some(walk.each(&mut |row| {
                    let motion = row.motion.map(|motion| degrees::motion(model, motion, walk.degrees));
                    let state = degrees::state(model, row.state, walk.degrees);
                    visit(&Row { state: &state, motion: motion.as_deref(), values: row.values })?;
                    motions.rows.set(motions.rows.get() + 1);
                    ControlFlow::Continue(())
                })));
            };
            let ended = |write: &mut dyn FnMut(&Trajectory, &[ContactChange], bool)| {
                if let Some(Ok(moved)) = &*moved.borrow() {
                    write(&moved.trajectory, &moved.contacts, moved.ended.is_none() && !moved.at_its_end);
                }
            };
            write(&SweepRecord {
                model,
                varied: motions.are_several().then(|| choice.pairs(model).collect()),
                parameters: Parameters::new(model, &walk.engine.parameters()),
                units: Units::of(model).in_degrees(motions.args.angles.degrees).record(),
                quantities: if motions.whole { &[] } else { &motions.measures[1..] },
                walk: &each,
                ended: &ended,
            });
            let moved = moved.into_inner();
            moved.unwrap_or_else(|| Err(Failure::Analysis("nothing was computed".to_owned())))
        });
        all.push(came);
        session.0.interrupted()
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

fn text(motions: &Motions<'_>, engine: &mut dyn Engine, session: &mut Session<'_>, all: &mut Vec<Came>) -> String {
    let model = engine.model();
    let watch = session.watch();
    let mut out = String::new();
    for (place, choice) in motions.choices.iter().enumerate() {
        let came = motions.follow(place, engine, (&watch, false), |walk| walk.kept());
        if let Ok(moved) = &came.moved
            && moved.columns.first().is_some_and(|times| !times.is_empty())
        {
            motions.rows.set(motions.rows.get() + moved.columns[0].len());
            if place > 0 {
                out.push('\n');
            }
            out.push_str(&table(motions, model, choice, moved));
        }
        all.push(Came { rows: came.moved.as_ref().map_or(0, |moved| moved.columns[0].len()), ..came });
        if watch.interrupted() {
            break;
        }
    }
    out
}

fn table(motions: &Motions<'_>, model: &Model, choice: &Choice, moved: &Moved) -> String {
    let names = motions.measures.iter().map(|measure| measure.name().to_owned());
    let columns: Vec<grid::Column> = names.zip(moved.columns.iter().cloned()).collect();
    let times = &moved.columns[0];
    let [from, to] = [times.first(), times.last()].map(|t| t.map_or_else(String::new, |t| rounded(*t)));
    let angles = if motions.args.angles.degrees { ", angles in degrees" } else { "" };
    let name = choice.name(model);
    let varied = if name.is_empty() { String::new() } else { format!(", {name}") };
    let heading =
        format!("{}{varied}, {} from t = {from} to t = {to}{angles}\n", model.name, count(times.len(), "instant"));
    heading + &grid::text(&columns, if motions.whole { 3 } else { 1 })
}
