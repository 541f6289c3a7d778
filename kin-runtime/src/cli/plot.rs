//! `plot`: diagrams of a motion as a file.

use super::columns::{bend, column_infos, shown};
use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::followed::Moved;
use super::instants::ArcArgs;
use super::motion_notes::note_motion;
use super::names::find_quantity;
use super::output::{Form, OutputArgs};
use super::session::Session;
use super::solved::note_freedom;
use super::task::{MotionArgs, MotionTask};
use super::tolerance::{Slopes, tolerances};
use super::trial::quoted;
use super::vary::VaryArgs;
use crate::measure::Measure;
use crate::model::Model;
use crate::present::animation::ColumnInfo;
use crate::present::plot::{Curve, Diagram, Mark, Panel};
use crate::present::text::count;
use crate::present::units::ResultUnits;

/// Number of steps without `--steps`.
pub(super) const STEPS: usize = 360;

/// Diagrams of the motion: quantities over time, against one another, paths of points
#[derive(Clone, Debug, clap::Args)]
pub(super) struct PlotArgs {
    /// NAME over time, X:Y, or a point's or a body's path [default: chosen by what moves]
    #[arg(value_name = "WHAT")]
    what: Vec<String>,
    #[command(flatten)]
    vary: VaryArgs,
    #[command(flatten)]
    motion: MotionArgs,
    /// Tolerances of parameters, NAME=D on either side: bands of the worst case
    #[arg(long, value_name = "NAME=D")]
    tolerance: Vec<String>,
    #[command(flatten)]
    arc: ArcArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// A curve to be drawn: its columns by their indices; column 0 is t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct PlottedCurve {
    x: usize,
    y: usize,
    path: bool,
}

/// The motion at one combination of the varied parameters.
struct Curves {
    /// `l1 = 0.1`; empty if nothing varies.
    name: String,
    columns: Vec<Vec<f64>>,
    /// For every quantity that is drawn over time, the worst case of tolerances; empty without tolerances.
    worst: Vec<Vec<f64>>,
    /// The names of the limits at its first and at its last instant, if it begins or ends at one.
    limits: [Option<String>; 2],
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let coordinate = names.coordinate.unwrap_or("t");
        let (value, rate) = (quoted(coordinate.to_owned()), quoted(format!("{coordinate}_dot")));
        let phase = quoted(format!("{coordinate}:{coordinate}_dot"));
        let path = names.path.map(|path| format!("plot {path} --out path.svg"));
        let paths = names
            .path
            .zip(names.vary.as_ref())
            .map(|(path, vary)| format!("plot {path} --vary {vary} --out paths.svg"));
        vec![
            names.analysis("plot --out motion.svg", "diagrams of what moves"),
            names.analysis(&format!("plot {value} {rate} --to {} --out motion.png", names.to), ""),
            path.and_then(|line| names.analysis(&line, "the path of a point")),
            names.analysis(&format!("plot {phase} --out phase.svg"), "the second against the first"),
            paths.and_then(|line| names.analysis(&line, "a curve for each of five values")),
            names.path.filter(|_| names.arc).and_then(|path| {
                names.analysis(
                    &format!("plot {path} --along-arc --out curve.svg"),
                    "its whole path, through dead centres",
                )
            }),
            names.tolerance.as_ref().filter(|_| names.determined).and_then(|tolerance| {
                names.analysis(
                    &format!("plot {value} --tolerance {tolerance} --out band.svg"),
                    "a band of the worst case",
                )
            }),
        ]
    },
    details: "\
Quantities are the columns of `sweep --points`: a coordinate, its rate (NAME_dot), its
acceleration (NAME_ddot), and those of points (NAME.x, NAME.speed), defines, joints, inputs and
forces, transmission angles (B.transmission) and velocity ratios (tip.x/drive). Quantities with the
same unit share a diagram. The name of a joint, or `shaking`, gives the polar diagram of its force:
the path of the tip of the force vector.

--along-arc goes on through dead centres, where the driver turns back: the whole path of a point.

With --tolerance quantities over time have a band: by how much they deviate when all dimensions are
at their limits, to first order.

--vary may be repeated, for one curve for each combination of values. With --to limit (and --from
limit) curves end where the mechanism can go no further, at a mark that the legend explains.
Without --out the SVG goes to stdout.

When a motion fails midway, or Ctrl-C ends it, its finished part is drawn and the status is 1,
or 130.",
};

/// Largest number of curves of one diagram, and why.
const MAX_CURVES: (usize, &str) = (14, "more curves cannot be told apart");

