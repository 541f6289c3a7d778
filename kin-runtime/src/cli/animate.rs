//! `animate`: the motion as a page for a browser, or as an animated picture.

use super::closures::{self, ChosenClosures};
use super::columns::{column_infos, shown};
use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::followed::{FollowedMotion, Moved};
use super::instants::ArcArgs;
use super::motion_notes::note_motion;
use super::output::{Form, OutputArgs};
use super::places::places;
use super::session::Session;
use super::setup::Setup;
use super::solved::{analysis, note_freedom};
use super::task::{MotionArgs, MotionTask};
use crate::error::SolveError;
use crate::measure::Measure;
use crate::model::Model;
use crate::motion::Motion;
use crate::present::animation::{AnimatedMotion, Animation, ColumnInfo};
use crate::present::drawing::{Scene, Snapshot, Subject};
use crate::present::text::count;
use crate::present::units::ResultUnits;
use crate::state::State;

/// Number of steps without `--steps`.
pub(super) const STEPS: usize = 180;
/// Largest size of all additional assembly modes of a page together, in coordinates times instants, so that pages stay
/// small.
const NUMBERS: usize = 60_000;

/// The mechanism in motion: one page for a browser, or an animated picture
#[derive(Clone, Debug, clap::Args)]
pub(super) struct AnimateArgs {
    #[command(flatten)]
    motion: MotionArgs,
    #[command(flatten)]
    arc: ArcArgs,
    /// Show names in a picture; a page has a switch for them
    #[arg(long)]
    names: bool,
    /// Places that a point is to pass, drawn as crosses: csv with x,y or t,x,y
    #[arg(long, value_name = "FILE")]
    targets: Option<String>,
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
            names.with("animate --out motion.html --set", &names.set, "with a dimension of your own"),
            names.with("animate --out motion.html --mode", &names.mode, "in one assembly mode alone"),
            names
                .arc
                .then(|| names.analysis("animate --along-arc --out motion.html", "through dead centres"))
                .flatten(),
            names.analysis("animate --out motion.html --forces", "with arrows of forces").filter(|_| names.loads),
        ]
    },
    details: "\
The page has the drawing, plots, and controls for time and speed. If the mechanism closes in several
ways, as `modes` lists them, the page has all of them, up to eight, unless --mode chooses one. The
space bar plays and pauses. With --along-arc the motion goes on through dead centres, where the
driver turns back; its steps are numbered, because t increases and decreases.
With --targets the places of a
`design` are shown beside the path of the mechanism that --set @best.json gives.

With --forces, arrows show forces to one scale over the whole motion. Those of joints are red and
act on the body of the second operand; those of drivers (coordinates of bodies, differences of
angles, distances) are violet; loads are blue. Couples are curved arrows with their own scale.

When a motion fails midway, or Ctrl-C ends it, the finished part is written and the status is 1,
or 130.",
};

