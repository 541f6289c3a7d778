//! `extremes`: the least and the greatest of quantities over a motion, between instants as well.

mod record;
mod refine;
mod search;
mod written;

use record::{MotionRecord, QuantityRange};
use refine::RefinedMotion;
use search::SearchedMotion;
use written::{csv, text};

use crate::cli::columns::quantities;
use crate::cli::engine::Engine;
use crate::cli::examples::{Help, Names};
use crate::cli::failure::{Failure, Ledger};
use crate::cli::followed::{FollowedMotion, Moved};
use crate::cli::instants::ArcArgs;
use crate::cli::motion_notes::note_motion;
use crate::cli::output::{Form, OutputArgs, json};
use crate::cli::session::Session;
use crate::cli::solved::note_freedom;
use crate::cli::task::{MotionArgs, MotionTask};
use crate::cli::vary::VaryArgs;
use crate::measure::Measure;
use crate::present::json::record;
use crate::present::number::rounded;
use crate::present::record::Parameters;
use crate::present::text::count;
use crate::present::units::ResultUnits;
use std::ops::Range;

/// Number of steps without `--steps`.
pub(super) const STEPS: usize = 360;
/// Largest number of motions of one search, and what to do for more.
const MAX_MOTIONS: (usize, &str) = (100_000, "for more, see the crate kin-study");
/// Largest number of driven quantities whose values are shown beside the time.
const DRIVERS: usize = 3;

/// The least and the greatest of quantities over a motion, also between instants
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ExtremesArgs {
    /// Quantities by name: B.transmission, tip.x, tip.x/drive [default: outputs and efforts]
    #[arg(value_name = "WHAT")]
    what: Vec<String>,
    #[command(flatten)]
    vary: VaryArgs,
    #[command(flatten)]
    motion: MotionArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let quantity = names.coordinate.map(|name| crate::cli::trial::quoted(format!("{name}_dot")));
        let vary = names.vary.as_ref().map(|vary| format!("extremes --vary {vary} --out extremes.csv"));
        vec![
            names.analysis("extremes", "of outputs and efforts, over one turn of the driven crank"),
            quantity.and_then(|name| names.analysis(&format!("extremes {name} --degrees"), "of one quantity")),
            vary.and_then(|line| names.analysis(&line, "for each of five values of a parameter")),
            names.analysis("extremes --from limit --to limit", "as far as the mechanism goes both ways"),
        ]
    },
    details: "\
Quantities are those of `sweep`: coordinates, points and their speeds, defines, joint quantities,
transmission angles (NAME.transmission), velocity ratios (NAME/DRIVER), rates (NAME_dot) and
accelerations (NAME_ddot), and forces. Without names the search takes transmission angles, angles
and points that are not driven, defines, strokes of joints and efforts of drivers, and leaves out
what stays constant. If nothing else changes, it takes what is driven.

The instants of the motion (--steps) show roughly where an extreme is. Between them the mechanism is
solved at three further instants, and at more where a quantity is not nearly straight between its
neighbours; around an extreme, until the value is exact to rounding. A spike that is much shorter
than a quarter of a step may still be missed. The last column says if an extreme is at the beginning
or the end of the motion, at a limit, or at a kink of the quantity, or if it is unresolved: then the
motion cannot be solved everywhere around it, and the quantity may exceed it there. Rates may
grow without bounds towards a limit: then the value is that of the last instant before it.",
};

pub(super) fn run(args: &ExtremesArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let model = engine.model();
    let mut ledger = Ledger::default();
    let task = args.motion.read(&mut ledger, ("extremes", &args.output), (STEPS, ArcArgs::default()), engine, session);
    let choices = ledger.take(args.vary.choices(model, MAX_MOTIONS));
    let wanted = ledger.take(quantities(model, &args.what));
    let (task, (choices, wanted)) = ledger.close(task.zip(choices.zip(wanted)))?;
    let watch = session.watch();
    let (mut motions, mut failure) = (Vec::new(), None);
    let several = choices.len() > 1;
    for (index, choice) in choices.iter().enumerate() {
        choice.set(engine);
        let name = choice.name(model);
        let place = ((index, choices.len()), several.then_some(name.as_str()));
        let found = one(args, &*engine, (&task, &wanted), place, session);
        let ended = match found {
            Ok((found, ended)) => {
                let varied = several.then(|| choice.pairs(model).collect());
                motions.push(MotionRecord { varied, ..found });
                ended
            }
            Err(failure) => Some(failure),
        };
        if let (Some(ended), true) = (&ended, several && !watch.interrupted()) {
            session.note(&format!("note: {name}: {ended}"));
        }
        failure = failure.or(ended);
        if watch.interrupted() {
            break;
        }
    }
    watch.end();
    if motions.is_empty() {
        return failure.map_or(Ok(()), Err);
    }
    let units = ResultUnits::of(model).in_degrees(args.motion.angles.degrees);
    let text = match task.output.form {
        Form::Json => json(&record! { mechanism: model.name, units: units.record(), motions: motions })?,
        Form::Csv => csv(&motions, &choices[0], model),
        _ => text(&motions, model, args.motion.angles.degrees),
    };
    session.deliver(&task.output, &text)?;
    failure.map_or(Ok(()), Err)
}