pub(super) fn run(args: &PlotArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let model = engine.model();
    let mut ledger = Ledger::default();
    let task = args.motion.read(&mut ledger, ("plot", &args.output), (STEPS, args.arc), engine, session);
    let choices = ledger.take(args.vary.choices(model, MAX_CURVES));
    // Unknown names are reported before the motion is computed.
    let mut measures = Measure::standard(model, args.what.is_empty());
    let wanted = ledger.take(wanted(model, &args.what, &mut measures));
    let tolerances = ledger.take(tolerances(&args.tolerance, model));
    if !args.tolerance.is_empty() && args.what.is_empty() {
        ledger.fault("--tolerance", "name the quantities: plot NAME --tolerance …");
    }
    let (task, ((choices, wanted), tolerances)) = ledger.close(task.zip(choices.zip(wanted).zip(tolerances)))?;
    let toleranced = if args.tolerance.is_empty() { None } else { Some((&wanted[..], &tolerances[..])) };
    let watch = session.watch();
    let (mut runs, mut failure) = (Vec::new(), None);
    for (index, choice) in choices.iter().enumerate() {
        choice.set(engine);
        let name = choice.name(model);
        let place = ((index, choices.len()), (choices.len() > 1).then_some(name.as_str()));
        let one = one(args, &*engine, &task, (&measures, toleranced), place, session);
        match one {
            Ok((columns, worst, limits, ended)) => {
                runs.push(Curves { name, columns, worst, limits });
                failure = failure.or(ended);
            }
            // If one of several motions does not assemble, the others are still drawn.
            Err(error) if choices.len() > 1 => {
                session.note(&format!("note: {name}: {error}"));
                failure = failure.or(Some(error));
            }
            Err(error) => return Err(error),
        }
        if watch.interrupted() {
            let motions = count(choices.len(), "motion");
            failure = Some(Failure::Interrupted(format!("{index} of {motions} finished, the next one in part")));
            break;
        }
    }
    watch.end();
    let Some(first) = runs.first() else { return failure.map_or(Ok(()), Err) };
    let units = ResultUnits::of(model).in_degrees(args.motion.angles.degrees);
    let infos = column_infos(units, &measures[1..]);
    let names: Vec<String> = infos.iter().map(|info| info.name.clone()).collect();
    let beside = wanted.is_empty();
    let wanted = if beside { default_curves(model, &names, &infos, &first.columns) } else { wanted };
    // An empty diagram would hide that there is nothing to draw.
    let undefined = |k: usize| k > 0 && runs.iter().all(|run| run.columns[k].iter().all(|value| !value.is_finite()));
    if let Some(k) = wanted.iter().flat_map(|want| [want.x, want.y]).find(|&k| undefined(k)) {
        let message = "has no value in all of the motion: it is undetermined, or not defined there";
        return Err(Failure::Analysis(format!("{}: `{}` {message}", model.name, infos[k - 1].name)));
    }
    let diagram = Diagram { title: model.name.to_owned(), panels: panels(units, &wanted, &infos, &runs), beside };
    let bytes = match task.output.form {
        Form::Png => diagram.png().map_err(Failure::Output)?,
        _ => diagram.svg().into_bytes(),
    };
    session.deliver_bytes(&task.output, &bytes)?;
    failure.map_or(Ok(()), Err)
}

/// The columns, t first, worst cases of what is drawn, the limits at both ends, and why the motion ended early.
type Numbers = (Vec<Vec<f64>>, Vec<Vec<f64>>, [Option<String>; 2], Option<Failure>);

/// The curves that are drawn, and the tolerances of the parameters.
type Toleranced<'a> = (&'a [PlottedCurve], &'a [f64]);

