//! `design`: searches for dimensions with which the mechanism has a wanted motion.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger, zip3};
use super::names::{NameKind, find, find_quantity};
use super::number::Measured;
use super::options::SetupArgs;
use super::output::{Form, OutputArgs, json};
use super::places::{PLACES, columns};
use super::session::Session;
use super::setup::Setup;
use super::trial::quoted;
use super::turns::{natural_end, turn_of};
use super::values;
use super::wishes::{INSTANTS, Wish, Wishes};
use crate::design::{DesignError, DesignQuantity, Designed, Direction, Search, Shortest};
use crate::measure::Measure;
use crate::model::Model;
use crate::present::json::record;
use crate::present::number::rounded;
use crate::present::table::Table;
use crate::present::text::section;
use crate::serial::NamedValues;
use std::collections::BTreeMap;

/// A parameter that is nearer to a bound than this, relative to its range, is reported as being at the bound.
const AT_BOUND: f64 = 1e-6;

/// Search for dimensions that give a wanted motion
#[derive(Clone, Debug, clap::Args)]
pub(super) struct DesignArgs {
    /// Parameters that may vary; a NAME alone: half to twice its value
    #[arg(long, value_name = "NAME=LOW..HIGH")]
    free: Vec<String>,
    /// Two parameters that stay equal: NAME=OTHER, where OTHER is free
    #[arg(long, value_name = "NAME=NAME")]
    equal: Vec<String>,
    /// A path: the positions in a file that this point passes through
    #[arg(
        long,
        value_name = "POINT=FILE",
        long_help = "\
A path: this point is to pass through positions: POINT=FILE, csv with the
columns x,y or t,x,y"
    )]
    path: Vec<String>,
    /// Paths without t: forward, backward or either
    #[arg(
        long,
        value_name = "DIRECTION",
        default_value = "forward",
        long_help = "\
In which direction paths without t may be traversed: forward, backward, either"
    )]
    direction: String,
    /// A quantity over time: csv with the columns t,value or t,NAME
    #[arg(long, value_name = "NAME=FILE")]
    function: Vec<String>,
    /// A quantity whose greatest magnitude over a turn is minimised
    #[arg(long, value_name = "NAME")]
    peak: Vec<String>,
    /// It must move through a full turn [of this driver]
    #[arg(
        long,
        value_name = "DRIVER",
        num_args = 0..=1,
        default_missing_value = "",
        long_help = "\
It must move through a full turn [of this driver], and no dyad may come nearer
to a dead centre than a tenth of its links"
    )]
    turns: Option<String>,
    /// Lengths of a four-bar that must satisfy Grashof's condition
    #[arg(
        long,
        value_name = "LENGTHS",
        long_help = "\
Lengths of a four-bar that must satisfy Grashof's condition:
GROUND,CRANK,COUPLER,ROCKER"
    )]
    grashof: Option<String>,
    /// Which link of --grashof is the shortest
    #[arg(
        long,
        value_name = "LINK",
        default_value = "crank",
        requires = "grashof",
        long_help = "\
Which link of --grashof is the shortest: ground, crank, coupler or rocker"
    )]
    shortest: String,
    /// A quantity that stays within LOW..HIGH over the whole turn
    #[arg(long, value_name = "NAME=LOW..HIGH")]
    range: Vec<String>,
    /// Transmission angles of JOINT stay from ANGLE to 180° - ANGLE
    #[arg(long, value_name = "JOINT>ANGLE")]
    transmission: Vec<String>,
    /// How long a turn takes [default: that of the driven crank, or 1]
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
            names.analysis(
                &format!("design --path {wanted} --free {parameter} --starts 4"),
                "find the dimensions from the places",
            ),
        ]
    },
    details: "\
Many random designs within the bounds are improved by exact derivatives; each follows one
assembly mode from the first place to the last. The report says how many starts met the best:
few of many say that a better one may exist. The result is tested over the whole turn, also
between the instants of the search. Its json is read by --set @FILE.",
};

