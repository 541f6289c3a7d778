//! `plot`: diagrams of a motion as a file.

use std::path::{Path, PathBuf};

use super::columns::{column_infos, shown};
use super::engine::{Engine, Setup};
use super::failure::Failure;
use super::moving::{GridArgs, Moved, motions, moved, natural_end, note_motion};
use super::names::{Kind, find};
use super::options::{FreedomArgs, SetupArgs};
use super::session::Session;
use super::solved::note_freedom;
use super::values;
use crate::model::Model;
use crate::present::animation::ColumnInfo;
use crate::present::grid::columns;
use crate::present::number::rounded;
use crate::present::plot::{Curve, Diagram, Panel};
use crate::present::units::Units;

/// Steps when --steps is not there.
const STEPS: usize = 360;

/// Diagrams of the motion: quantities over time, against one another, paths of points (.svg, .png)
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "\
Examples, after the program's name:
  plot --out motion.svg                                 what tells most, over one turn of the driven crank
  plot rocker.phi rocker.phi_dot --to 2 --out rocker.png
  plot tip --out path.svg                               the path of a point or a body's origin, with equal axes
  plot rocker.phi:rocker.phi_dot --out phase.svg        the second against the first
  plot tip --vary l1=0.08..0.12:5 --out paths.svg       one curve for each of five crank lengths
  plot rocker.phi --vary l1=0.08,0.1 --vary l2=0.4,0.5 --out all.svg

Quantities are the columns of `sweep --points`: a coordinate, its rate (name_dot), its acceleration (name_ddot), and
those of points (tip.x), defines and joints. What has one unit shares a diagram. Without --out the SVG goes to stdout.
When a motion fails midway its finished part is drawn and the status is 1.")]
pub(super) struct PlotArgs {
    /// What to plot: NAME over time, X:Y, or a point's or a body's path
    #[arg(value_name = "WHAT")]
    what: Vec<String>,
    /// One curve for each of several values of a parameter: l1=0.08..0.12:5 or l1=0.08,0.1
    #[arg(long, value_name = "NAME=VALUES")]
    vary: Vec<String>,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    /// The file, whole or not at all; .svg or .png
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// What is drawn: columns by their places, the first being t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Wanted {
    x: usize,
    y: usize,
    path: bool,
}

/// A motion at one choice of the varied parameters.
struct Curves {
    /// `l1 = 0.1`; empty where nothing varies.
    name: String,
    columns: Vec<Vec<f64>>,
}

pub(super) fn run(args: &PlotArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let png = is_png(args.out.as_deref())?;
    let setup = args.setup.apply_complete(engine)?;
    let model = engine.model();
    let choices = choices(model, &args.vary)?;
    let times = args.grid.times(|from| Some(natural_end(&*engine, &setup, from)), STEPS)?;
    let (mut names, mut runs, mut failure) = (Vec::new(), Vec::new(), None);
    for choice in &choices {
        for &(place, value) in choice {
            engine.set_parameter(place, value);
        }
        let name = choice_name(model, choice);
        match one(&*engine, &setup, &times, args.freedom, session) {
            Ok((headers, columns, ended)) => {
                names = headers;
                runs.push(Curves { name, columns });
                failure = failure.or(ended);
            }
            // One of several that does not assemble leaves the others as they are.
            Err(error) if choices.len() > 1 => {
                session.note(&format!("note: {name}: {error}"));
                failure = failure.or(Some(error));
            }
            Err(error) => return Err(error),
        }
    }
    if runs.is_empty() {
        return failure.map_or(Ok(()), Err);
    }
    let infos = column_infos(model, &names);
    let wanted = wanted(model, &args.what, &infos, &runs[0].columns)?;
    let diagram = Diagram { title: model.name.to_owned(), panels: panels(model, &wanted, &infos, &runs) };
    let bytes = if png { diagram.png().map_err(Failure::Output)? } else { diagram.svg().into_bytes() };
    session.deliver_to(args.out.as_deref(), &bytes)?;
    failure.map_or(Ok(()), Err)
}

/// By the ending of the file.
fn is_png(out: Option<&Path>) -> Result<bool, Failure> {
    let Some(path) = out.filter(|path| *path != Path::new("-")) else { return Ok(false) };
    match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("svg") => Ok(false),
        Some("png") => Ok(true),
        _ => Err(Failure::option("--out", format!("`{}` should end in .svg or .png", path.display()))),
    }
}

/// Every combination of the values of the parameters that vary; a single empty one where none does.
fn choices(model: &Model, vary: &[String]) -> Result<Vec<Vec<(usize, f64)>>, Failure> {
    let parameters: Vec<&str> = model.parameters.iter().map(|p| p.name).collect();
    let mut choices = vec![Vec::new()];
    for text in vary {
        let (name, values) = values::variation("--vary", text)?;
        let place = find("--vary", Kind::Parameter, &name, &parameters)?;
        let with = |choice: &Vec<(usize, f64)>| -> Vec<Vec<(usize, f64)>> {
            values.iter().map(|&value| choice.iter().copied().chain([(place, value)]).collect()).collect()
        };
        choices = choices.iter().flat_map(with).collect();
    }
    Ok(choices)
}

