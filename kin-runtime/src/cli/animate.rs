//! `animate`: the motion as a page for a browser, or as a picture that moves.

use std::f64::consts::TAU;
use std::path::Path;

use super::engine::{Engine, Setup};
use super::failure::Failure;
use super::moving::{GridArgs, Moved, motions, moved, note_motion};
use super::options::{FreedomArgs, SetupArgs};
use super::session::Session;
use super::solved::{driven_state, note_freedom};
use crate::model::{Component, CoordinateKind, Model};
use crate::motion::Motion;
use crate::planned::Sign;
use crate::present::animation::{Animation, ColumnInfo, Run};
use crate::present::drawing::{Scene, Snapshot, Subject};
use crate::present::grid::columns;
use crate::present::text::count;
use crate::present::units::{Measure, Units};
use crate::state::State;

/// Steps when --steps is not there.
const STEPS: usize = 180;
/// Assembly modes that one page shows at most.
const MODES: usize = 8;
/// Coordinates of all instants that the modes besides the one asked for may have together, so that pages stay small.
const NUMBERS: usize = 60_000;
/// The end of a motion that has no period.
const END: f64 = 1.0;

/// See it move: a page for a browser that needs nothing else (.html), or a moving picture (.svg)
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "\
Examples, after the program's name:
  animate --out motion.html                             one turn of the driven crank, or t = 0 to 1
  animate --out motion.html --to 2 --steps 400
  animate --out motion.html --set l1=0.12 --mode A-B-D=-
  animate --out motion.svg                              a picture that moves, for a document

The page has the drawing, plots that go with it, speed, and a slider for the time; where the mechanism can be
assembled in several modes it has all of them, up to eight, unless --mode says which. Space plays and pauses.
When a motion fails midway the finished part is written and the status is 1.")]
pub(super) struct AnimateArgs {
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    /// The file, whole or not at all; .html or .svg
    #[arg(long, value_name = "FILE")]
    out: Option<std::path::PathBuf>,
}

/// What is written.
enum Form {
    Page,
    Picture,
}

impl AnimateArgs {
    fn form(&self) -> Result<Form, Failure> {
        let Some(path) = self.out.as_deref().filter(|path| *path != Path::new("-")) else { return Ok(Form::Page) };
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("html" | "htm") => Ok(Form::Page),
            Some("svg") => Ok(Form::Picture),
            _ => Err(Failure::option("--out", format!("`{}` should end in .html or .svg", path.display()))),
        }
    }
}

pub(super) fn run(args: &AnimateArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let form = args.form()?;
    let setup = args.setup.apply_complete(engine)?;
    let engine = &*engine;
    let model = engine.model();
    if model.bodies.is_empty() && model.points.is_empty() {
        let what = "it has no bodies and no points, only scalar coordinates: `sweep` and `plot` show those";
        return Err(Failure::Analysis(format!("{}: there is nothing to draw; {what}", model.name)));
    }
    let times = args.grid.times(|from| Some(from + period(engine, &setup, from).unwrap_or(END)), STEPS)?;
    let Moved { trajectory, ended, left } = moved(engine, &setup, &times, false, args.freedom)?;
    note_motion(session, &trajectory);
    note_freedom(session, left);
    let Some(first) = trajectory.states.first() else { return ended.map_or(Ok(()), Err) };
    let own = engine.modes(&first.instant(), &first.q);
    let note = ended.as_ref().map(|failure| format!("The motion ends early: {failure}"));
    let own: Vec<Sign> = own.iter().map(|mode| mode.sign.unwrap_or(Sign::Plus)).collect();
    let mut runs = vec![run_of(engine, &trajectory.states, mode_name(model, &own, &own), note)?];
    if setup.modes.is_empty() && ended.is_none() {
        let room = NUMBERS / (model.coordinates.len() * times.len()).max(1);
        for other in others(&own).into_iter().take(room) {
            let asked = Setup { modes: other.iter().copied().enumerate().collect(), ..setup.clone() };
            // A mode that does not close is no fault of the motion that was asked for.
            let Ok(also) = moved(engine, &asked, &times, false, args.freedom) else { continue };
            if also.trajectory.states.len() > 1 {
                let note = also.ended.map(|failure| format!("The motion ends early: {failure}"));
                runs.push(run_of(engine, &also.trajectory.states, mode_name(model, &own, &other), note)?);
            }
        }
    }
    let columns = column_infos(model, &trajectory.states, engine)?;
    let shown = shown(model, &columns, &runs[0]);
    let time = Units::of(model).time().map(str::to_owned);
    let animation = Animation { model, runs, columns, shown, time };
    let text = match form {
        Form::Page => animation.page().map_err(Failure::Output)?,
        Form::Picture => animation.picture(),
    };
    session.deliver_to(args.out.as_deref(), text.as_bytes())?;
    match ended {
        None => Ok(()),
        Some(failure) => {
            let (states, instants) = (trajectory.states.len(), count(times.len(), "instant"));
            session.note(&format!("the motion ended early: {states} of {instants} written"));
            Err(failure)
        }
    }
}

