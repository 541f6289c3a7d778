//! `design`: the dimensions with which the mechanism does what is wanted.

use super::engine::{Engine, Setup};
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger, zip3};
use super::instants::natural_end;
use super::number::Measured;
use super::options::SetupArgs;
use super::output::{Form, OutputArgs};
use super::places::columns;
use super::session::Session;
use super::trial::quoted;
use super::values;
use super::wishes::{Wish, Wishes};
use crate::design::{DesignError, Designed, Direction, Search, Shortest};
use crate::model::Model;
use crate::present::json::to_json;
use crate::serial::Named;
use std::collections::BTreeMap;

/// Dimensions with which it does what is wanted
#[derive(Clone, Debug, clap::Args)]
pub(super) struct DesignArgs {
    /// Parameters that may vary: NAME=LOW..HIGH, or NAME for half to twice its value
    #[arg(long, value_name = "NAME=LOW..HIGH")]
    free: Vec<String>,
    /// Parameters that stay equal: NAME=NAME, the second one free
    #[arg(long, value_name = "NAME=NAME")]
    equal: Vec<String>,
    /// A point through places: POINT=FILE, csv with the columns x,y or t,x,y
    #[arg(long, value_name = "POINT=FILE")]
    path: Vec<String>,
    /// Places of paths without t may be passed in this direction of time: forward, backward, either
    #[arg(long, value_name = "DIRECTION", default_value = "forward")]
    direction: String,
    /// A quantity over time: NAME=FILE, csv with the columns t,value
    #[arg(long, value_name = "NAME=FILE")]
    function: Vec<String>,
    /// It moves on through all of a turn, far enough from dead centres
    #[arg(long)]
    turns: bool,
    /// Lengths of a four-bar whose shortest one turns: GROUND,CRANK,COUPLER,ROCKER
    #[arg(long, value_name = "LENGTHS")]
    grashof: Option<String>,
    /// A quantity stays within a range over all of a turn: NAME=LOW..HIGH
    #[arg(long, value_name = "NAME=LOW..HIGH")]
    range: Vec<String>,
    /// Transmission angles at a joint stay between this and 180° less this over all of a turn
    #[arg(long, value_name = "JOINT>ANGLE")]
    transmission: Vec<String>,
    /// How long a turn takes [default: one turn of the driven crank, or 1]
    #[arg(long, value_name = "T")]
    period: Option<f64>,
    /// Random designs to begin with
    #[arg(long, value_name = "N", default_value_t = 100)]
    starts: usize,
    /// The same seed gives the same result
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let varied = names.vary.as_ref().and_then(|vary| vary.trim_matches('\'').split('=').next());
        let (Some(point), Some(parameter)) = (names.point, varied) else { return Vec::new() };
        let (to, parameter) = (&names.to, quoted(parameter.to_owned()));
        let wanted = quoted(format!("{point}=points.csv"));
        let columns = ["x", "y"].map(|axis| quoted(format!("{point}.{axis}")));
        let sweep = format!("sweep {} --to {to} --steps 6 --out points.csv", columns.join(" "));
        vec![
            names.analysis(&sweep, "a file of places"),
            names.analysis(&format!("design --path {wanted} --free {parameter} --starts 4"), "the way back"),
        ]
    },
    details: "\
Many random designs within the bounds are improved by exact derivatives; each follows one
assembly mode from the first place to the last. The report says how many starts met the best:
few of many say that a better one may exist. Conditions on a turn are held against all of it: the
least slack of the result is that between instants, too. Its json is read by --set @FILE.",
};

/// What is written.
#[derive(serde::Serialize)]
struct Record<'a> {
    mechanism: &'static str,
    parameters: Named<f64>,
    modes: BTreeMap<&'static str, String>,
    #[serde(flatten)]
    result: &'a Numbers<'a>,
}

#[derive(serde::Serialize)]
struct Numbers<'a> {
    error: f64,
    times: &'a [Vec<f64>],
    slacks: &'a [crate::design::Slack],
    starts: usize,
    assembled: usize,
    finished: usize,
    met: usize,
    errors: &'a [f64],
    stopped: bool,
}