pub(super) fn run(args: &DesignArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let output = ledger.take(session.destination(&args.output, "design"));
    let setup = ledger.take(args.setup.apply_complete(engine).and_then(Setup::without_closure));
    let all = ledger.take(wishes(args, &*engine));
    let mut ask = |option, message: &str| ledger.take(Err::<(), _>(Failure::option(option, message)));
    let positive = |period: f64| period > 0.0 && period.is_finite();
    if args.period.is_some_and(|period| !positive(period)) {
        ask("--period", "a turn takes a time that is finite and positive");
    }
    if args.starts == 0 {
        ask("--starts", "a search has at least one start");
    }
    if args.free.is_empty() {
        ask("--free", "no parameter may vary; write --free NAME=LOW..HIGH");
    }
    if [&args.path, &args.function, &args.peak].iter().all(|wanted| wanted.is_empty()) {
        ask("--path", "nothing is wanted of the motion; write --path, --function or --peak");
    }
    let (output, setup, all) = ledger.close(zip3(output, setup, all))?;
    let period = match (args.period, args.turns.as_deref().filter(|driver| !driver.is_empty())) {
        (Some(period), _) => period,
        (None, None) => natural_end(&*engine, &setup, 0.0),
        (None, Some(driver)) => turn_of(&*engine, &setup, driver).ok_or_else(|| {
            let message =
                format!("`{driver}` drives no angle at constant speed; say how long a turn takes by --period");
            Failure::option("--turns", message)
        })?,
    };
    let bounds: Vec<(String, [f64; 2])> = all.iter().filter_map(Wish::bounds).collect();
    let found = searched(args, &*engine, &setup, &Wishes { all, period }, session)?;
    if found.stopped {
        session.note("note: stopped before all starts were tried; this is the best so far");
    }
    if found.met == 1 && found.finished > 1 {
        session.note("note: only one start met this design: more starts may find a better one");
    }
    for name in &args.peak {
        let which = format!("at {INSTANTS} instants of a turn");
        session.note(&format!(
            "note: {name} was evaluated {which} only: run extremes {name} with this design for those between"
        ));
    }
    let model = engine.model();
    let text = match output.form {
        Form::Json => {
            let parameters: NamedValues<f64> = found.parameters.iter().copied().collect();
            let modes: BTreeMap<_, _> = found.modes.iter().map(|(name, sign)| (*name, sign.to_string())).collect();
            let mut all = record! { mechanism: model.name, parameters: parameters, modes: modes, error: found.error };
            all.extend(found.least.map(|least| ("least".to_owned(), least.into())));
            all.extend(record! {
                times: found.times,
                slacks: found.slacks,
                starts: found.starts,
                assembled: found.assembled,
                finished: found.finished,
                met: found.met,
                errors: found.errors,
                stopped: found.stopped,
            });
            json(&all)?
        }
        _ => report(model, &bounds, &found),
    };
    session.deliver(&output, &text)
}

/// The parameters with their bounds, the modes, and the slack of every condition.
fn report(model: &Model, bounds: &[(String, [f64; 2])], found: &Designed<()>) -> String {
    let bounds_of = |name: &str| bounds.iter().find(|(other, _)| other == name).map(|(_, bounds)| *bounds);
    let range = |name: &str| bounds_of(name).map_or_else(String::new, |[low, high]| format!("{low} to {high}"));
    let at_bound = |&(name, value): &(&str, f64)| match bounds_of(name) {
        Some([low, high]) if value - low <= AT_BOUND * (high - low) => "at its lower bound",
        Some([low, high]) if high - value <= AT_BOUND * (high - low) => "at its upper bound",
        _ => "",
    };
    let unit = |name: &str| {
        let info = model.parameters.iter().find(|info| info.name == name);
        info.and_then(|info| info.unit).unwrap_or_default()
    };
    let parameters = Table::new()
        .words("parameter", found.parameters.iter().map(|(name, _)| *name))
        .numbers("value", found.parameters.iter().map(|(_, value)| *value))
        .words("unit", found.parameters.iter().map(|(name, _)| unit(name)))
        .words("bounds", found.parameters.iter().map(|(name, _)| range(name)))
        .words("", found.parameters.iter().map(at_bound));
    let modes = Table::new()
        .words("mode", found.modes.iter().map(|(name, _)| *name))
        .words("sign", found.modes.iter().map(|(_, sign)| sign.to_string()));
    let conditions = Table::new()
        .words("condition", found.slacks.iter().map(|slack| slack.condition.as_str()))
        .numbers("slack", found.slacks.iter().map(|slack| slack.slack))
        .words("at t", found.slacks.iter().map(|slack| slack.at.map_or_else(String::new, rounded)));
    let summary = found.to_string();
    let summary = summary.lines().next().unwrap_or_default();
    let sections = [section("Parameters", &parameters), section("Modes", &modes), section("Conditions", &conditions)];
    format!("{}, designed\n{summary}\n{}", model.name, sections.concat())
}

/// The search, with a progress bar; Ctrl-C ends it.
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
    let each_design = |progress: crate::design::Progress| step(progress.done);
    let search = Search { starts: args.starts, seed: args.seed, watch: Some(&each_design) };
    let found = engine.design(setup, wishes, &search);
    watch.end();
    found.map_err(|error| match error {
        DesignError::NoStart { .. } | DesignError::NotKept { .. } | DesignError::Broken { .. } => {
            Failure::Analysis(format!("{}: {error}", engine.model().name))
        }
        DesignError::Stopped => Failure::Interrupted(error.to_string()),
        other => Failure::usage(other.to_string()),
    })
}