fn choice_name(model: &Model, choice: &[(usize, f64)]) -> String {
    let one = |&(place, value): &(usize, f64)| format!("{} = {}", model.parameters[place].name, rounded(value));
    choice.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// Names besides t, numbers with t, and why the motion ended early.
type Numbers = (Vec<String>, Vec<Vec<f64>>, Option<Failure>);

fn one(
    engine: &dyn Engine,
    setup: &Setup,
    times: &[f64],
    freedom: FreedomArgs,
    session: &mut Session<'_>,
) -> Result<Numbers, Failure> {
    let Moved { trajectory, ended, left } = moved(engine, setup, times, false, freedom)?;
    note_motion(session, &trajectory);
    note_freedom(session, left);
    let motions = motions(engine, &trajectory.states)?;
    let (names, numbers): (Vec<String>, Vec<Vec<f64>>) =
        columns(engine.model(), &trajectory.states, &motions).into_iter().unzip();
    Ok((names.into_iter().skip(1).collect(), numbers, ended))
}

/// The columns that are asked for; without any, those that tell most.
fn wanted(model: &Model, what: &[String], infos: &[ColumnInfo], numbers: &[Vec<f64>]) -> Result<Vec<Wanted>, Failure> {
    if what.is_empty() {
        let columns = shown(model, &numbers[1..]).into_iter();
        return Ok(columns.map(|k| Wanted { x: 0, y: k + 1, path: false }).collect());
    }
    let names: Vec<&str> = std::iter::once("t").chain(infos.iter().map(|info| info.name.as_str())).collect();
    let carried = model.points.iter().map(|p| p.name).chain(model.bodies.iter().map(|b| b.name));
    let place = |name: &str| names.iter().position(|n| *n == name);
    what.iter()
        .map(|what| {
            if let Some((x, y)) = what.split_once(':') {
                let [x, y] = [x, y].map(|name| find("WHAT", Kind::Quantity, name, &names));
                return Ok(Wanted { x: x?, y: y?, path: false });
            }
            let path = carried.clone().any(|name| name == what) && place(what).is_none();
            if let (true, Some(x), Some(y)) = (path, place(&format!("{what}.x")), place(&format!("{what}.y"))) {
                return Ok(Wanted { x, y, path: true });
            }
            Ok(Wanted { x: 0, y: find("WHAT", Kind::Quantity, what, &names)?, path: false })
        })
        .collect()
}

/// What has the same axes shares a panel.
fn panels(model: &Model, wanted: &[Wanted], infos: &[ColumnInfo], runs: &[Curves]) -> Vec<Panel> {
    let time = Units::of(model).time();
    let name = |k: usize| if k == 0 { "t" } else { infos[k - 1].name.as_str() };
    let unit = |k: usize| if k == 0 { time } else { infos[k - 1].unit.as_deref() };
    let mut panels: Vec<(Vec<Wanted>, Panel)> = Vec::new();
    for &want in wanted {
        let curves = runs.iter().map(|run| {
            let points = run.columns[want.x].iter().copied().zip(run.columns[want.y].iter().copied());
            let own = if want.path { name(want.y).trim_end_matches(".y") } else { name(want.y) };
            let names: Vec<&str> = [own, &run.name]
                .into_iter()
                .filter(|name| !name.is_empty() && (wanted.len() > 1 || *name != own))
                .collect();
            let name = if names.is_empty() { own.to_owned() } else { names.join(", ") };
            Curve { name, points: points.filter(|(x, y)| x.is_finite() && y.is_finite()).collect() }
        });
        let curves: Vec<Curve> = curves.collect();
        let alike = |other: &Wanted| {
            let same = unit(other.y) == unit(want.y) && unit(want.y).is_some();
            other.path == want.path && same && (want.path || other.x == want.x && want.x == 0)
        };
        if let Some((members, panel)) = panels.iter_mut().find(|(members, _)| members.iter().all(alike)) {
            members.push(want);
            panel.curves.extend(curves);
            continue;
        }
        let labels = [want.x, want.y].map(|k| Panel::label(name(k), unit(k)));
        panels.push((vec![want], Panel { labels, equal: want.path, curves }));
    }
    panels.into_iter().map(|(members, panel)| shared_labels(members.len(), panel, &members, &unit)).collect()
}

/// Axes of a panel with several quantities say only what they measure.
fn shared_labels<'u>(count: usize, panel: Panel, members: &[Wanted], unit: &dyn Fn(usize) -> Option<&'u str>) -> Panel {
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