fn one(
    args: &PlotArgs,
    engine: &dyn Engine,
    task: &MotionTask<'_>,
    (measures, toleranced): (&[Measure], Option<Toleranced<'_>>),
    (place, name): ((usize, usize), Option<&str>),
    session: &mut Session<'_>,
) -> Result<Numbers, Failure> {
    let instants = task.requested.instants(engine, &task.setup)?;
    let watch = session.watch();
    watch.begin_motion(place, instants.len());
    let moved = args.motion.walk(engine, (&task.requested, &task.setup, &instants), measures, &watch).with_states()?;
    note_motion(session, &moved, name);
    let Moved { trajectory, columns, ended, open, .. } = moved;
    note_freedom(session, open);
    let mut worst = Vec::new();
    if let Some((wanted, tolerances)) = toleranced {
        let drawn: Vec<Measure> = wanted.iter().map(|want| measures[want.y].clone()).collect();
        let slopes = Slopes::along(engine, &task.setup, &trajectory.states, &drawn, args.motion.angles.degrees)?;
        slopes.all_exist(engine.model(), &drawn)?;
        let worst_of = |k| slopes.deviations(k, tolerances).into_iter().map(|deviation| deviation.worst).collect();
        worst.extend((0..drawn.len()).map(worst_of));
    }
    if ended.as_ref().is_some_and(|failure| !matches!(failure, Failure::Interrupted(_))) {
        let (states, instants) = (columns[0].len(), count(instants.len(), "instant"));
        session.note(&format!("the motion ended early: {states} of {instants} drawn"));
    }
    let limits = instants.limits.each_ref().map(|stop| stop.as_ref().map(|stop| stop.name.clone()));
    let limits = if ended.is_none() { limits } else { [None, None] };
    Ok((columns, worst, limits, ended))
}

/// The curves that are drawn by default: the path of the first point that moves, and the coordinate that varies most
/// among those that are not linear in time; without such a point a coordinate and its rate.
fn default_curves(model: &Model, names: &[String], infos: &[ColumnInfo], numbers: &[Vec<f64>]) -> Vec<PlottedCurve> {
    let range = |k: usize| {
        let values = numbers.get(k).map_or(&[][..], Vec::as_slice).iter();
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(*x), high.max(*x)));
        (high - low).max(0.0)
    };
    let index = |name: &str| names.iter().position(|other| other == name).map(|k| k + 1);
    let paths = model
        .points
        .iter()
        .filter_map(|point| Some((index(&format!("{}.x", point.name))?, index(&format!("{}.y", point.name))?)));
    let paths: Vec<(usize, usize)> = paths.filter(|&(x, y)| range(x).max(range(y)) > 0.0).collect();
    let Some(&(x, y)) = paths.first() else {
        return shown(model, &numbers[1..]).into_iter().map(|k| PlottedCurve { x: 0, y: k + 1, path: false }).collect();
    };
    // Lengths are compared with the largest of the paths, angles with a radian.
    let size = paths.iter().map(|&(x, y)| range(x).max(range(y))).fold(0.0, f64::max);
    let unit = |k: usize| match infos[k - 1].unit.as_deref() {
        Some("rad") => 1.0,
        Some("°" | "deg") => 180.0 / core::f64::consts::PI,
        _ => size,
    };
    let moves = |k: usize| range(k) / unit(k);
    // A coordinate that is linear in time, as the angle of a crank at constant speed is, needs no diagram.
    let coordinates = (0..model.coordinates.len()).map(|k| 3 * k + 1);
    let bent = coordinates.filter(|&k| numbers.get(k).is_some_and(|values| bend(values) > 1e-9 * unit(k)));
    let most = bent.max_by(|&a, &b| moves(a).total_cmp(&moves(b)).then(b.cmp(&a)));
    let most = most.map(|y| PlottedCurve { x: 0, y, path: false });
    std::iter::once(PlottedCurve { x, y, path: true }).chain(most).collect()
}

/// The requested curves; columns that are not standard are added to `measures`. All errors are reported at once.
fn wanted(
    model: &'static Model,
    written: &[String],
    measures: &mut Vec<Measure>,
) -> Result<Vec<PlottedCurve>, Failure> {
    let carried = || model.points.iter().map(|p| p.name).chain(model.bodies.iter().map(|b| b.name));
    let mut index = |measure: Measure| {
        let found = measures.iter().position(|other| *other == measure);
        found.unwrap_or_else(|| {
            measures.push(measure);
            measures.len() - 1
        })
    };
    let mut ledger = Ledger::default();
    let mut wanted = Vec::new();
    for written in written {
        if let Some((x, y)) = written.split_once(':') {
            // The two components of a force are drawn with equal axes.
            let path = x.strip_suffix(".force_x").is_some_and(|joint| y.strip_suffix(".force_y") == Some(joint));
            let [x, y] = [x, y].map(|name| ledger.take(find_quantity(model, "WHAT", name)));
            wanted.extend(x.zip(y).map(|(x, y)| PlottedCurve { x: index(x), y: index(y), path }));
            continue;
        }
        let axis = |axis: &str| Measure::named(model, &format!("{written}.{axis}"));
        if let (None, true, Some(x), Some(y)) =
            (Measure::named(model, written), carried().any(|name| name == written), axis("x"), axis("y"))
        {
            wanted.push(PlottedCurve { x: index(x), y: index(y), path: true });
            continue;
        }
        if let (None, Some(x), Some(y)) = (Measure::named(model, written), axis("force_x"), axis("force_y")) {
            wanted.push(PlottedCurve { x: index(x), y: index(y), path: true });
            continue;
        }
        let found = ledger.take(find_quantity(model, "WHAT", written));
        wanted.extend(found.map(|y| PlottedCurve { x: 0, y: index(y), path: false }));
    }
    ledger.close(Some(wanted))
}