/// The extremes of one motion, and why it ended early.
fn one(
    args: &ExtremesArgs,
    engine: &dyn Engine,
    (task, wanted): (&MotionTask<'_>, &[Measure]),
    (place, name): ((usize, usize), Option<&str>),
    session: &mut Session<'_>,
) -> Result<(MotionRecord, Option<Failure>), Failure> {
    let model = engine.model();
    let instants = task.requested.instants(engine, &task.setup)?;
    let watch = session.watch();
    watch.begin_motion(place, instants.len());
    let time = Measure::standard(model, false).into_iter().take(1);
    let driven: Vec<Measure> = Measure::driven(model).into_iter().take(DRIVERS).collect();
    let first = 1 + driven.len();
    let measures: Vec<Measure> = match wanted.is_empty() {
        true => time.chain(driven).chain(Measure::default_outputs(model)).collect(),
        false => time.chain(driven).chain(wanted.iter().cloned()).collect(),
    };
    let walk = args.motion.walk(engine, (&task.requested, &task.setup, &instants), &measures, &watch);
    let moved = FollowedMotion { tells_missing: !wanted.is_empty(), ..walk }.with_states()?;
    note_motion(session, &moved, name);
    let Moved { trajectory, columns, ended, open, .. } = moved;
    note_freedom(session, open);
    let states = &trajectory.states;
    if ended.as_ref().is_some_and(|failure| !matches!(failure, Failure::Interrupted(_))) {
        let (states, instants) = (states.len(), count(instants.len(), "instant"));
        session.note(&format!("the motion ended early: extremes of {states} of {instants}"));
    }
    let (from, to) = (states.first().map(|state| state.t), states.last().map(|state| state.t));
    let RefinedMotion { states, columns, unsolved } = refine::refined(&walk, &instants, (states, &columns), first);
    if let [.., [first, end]] = unsolved.as_slice() {
        let (count, first, end) = (count(unsolved.len(), "interval"), rounded(*first), rounded(*end));
        session.note(&format!(
            "note: the motion cannot be solved everywhere: within {count} of time, the last one between t = {first} and \
             t = {end}, quantities may exceed these extremes"
        ));
    }
    let search = SearchedMotion { walk, states: &states, columns: &columns, first, instants: &instants };
    let units = ResultUnits::of(model).in_degrees(args.motion.angles.degrees);
    let range = |place: usize| QuantityRange {
        quantity: measures[place].name().to_owned(),
        unit: units.of_measure(&measures[place]),
        least: search.extreme(place, -1.0),
        greatest: search.extreme(place, 1.0),
    };
    // An empty table would hide that there is nothing to compare.
    let undefined = |place: &usize| !states.is_empty() && columns[*place].iter().all(|value| !value.is_finite());
    if let Some(place) = (first..first + wanted.len()).find(undefined) {
        let message = "has no value in all of the motion: it is undetermined, or not defined there";
        return Err(Failure::Analysis(format!("{}: `{}` {message}", model.name, measures[place].name())));
    }
    let varies = |place: &usize| !wanted.is_empty() || !search.is_constant(*place);
    let ranges = |places: Range<usize>| -> Vec<QuantityRange> { places.filter(varies).map(range).collect() };
    let mut extremes = ranges(first..measures.len());
    if extremes.is_empty() {
        extremes = ranges(1..first);
    }
    let parameters = Parameters::new(model, &engine.parameters());
    Ok((MotionRecord { varied: None, parameters, from, to, complete: ended.is_none(), extremes }, ended))
}