pub(super) fn run(args: &DesignArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let output = ledger.take(session.destination(&args.output, "design"));
    let setup = ledger.take(args.setup.apply_complete(engine));
    let all = ledger.take(wishes(args, &*engine));
    let (output, setup, all) = ledger.close(zip3(output, setup, all))?;
    let period = args.period.unwrap_or_else(|| natural_end(&*engine, &setup, 0.0));
    let found = searched(args, &*engine, &setup, &Wishes { all, period }, session)?;
    if found.stopped {
        session.note("note: stopped before all starts were tried; this is the best so far");
    }
    if found.met == 1 && found.finished > 1 {
        session.note("note: only one start met this design: more starts may find a better one");
    }
    let model = engine.model();
    let text = match output.form {
        Form::Json => {
            let Designed { error, times, slacks, starts, assembled, finished, met, errors, stopped, .. } = &found;
            let (error, starts, assembled) = (*error, *starts, *assembled);
            let (finished, met, stopped) = (*finished, *met, *stopped);
            let result = Numbers { error, times, slacks, starts, assembled, finished, met, errors, stopped };
            let modes = found.modes.iter().map(|(name, sign)| (*name, sign.to_string())).collect();
            let parameters = found.parameters.iter().copied().collect();
            to_json(&Record { mechanism: model.name, parameters, modes, result: &result }).map_err(Failure::Output)?
        }
        _ => format!("{}, designed\n{found}\n", model.name),
    };
    session.deliver(&output, &text)
}

/// The search, with a bar and an ear for Ctrl-C.
fn searched(
    args: &DesignArgs,
    engine: &dyn Engine,
    setup: &Setup,
    wishes: &Wishes,
    session: &mut Session<'_>,
) -> Result<Designed<()>, Failure> {
    let watch = session.watch();
    watch.begin("descents", args.starts + (args.starts / 4).max(12) + 12);
    let step = watch.shared();
    let tell = |progress: crate::design::Progress| step(progress.done);
    let search = Search { starts: args.starts, seed: args.seed, watch: Some(&tell) };
    let found = engine.design(setup, wishes, &search);
    watch.end();
    found.map_err(|error| match error {
        DesignError::NoStart { .. } | DesignError::NotKept { .. } | DesignError::Broken { .. } => {
            Failure::Analysis(format!("{}: {error}", engine.model().name))
        }
        other => Failure::usage(other.to_string()),
    })
}