/// The panels of the diagram; curves with the same axes share one.
fn panels(units: ResultUnits, wanted: &[PlottedCurve], infos: &[ColumnInfo], runs: &[Curves]) -> Vec<Panel> {
    let time = units.time();
    let name = |k: usize| if k == 0 { "t" } else { infos[k - 1].name.as_str() };
    let unit = |k: usize| if k == 0 { time } else { infos[k - 1].unit.as_deref() };
    let mut panels: Vec<(Vec<PlottedCurve>, Panel)> = Vec::new();
    for (index, &want) in wanted.iter().enumerate() {
        let curves = runs.iter().map(|run| {
            let points = run.columns[want.x].iter().copied().zip(run.columns[want.y].iter().copied());
            let curve_name =
                if want.path { name(want.y).trim_end_matches("_y").trim_end_matches(".y") } else { name(want.y) };
            let names: Vec<&str> = [curve_name, &run.name]
                .into_iter()
                .filter(|name| !name.is_empty() && (wanted.len() > 1 || *name != curve_name))
                .collect();
            let name = if names.is_empty() { curve_name.to_owned() } else { names.join(", ") };
            let bands = run.worst.get(index).filter(|_| !want.path && want.x == 0);
            let (name, band) = match bands {
                Some(halves) => (format!("{name}, worst case"), halves.clone()),
                None => (name, Vec::new()),
            };
            Curve { name, points: points.collect(), band }.with_gaps()
        });
        let curves: Vec<Curve> = curves.collect();
        let alike = |other: &PlottedCurve| {
            let same = unit(other.y) == unit(want.y) && unit(want.y).is_some();
            other.path == want.path && same && (want.path || other.x == want.x && want.x == 0)
        };
        if let Some((members, panel)) = panels.iter_mut().find(|(members, _)| members.iter().all(alike)) {
            members.push(want);
            panel.curves.extend(curves);
            mark_limits(&mut panel.marks, want, runs);
            continue;
        }
        let labels = [want.x, want.y].map(|k| Panel::label(name(k), unit(k)));
        let mut marks = Vec::new();
        mark_limits(&mut marks, want, runs);
        panels.push((vec![want], Panel { labels, equal: want.path, curves, marks }));
    }
    panels.into_iter().map(|(members, panel)| shared_labels(members.len(), panel, &members, &unit)).collect()
}

/// Marks the ends of curves that are limits, if the quantities have values there.
fn mark_limits(marks: &mut Vec<Mark>, want: PlottedCurve, runs: &[Curves]) {
    for run in runs {
        let (xs, ys) = (&run.columns[want.x], &run.columns[want.y]);
        let ends = [(xs.first(), ys.first()), (xs.last(), ys.last())];
        for (limit, end) in run.limits.iter().zip(ends) {
            let (Some(name), (Some(&x), Some(&y))) = (limit, end) else { continue };
            if !(x.is_finite() && y.is_finite()) {
                continue;
            }
            match marks.iter_mut().find(|mark| mark.name == *name) {
                Some(mark) => mark.points.push((x, y)),
                None => marks.push(Mark { name: name.clone(), points: vec![(x, y)] }),
            }
        }
    }
}

/// The labels of a panel with several quantities: units, without the names of quantities.
fn shared_labels<'u>(
    count: usize,
    panel: Panel,
    members: &[PlottedCurve],
    unit: &dyn Fn(usize) -> Option<&'u str>,
) -> Panel {
    if count < 2 {
        return panel;
    }
    let label = |k: usize, path: &str| Panel::label(path, unit(k));
    let [x, y] = [members[0].x, members[0].y];
    let labels = match panel.equal {
        true => [label(x, "x"), label(y, "y")],
        false => [panel.labels[0].clone(), unit(y).map_or_else(String::new, |unit| format!("in {unit}"))],
    };
    Panel { labels, ..panel }
}