/// The time that the slowest of the cranks driven at constant speed takes for one turn.
fn period(engine: &dyn Engine, setup: &Setup, from: f64) -> Option<f64> {
    let model = engine.model();
    let (state, _) = driven_state(engine, setup, from, true).ok()?;
    let angle = |column: usize| {
        let kind = model.coordinates.get(column).map(|coordinate| coordinate.kind);
        matches!(kind, Some(CoordinateKind::Pose { component: Component::Phi, .. } | CoordinateKind::Scalar))
    };
    let driven = model.rows.iter().enumerate().filter(|(_, row)| row.driving).filter_map(|(place, _)| {
        let mut entries = model.constraint_pattern.entries.iter().filter(|(row, _)| *row == place);
        match (entries.next(), entries.next()) {
            (Some(&(_, column)), None) if angle(column) => Some(column),
            _ => None,
        }
    });
    let speeds = driven.filter_map(|column| {
        let (speed, acceleration) = (state.q_dot.get(column)?.abs(), state.q_ddot.get(column)?.abs());
        (speed > 0.0 && acceleration <= 1e-9 * speed * speed).then_some(speed)
    });
    let slowest = speeds.fold(f64::INFINITY, f64::min);
    slowest.is_finite().then_some(TAU / slowest)
}

/// All other combinations of signs, few enough to look at.
fn others(own: &[Sign]) -> Vec<Vec<Sign>> {
    let free = own.len().min(MODES.ilog2() as usize);
    let combination = |number: usize| {
        let flip = |(place, sign): (usize, &Sign)| {
            if place < free && number >> place & 1 == 1 { sign.flipped() } else { *sign }
        };
        own.iter().enumerate().map(flip).collect()
    };
    (1..1_usize << free).map(combination).collect()
}

/// The signs where they are few, otherwise those that differ from the first.
fn mode_name(model: &Model, own: &[Sign], signs: &[Sign]) -> String {
    let few = signs.len() <= 2;
    let modes = model.plan.modes.iter().zip(own).zip(signs);
    let told = modes.filter(|((_, own), sign)| few || own != sign);
    let names: Vec<String> = told.map(|((mode, _), sign)| format!("{} {sign}", mode.name)).collect();
    if names.is_empty() { "as assembled".to_owned() } else { names.join(", ") }
}

/// A motion with its drawing and its numbers.
fn run_of(engine: &dyn Engine, states: &[State], name: String, note: Option<String>) -> Result<Run, Failure> {
    let all = motions(engine, states)?;
    let snapshots: Vec<Snapshot> =
        states.iter().zip(&all).map(|(state, motion)| snapshot(engine, state, motion)).collect::<Result<_, _>>()?;
    let curve = |instant: usize, joint: usize, s: f64| engine.curve(&states.get(instant)?.instant(), joint, s);
    let subject = Subject { model: engine.model(), snapshots: &snapshots, curve: &curve };
    let scene = Scene::new(&subject);
    let columns = columns(engine.model(), states, &all).into_iter().skip(1).map(|(_, values)| values).collect();
    Ok(Run { name, note, scene, columns })
}

fn snapshot(engine: &dyn Engine, state: &State, motion: &Motion) -> Result<Snapshot, Failure> {
    let geometry = engine.geometry(&state.instant()).map_err(|error| super::solved::analysis(engine, &error))?;
    Ok(Snapshot {
        t: state.t,
        bodies: motion.bodies.iter().map(|body| [body.x, body.y, body.phi]).collect(),
        q: state.q.clone(),
        points: motion.points.iter().map(|point| point.r).collect(),
        geometry,
    })
}

/// Names and units of the columns: each with its rate and its acceleration.
fn column_infos(model: &'static Model, states: &[State], engine: &dyn Engine) -> Result<Vec<ColumnInfo>, Failure> {
    let units = Units::of(model);
    let first = states.get(..1).unwrap_or_default();
    let names = columns(model, first, &motions(engine, first)?);
    let info = |(k, (name, _)): (usize, (String, Vec<f64>))| {
        let base = name.trim_end_matches("_ddot").trim_end_matches("_dot");
        let measure = match base.rsplit('.').next() {
            Some("x" | "y" | "stroke" | "distance") if base.contains('.') => Measure::Length,
            Some("phi" | "angle" | "theta") if base.contains('.') => Measure::Angle,
            _ => Measure::Unknown,
        };
        ColumnInfo { unit: units.derivative(measure, k % 3), name }
    };
    Ok(names.into_iter().skip(1).enumerate().map(info).collect())
}

/// Two columns that tell something at first: a point's or a coordinate's that is not simply driven, and its rate.
fn shown(model: &Model, columns: &[ColumnInfo], run: &Run) -> Vec<usize> {
    let bends = |k: usize| {
        let Some(values) = run.columns.get(k) else { return 0.0 };
        let (first, last) = (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0));
        let count = (values.len().max(2) - 1) as f64;
        let line = |i: usize| first + (last - first) * i as f64 / count;
        values.iter().enumerate().map(|(i, x)| (x - line(i)).abs()).fold(0.0, f64::max)
    };
    let points = 3 * model.coordinates.len()..3 * (model.coordinates.len() + 2 * model.points.len());
    let coordinates = (0..3 * model.coordinates.len()).rev();
    let candidates = points.chain(coordinates).filter(|k| k % 3 == 0 && *k < columns.len());
    let best = candidates.clone().find(|&k| bends(k) > 1e-9).or_else(|| candidates.clone().next());
    best.map_or_else(Vec::new, |k| vec![k, k + 1])
}