/// What the options ask for.
fn wishes(args: &DesignArgs, engine: &dyn Engine) -> Result<Vec<Wish>, Failure> {
    let model = engine.model();
    let (mut ledger, mut all) = (Ledger::default(), Vec::new());
    for text in args.free.iter().flat_map(|text| text.split(',')) {
        all.extend(ledger.take(free(text.trim(), model, &engine.parameters())));
    }
    for (name, other) in ledger.take(values::assignments("--equal", "l4=l1", &args.equal)).unwrap_or_default() {
        all.push(Wish::Equal(name, other));
    }
    let direction = match args.direction.as_str() {
        "forward" => Ok(Direction::Forward),
        "backward" => Ok(Direction::Backward),
        "either" => Ok(Direction::Either),
        other => Err(Failure::option("--direction", format!("`{other}` is none; write forward, backward or either"))),
    };
    let direction = ledger.take(direction).unwrap_or_default();
    for (point, file) in ledger.take(values::assignments("--path", "tip=points.csv", &args.path)).unwrap_or_default() {
        let path = columns("--path", &file).and_then(|rows| path("--path", point, &rows, direction));
        all.extend(ledger.take(path));
    }
    let functions = values::assignments("--function", "rocker.phi=values.csv", &args.function);
    for (name, file) in ledger.take(functions).unwrap_or_default() {
        let rows = ledger.take(columns("--function", &file)).unwrap_or_default();
        match rows.iter().map(|row| <[f64; 2]>::try_from(&row[..])).collect::<Result<Vec<_>, _>>() {
            Ok(rows) => all.push(Wish::Function(name, rows.into_iter().map(|[t, value]| (t, value)).collect())),
            Err(_) => {
                ledger.take::<()>(Err(Failure::option("--function", format!("`{file}` needs the columns t,value"))));
            }
        }
    }
    if args.turns {
        all.push(Wish::Turns);
    }
    if let Some(lengths) = &args.grashof {
        let lengths: Vec<String> = lengths.split(',').map(|name| name.trim().to_owned()).collect();
        match lengths.len() {
            4 => all.push(Wish::Grashof(lengths, Shortest::Crank)),
            _ => {
                let what = "four lengths are needed: ground,crank,coupler,rocker";
                ledger.take::<()>(Err(Failure::option("--grashof", what)));
            }
        }
    }
    for text in &args.transmission {
        const OPTION: &str = "--transmission";
        let Some((joint, least)) = text.split_once('>') else {
            ledger.take::<()>(Err(Failure::option(OPTION, format!("`{text}` is none; write 'JOINT>40deg'"))));
            continue;
        };
        let joint = joint.trim().trim_end_matches(".transmission");
        let measured = Measured { name: joint, unit: Some("rad"), ..Measured::default() };
        let least = ledger.take(values::number(OPTION, least.trim(), measured));
        all.extend(least.map(|least| Wish::Transmission(joint.to_owned(), least)));
    }
    for text in &args.range {
        let range = text.split_once('=').and_then(|(name, range)| Some((name, range.split_once("..")?)));
        let Some((name, (low, high))) = range else {
            ledger.take::<()>(Err(Failure::option("--range", format!("`{text}` is none; write NAME=LOW..HIGH"))));
            continue;
        };
        let bound = |text: &str| values::number("--range", text, Measured::quantity(model, name));
        let bounds = ledger.take(bound(low)).zip(ledger.take(bound(high)));
        all.extend(bounds.map(|(low, high)| Wish::Range(name.to_owned(), low, high)));
    }
    ledger.close(Some(all))
}

/// `l1=0.05..0.2`, or `l1` for half to twice its value.
fn free(text: &str, model: &Model, parameters: &[f64]) -> Result<Wish, Failure> {
    const OPTION: &str = "--free";
    let (name, bounds) = match text.split_once('=') {
        Some((name, bounds)) => (name.trim(), Some(bounds)),
        None => (text, None),
    };
    let names: Vec<&str> = model.parameters.iter().map(|parameter| parameter.name).collect();
    let place = super::names::find_in(model, OPTION, super::names::Kind::Parameter, name, &names)?;
    let bound = |text: &str| values::number(&format!("{OPTION} {name}"), text, Measured::parameter(model, name));
    let (low, high) = match bounds.map(|bounds| bounds.split_once("..")) {
        None => {
            let value = parameters.get(place).copied().unwrap_or(0.0);
            (0.5 * value).min(2.0 * value)..=(0.5 * value).max(2.0 * value)
        }
        Some(Some((low, high))) => bound(low)?..=bound(high)?,
        Some(None) => return Err(Failure::option(OPTION, format!("`{text}` has no bounds; write {name}=LOW..HIGH"))),
    }
    .into_inner();
    Ok(Wish::Free(name.to_owned(), low, high))
}

/// A path with or without instants.
fn path(option: &str, point: String, rows: &[Vec<f64>], direction: Direction) -> Result<Wish, Failure> {
    let width = rows.first().map_or(0, Vec::len);
    match width {
        2 => Ok(Wish::Path(point, rows.iter().map(|row| [row[0], row[1]]).collect(), direction)),
        3 => Ok(Wish::PathAt(point, rows.iter().map(|row| (row[0], [row[1], row[2]])).collect())),
        _ => Err(Failure::option(option, format!("a path has the columns x,y or t,x,y, not {width}"))),
    }
}
