//! `animate`: the motion as a page for a browser, or as an animated picture.

use super::columns::{column_infos, shown};
use super::engine::{Engine, Setup};
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::moving::{Moved, Walk, note_motion};
use super::output::{Form, OutputArgs};
use super::session::Session;
use super::solved::{analysis, note_freedom};
use super::task::{MotionArgs, Task};
use crate::error::SolveError;
use crate::measure::Measure;
use crate::model::Model;
use crate::motion::Motion;
use crate::planned::Sign;
use crate::present::animation::{Animation, ColumnInfo, Run};
use crate::present::drawing::{Scene, Snapshot, Subject};
use crate::present::text::count;
use crate::present::units::Units;
use crate::state::State;

/// Number of steps without `--steps`.
pub(super) const STEPS: usize = 180;
/// Most assembly modes on one page.
const MODES: usize = 8;
/// Most numbers (coordinates times instants) in all additional assembly modes of a page together, so that pages stay
/// small.
const NUMBERS: usize = 60_000;

/// The mechanism in motion: one page for a browser, or an animated picture
#[derive(Clone, Debug, clap::Args)]
pub(super) struct AnimateArgs {
    #[command(flatten)]
    motion: MotionArgs,
    /// Show names in a picture; a page has a switch for them
    #[arg(long)]
    names: bool,
    /// Show forces of joints, drivers and loads as arrows
    #[arg(long)]
    forces: bool,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        if !names.drawn {
            return Vec::new();
        }
        vec![
            names.analysis("animate --out motion.html", "one turn of the driven crank"),
            names.analysis(&format!("animate --out motion.html --to {} --steps 400", names.to), ""),
            names.analysis("animate --out motion.svg", "a picture that moves, for a document"),
            names.with("animate --out motion.html --set", &names.set, "with another dimension"),
            names.with("animate --out motion.html --mode", &names.mode, "in one assembly mode alone"),
            names.analysis("animate --out motion.html --forces", "with arrows of forces").filter(|_| names.loads),
        ]
    },
    details: "\
The page has the drawing, plots, and controls for time and speed. If the mechanism can be assembled
in several modes, the page has all of them, up to eight, unless --mode chooses one. The space bar
plays and pauses.

With --forces, arrows show forces to one scale over the whole motion. Those of joints are red and
act on the body of the second operand; those of drivers (coordinates of bodies, differences of
angles, distances) are violet; loads are blue. Couples are curved arrows with their own scale.

When a motion fails midway, or Ctrl-C ends it, the finished part is written and the status is 1,
or 130.",
};

pub(super) fn run(args: &AnimateArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let task = args.motion.read(&mut ledger, ("animate", &args.output), STEPS, engine, session);
    let Task { asked, setup, output } = ledger.close(task)?;
    let engine = &*engine;
    let model = engine.model();
    if model.bodies.is_empty() && model.points.is_empty() {
        let what = "it has no bodies and no points, only scalar coordinates: `sweep` and `plot` show those";
        return Err(Failure::Analysis(format!("{}: there is nothing to draw; {what}", model.name)));
    }
    if args.forces && model.forces.is_none() {
        return Err(analysis(engine, &SolveError::NoLoads { mechanism: model.name }));
    }
    let instants = asked.instants(engine, &setup)?;
    // A page has no room for velocity ratios.
    let measures: Vec<Measure> = Measure::all(model).split_off(1);
    let watch = session.watch();
    // A picture shows one motion.
    let one = !setup.modes.is_empty() || matches!(output.form, Form::Svg);
    let room = NUMBERS / (model.coordinates.len() * instants.len()).max(1);
    let most = if one { 0 } else { ((1 << model.plan.modes.len().min(MODES.ilog2() as usize)) - 1).min(room) };
    watch.begin("instants", (1 + most) * instants.len());
    let walk = args.motion.walk(engine, (&asked, &setup, &instants), &measures, &watch);
    let walk = Walk { reported: true, ..walk };
    let moved = walk.kept()?;
    note_motion(session, &moved);
    let Moved { trajectory, motions, columns, mut ended, left, .. } = moved;
    note_freedom(session, left);
    let Some(first) = trajectory.states.first() else { return ended.map_or(Ok(()), Err) };
    let own = engine.modes(&first.instant(), &first.q);
    let own: Vec<Sign> = own.iter().map(|mode| mode.sign.unwrap_or(Sign::Plus)).collect();
    let note = ended.as_ref().map(|failure| early(model, failure));
    let degrees = args.motion.angles.degrees;
    let mut runs = vec![run_of(
        engine,
        &setup,
        (&trajectory.states, &motions),
        args.forces,
        columns,
        mode_name(model, &own, &own),
        note,
    )?];
    if !one && ended.is_none() {
        let others: Vec<Vec<Sign>> = others(&own).into_iter().take(room).collect();
        for (place, other) in others.iter().enumerate() {
            watch.go_on((1 + place) * instants.len());
            let asked = Setup { modes: other.iter().copied().enumerate().collect(), ..setup.clone() };
            // Other modes that do not close are left out: they are no error of the motion that was asked for.
            let Ok(also) = (Walk { setup: &asked, ..walk }).kept() else { continue };
            let (states, name) = (&also.trajectory.states, mode_name(model, &own, other));
            if watch.interrupted() {
                ended = Some(Failure::Interrupted(format!("{place} of {} other modes finished", others.len())));
                break;
            }
            if states.len() > 1 {
                let note = also.ended.as_ref().map(|failure| early(model, failure));
                runs.push(run_of(engine, &asked, (states, &also.motions), args.forces, also.columns, name, note)?);
            }
        }
    }
    watch.end();
    let units = Units::of(model).in_degrees(degrees);
    let columns = column_infos(units, &measures);
    let shown = shown(model, &runs[0].columns);
    let (time, length) = (units.time().map(str::to_owned), model.units.length.map(str::to_owned));
    let force = model.forces.and_then(|forces| forces.units.force);
    let animation = Animation { model, runs, drivers: drivers(model, &columns), columns, shown, length, time, force };
    let text = match output.form {
        Form::Svg => animation.picture(args.names),
        _ => animation.page().map_err(Failure::Output)?,
    };
    session.deliver_bytes(&output, text.as_bytes())?;
    match ended {
        None => Ok(()),
        Some(interrupted @ Failure::Interrupted(_)) => Err(interrupted),
        Some(failure) => {
            let (states, instants) = (trajectory.states.len(), count(instants.len(), "instant"));
            session.note(&format!("the motion ended early: {states} of {instants} written"));
            Err(failure)
        }
    }
}