pub(super) fn run(args: &AnimateArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let task = args.motion.read(&mut ledger, ("animate", &args.output), (STEPS, args.arc), engine, session);
    let targets = args.targets.as_ref().map_or(Ok(Vec::new()), |file| places("--targets", file));
    let targets = ledger.take(targets);
    let (MotionTask { requested, setup, output }, targets) = ledger.close(task.zip(targets))?;
    let engine = &*engine;
    let model = engine.model();
    if model.bodies.is_empty() && model.points.is_empty() {
        let what = "it has no bodies and no points, only scalar coordinates: `sweep` and `plot` show those";
        return Err(Failure::Analysis(format!("{}: there is nothing to draw; {what}", model.name)));
    }
    if args.forces && model.forces.is_none() {
        return Err(analysis(engine, &SolveError::NoLoads { mechanism: model.name }));
    }
    let instants = requested.instants(engine, &setup)?;
    // A page has no room for velocity ratios.
    let measures: Vec<Measure> = Measure::all(model).split_off(1);
    let watch = session.watch();
    // A picture shows one motion, and an arc goes through several closures.
    let along_arc = instants.arc.is_some();
    let one = !setup.modes.is_empty() || matches!(output.form, Form::Svg) || along_arc;
    let room = NUMBERS / (model.coordinates.len() * instants.len()).max(1);
    let most = if one { 0 } else { (closures::MAX_MOTIONS - 1).min(room) };
    watch.begin("instants", (1 + most) * instants.len());
    let walk = args.motion.walk(engine, (&requested, &setup, &instants), &measures, &watch);
    let walk = FollowedMotion { reported: true, tells_missing: args.forces, ..walk };
    let moved = walk.with_states()?;
    note_motion(session, &moved, None);
    let Moved { trajectory, motions, columns, mut ended, open, .. } = moved;
    note_freedom(session, open);
    let Some(first) = trajectory.states.first() else { return ended.map_or(Ok(()), Err) };
    let choice = match one || ended.is_some() {
        true => ChosenClosures::requested_alone(engine, first),
        false => ChosenClosures::all(engine, &setup, first, most),
    };
    let note = ended.as_ref().map(|failure| early(model, failure));
    let degrees = args.motion.angles.degrees;
    let drawn = Drawn { engine, targets: &targets, forces: args.forces };
    let mut runs = vec![drawn.run(&setup, (&trajectory.states, &motions, along_arc), columns, choice.name, note)?];
    for (index, (name, other_setup)) in choice.other_motions.iter().enumerate() {
        watch.go_on((1 + index) * instants.len());
        // Other modes that do not close are left out. That is no error, since the requested motion exists.
        let Ok(also) = (FollowedMotion { setup: other_setup, ..walk }).with_states() else { continue };
        let states = &also.trajectory.states;
        if watch.interrupted() {
            ended =
                Some(Failure::Interrupted(format!("{index} of {} other modes finished", choice.other_motions.len())));
            break;
        }
        if states.len() > 1 {
            let note = also.ended.as_ref().map(|failure| early(model, failure));
            runs.push(drawn.run(other_setup, (states, &also.motions, false), also.columns, name.clone(), note)?);
        }
    }
    watch.end();
    let units = ResultUnits::of(model).in_degrees(degrees);
    let columns = column_infos(units, &measures);
    let shown = shown(model, &runs[0].columns);
    let along = if along_arc { "step" } else { "t" };
    let time = units.time().filter(|_| !along_arc).map(str::to_owned);
    let force = model.forces.and_then(|forces| forces.units.force);
    let (length, drivers) = (model.units.length.map(str::to_owned), drivers(model, &columns));
    let animation = Animation { model, runs, drivers, columns, shown, length, along, time, force };
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

/// Largest number of driven quantities whose values are shown beside the time.
const DRIVERS: usize = 3;

/// The columns of the driven quantities.
fn drivers(model: &'static Model, columns: &[ColumnInfo]) -> Vec<usize> {
    let index = |driven: Measure| columns.iter().position(|column| column.name == driven.name());
    Measure::driven(model).into_iter().filter_map(index).take(DRIVERS).collect()
}

/// What the motions of a page or a picture have in common.
struct Drawn<'a> {
    engine: &'a dyn Engine,
    /// Places that a point is to pass.
    targets: &'a [[f64; 2]],
    /// Whether forces are shown as arrows.
    forces: bool,
}

impl Drawn<'_> {
    /// A motion with its drawing and its numbers. Along an arc, instants are equally spaced, whatever their times are.
    fn run(
        &self,
        setup: &Setup,
        (states, motions, along_arc): (&[State], &[Motion], bool),
        columns: Vec<Vec<f64>>,
        name: String,
        note: Option<String>,
    ) -> Result<AnimatedMotion, Failure> {
        let pairs = states.iter().zip(motions);
        let mut snapshots: Vec<Snapshot> =
            pairs.map(|(state, motion)| self.snapshot(setup, state, motion)).collect::<Result<_, _>>()?;
        if along_arc {
            by_steps(&mut snapshots);
        }
        let engine = self.engine;
        let curve = |instant: usize, joint: usize, s: f64| engine.curve(&states.get(instant)?.instant(), joint, s);
        let subject = Subject { model: engine.model(), snapshots: &snapshots, curve: &curve, targets: self.targets };
        let scene = Scene::new(&subject);
        Ok(AnimatedMotion { name, note, scene, columns })
    }

    fn snapshot(&self, setup: &Setup, state: &State, motion: &Motion) -> Result<Snapshot, Failure> {
        let engine = self.engine;
        let geometry = engine.geometry(&state.instant()).map_err(|error| analysis(engine, &error))?;
        Ok(Snapshot {
            t: state.t,
            bodies: motion.bodies.iter().map(|body| [body.x, body.y, body.phi]).collect(),
            q: state.q.clone(),
            points: motion.points.iter().map(|point| point.r).collect(),
            velocities: motion.points.iter().map(|point| point.v).collect(),
            geometry,
            forces: motion.forces.as_ref().filter(|_| self.forces).cloned(),
            loads: if self.forces { engine.loads(setup, state).unwrap_or_default() } else { Vec::new() },
        })
    }
}

/// Replaces times by the numbers of the instants, and velocities by central differences with respect to these numbers.
fn by_steps(snapshots: &mut [Snapshot]) {
    let places: Vec<Vec<[f64; 2]>> = snapshots.iter().map(|snapshot| snapshot.points.clone()).collect();
    for (k, snapshot) in snapshots.iter_mut().enumerate() {
        snapshot.t = k as f64;
        let (before, after) = (k.saturating_sub(1), (k + 1).min(places.len() - 1));
        let steps = (after - before).max(1) as f64;
        let pairs = places[before].iter().zip(&places[after]);
        snapshot.velocities = pairs.map(|(p, q)| [0, 1].map(|axis| (q[axis] - p[axis]) / steps)).collect();
    }
}
