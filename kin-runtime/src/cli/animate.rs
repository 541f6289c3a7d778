//! `animate`: the motion as a page for a browser, or as a picture that moves.

use std::path::Path;

use super::columns::{column_infos, shown};
use super::engine::{Engine, Setup};
use super::failure::Failure;
use super::moving::{GridArgs, Moved, motions, moved, natural_end, note_motion};
use super::options::{FreedomArgs, SetupArgs};
use super::session::Session;
use super::solved::note_freedom;
use crate::model::Model;
use crate::motion::Motion;
use crate::planned::Sign;
use crate::present::animation::{Animation, Run};
use crate::present::drawing::{Scene, Snapshot, Subject};
use crate::present::grid::columns;
use crate::present::text::count;
use crate::present::units::Units;
use crate::state::State;

/// Steps when --steps is not there.
const STEPS: usize = 180;
/// Assembly modes that one page shows at most.
const MODES: usize = 8;
/// Coordinates of all instants that the modes besides the one asked for may have together, so that pages stay small.
const NUMBERS: usize = 60_000;

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
    let times = args.grid.times(|from| Some(natural_end(engine, &setup, from)), STEPS)?;
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
    let columns = column_infos(model, &names_of(engine, &trajectory.states)?);
    let shown = shown(model, &runs[0].columns);
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

/// The names of the columns besides t.
fn names_of(engine: &dyn Engine, states: &[State]) -> Result<Vec<String>, Failure> {
    let first = states.get(..1).unwrap_or_default();
    Ok(columns(engine.model(), first, &motions(engine, first)?).into_iter().skip(1).map(|(name, _)| name).collect())
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