/// A short sentence for the page about a motion that ended early; the command prints the whole error.
fn early(model: &Model, failure: &Failure) -> String {
    if let Failure::Interrupted(how_far) = failure {
        return format!("The motion was interrupted: {how_far}.");
    }
    let text = failure.to_string();
    let text = text.strip_prefix(model.name).and_then(|rest| rest.strip_prefix(": ")).unwrap_or(&text);
    let sentence = text.split(": ").next().and_then(|first| first.lines().next()).unwrap_or(text);
    format!("The motion ends early: {sentence}.")
}

/// Most driven quantities whose values are shown beside the time.
const DRIVERS: usize = 3;

/// The columns of the driven quantities.
fn drivers(model: &'static Model, columns: &[ColumnInfo]) -> Vec<usize> {
    let place = |driven: Measure| columns.iter().position(|column| column.name == driven.name());
    Measure::driven(model).into_iter().filter_map(place).take(DRIVERS).collect()
}

/// All other combinations of signs of the first few modes.
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

/// The name of a mode: its signs if there are at most two, otherwise those that differ from the first motion.
fn mode_name(model: &Model, own: &[Sign], signs: &[Sign]) -> String {
    let few = signs.len() <= 2;
    let modes = model.plan.modes.iter().zip(own).zip(signs);
    let told = modes.filter(|((_, own), sign)| few || own != sign);
    let names: Vec<String> = told.map(|((mode, _), sign)| format!("{} {sign}", mode.name)).collect();
    if names.is_empty() { "as assembled".to_owned() } else { names.join(", ") }
}

/// A motion with its drawing and its numbers.
fn run_of(
    engine: &dyn Engine,
    setup: &Setup,
    (states, motions): (&[State], &[Motion]),
    forces: bool,
    columns: Vec<Vec<f64>>,
    name: String,
    note: Option<String>,
) -> Result<Run, Failure> {
    let snapshots: Vec<Snapshot> = states
        .iter()
        .zip(motions)
        .map(|(state, motion)| snapshot(engine, setup, state, motion, forces))
        .collect::<Result<_, _>>()?;
    let curve = |instant: usize, joint: usize, s: f64| engine.curve(&states.get(instant)?.instant(), joint, s);
    let subject = Subject { model: engine.model(), snapshots: &snapshots, curve: &curve };
    let scene = Scene::new(&subject);
    Ok(Run { name, note, scene, columns })
}

fn snapshot(
    engine: &dyn Engine,
    setup: &Setup,
    state: &State,
    motion: &Motion,
    forces: bool,
) -> Result<Snapshot, Failure> {
    let geometry = engine.geometry(&state.instant()).map_err(|error| analysis(engine, &error))?;
    Ok(Snapshot {
        t: state.t,
        bodies: motion.bodies.iter().map(|body| [body.x, body.y, body.phi]).collect(),
        q: state.q.clone(),
        points: motion.points.iter().map(|point| point.r).collect(),
        velocities: motion.points.iter().map(|point| point.v).collect(),
        geometry,
        forces: motion.forces.as_ref().filter(|_| forces).cloned(),
        loads: if forces { engine.loads(setup, state).unwrap_or_default() } else { Vec::new() },
    })
}