/// The requirements that the options specify.
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
        other => {
            Err(Failure::option("--direction", format!("`{other}` is no direction; write forward, backward or either")))
        }
    };
    let direction = ledger.take(direction).unwrap_or_default();
    let known = |option: &str, name: &str| match DesignQuantity::named(model, name) {
        Err(DesignError::UnknownQuantity { .. }) => find_quantity(model, option, name).map(drop),
        _ => Ok(()),
    };
    for (point, file) in ledger.take(values::assignments("--path", "tip=points.csv", &args.path)).unwrap_or_default() {
        ledger.take(find(model, "--path", NameKind::Point, &point));
        let path = columns("--path", &file, &PLACES).and_then(|rows| path("--path", point, &rows, direction));
        all.extend(ledger.take(path));
    }
    let functions = values::assignments("--function", "rocker.phi=values.csv", &args.function);
    for (name, file) in ledger.take(functions).unwrap_or_default() {
        ledger.take(known("--function", &name));
        let rows = ledger.take(columns("--function", &file, &[&["t", "value"], &["t", &name]])).unwrap_or_default();
        match rows.iter().map(|row| <[f64; 2]>::try_from(&row[..])).collect::<Result<Vec<_>, _>>() {
            Ok(rows) => all.push(Wish::Function(name, rows.into_iter().map(|[t, value]| (t, value)).collect())),
            Err(_) => ledger.fault("--function", format!("`{file}` needs the columns t,value")),
        }
    }
    for name in &args.peak {
        ledger.take(known("--peak", name));
        all.push(Wish::Peak(name.clone()));
    }
    if let Some(driver) = &args.turns {
        all.push(Wish::Turns);
        if !driver.is_empty() {
            ledger.take(find(model, "--turns", NameKind::Driver, driver));
        }
    }
    if let Some(lengths) = &args.grashof {
        let lengths: Vec<String> = lengths.split(',').map(|name| name.trim().to_owned()).collect();
        let four = match lengths.len() {
            4 => Ok(()),
            _ => Err(Failure::option("--grashof", "four lengths are needed: ground,crank,coupler,rocker")),
        };
        let all_links = [Shortest::Ground, Shortest::Crank, Shortest::Coupler, Shortest::Rocker];
        let shortest = all_links.into_iter().find(|link| link.to_string() == args.shortest).ok_or_else(|| {
            let message = format!("`{}` is no link; write ground, crank, coupler or rocker", args.shortest);
            Failure::option("--shortest", message)
        });
        let lengths_and_shortest = ledger.take(four).zip(ledger.take(shortest));
        all.extend(lengths_and_shortest.map(|((), shortest)| Wish::Grashof(lengths, shortest)));
    }
    for text in &args.transmission {
        const OPTION: &str = "--transmission";
        let Some((joint, least)) = text.split_once('>') else {
            ledger.fault(OPTION, format!("`{text}` is no condition; write 'JOINT>40deg'"));
            continue;
        };
        let joint = joint.trim().trim_end_matches(".transmission");
        let measured = Measured { name: joint, unit: Some("rad"), ..Measured::default() };
        let least = ledger.take(values::number(OPTION, least.trim(), measured)).filter(|least| {
            let is_acute = (0.0..=core::f64::consts::FRAC_PI_2).contains(least);
            if !is_acute {
                let message =
                    format!("`{text}` asks for {least} rad; a transmission angle is 0 to 90deg, as 'JOINT>40deg'");
                ledger.fault(OPTION, message);
            }
            is_acute
        });
        all.extend(least.map(|least| Wish::Transmission(joint.to_owned(), least)));
    }
    for text in &args.range {
        let range = text.split_once('=').and_then(|(name, range)| Some((name, range.split_once("..")?)));
        let Some((name, (low, high))) = range else {
            ledger.fault("--range", format!("`{text}` is no range; write NAME=LOW..HIGH"));
            continue;
        };
        ledger.take(known("--range", name));
        let unit = Measure::named(model, name).and_then(|measure| measure.unit(&model.units));
        let measured = Measured { name, unit: unit.as_deref(), ..Measured::default() };
        let bound = |text: &str| values::number("--range", text, measured);
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
    let index = find(model, OPTION, NameKind::Parameter, name)?;
    let bound = |text: &str| values::number(&format!("{OPTION} {name}"), text, Measured::parameter(model, name));
    let (low, high) = match bounds.map(|bounds| bounds.split_once("..")) {
        None => {
            let value = parameters.get(index).copied().unwrap_or(0.0);
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
