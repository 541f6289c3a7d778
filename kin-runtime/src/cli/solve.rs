//! `solve`: position, velocity and acceleration at one instant.

use super::columns::quantities;
use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::force_notes::missing_force;
use super::options::{AngleArgs, FreedomArgs, SetupArgs};
use super::output::{Destination, Form, OutputArgs, json};
use super::session::Session;
use super::setup::Setup;
use super::solved::{SolvedInstant, analysis, driven_state, note_freedom, note_modes, note_start, solve};
use super::task::{At, AtArgs};
use crate::measure::{Measure, column_values};
use crate::model::Model;
use crate::present::certificate;
use crate::present::condition;
use crate::present::forces;
use crate::present::grid::CsvRows;
use crate::present::json::{Record, fields, record};
use crate::present::number::rounded;
use crate::present::plan;
use crate::present::record::{Parameters, QuantitiesState, inputs};
use crate::present::table::Table;
use crate::present::text;
use crate::present::units::ResultUnits;
use crate::ratios::VelocityRatio;
use crate::serial::{NamedValues, coordinate_names};

/// Position, velocity and acceleration at one instant
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SolveArgs {
    /// Quantities by name instead of everything: tip.x, tip.x/drive, B.transmission
    #[arg(value_name = "WHAT", conflicts_with_all = ["forces", "certify"])]
    what: Vec<String>,
    #[command(flatten)]
    at: AtArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    angles: AngleArgs,
    /// Also efforts of drivers and reactions in joints
    #[arg(long)]
    forces: bool,
    /// Also a proof that it is a solution, and the only one nearby
    #[arg(long, conflicts_with = "degrees")]
    certify: bool,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let [certified, ..] = names.proven;
        vec![
            names.analysis(&format!("solve --at {}", names.at), ""),
            names.with("solve", &names.ratio, "a quantity, and its velocity ratio to a driver or an input"),
            names.with("solve --set", &names.set_two.clone().or(names.set.clone()), "with dimensions of your own"),
            names.with("solve --guess", &names.guess, "with this start of the assembly"),
            names.with("solve --mode", &names.mode, "in an assembly mode, whatever the guess"),
            names.analysis(&format!("solve --at {} --format json", names.at), "for another program"),
            names.analysis("solve --certify", "with a proof").filter(|_| certified),
            names.analysis("solve --out state.csv", "one row with a header"),
        ]
    },
    details: "\
csv has one row: t, then every coordinate, its rate (NAME_dot) and acceleration (NAME_ddot), with
--forces the forces, and with --certify the bounds of all of the former (NAME_lower, NAME_upper).
WHAT names the quantities of `sweep`. A velocity ratio NAME/DRIVER or NAME/INPUT is a derivative:
the ratios of a point to all inputs are its Jacobian.
A certificate is a proof by interval arithmetic: a box with exactly one solution, and an interval
for every coordinate, rate and acceleration. Where there is none, it says why and the status is 1.",
};

pub(super) fn run(args: &SolveArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let at = args.at.read(&mut ledger, ("solve", &args.output), SetupArgs::apply_complete, engine, session);
    let number = args.what.iter().find(|name| name.parse::<f64>().is_ok());
    let wanted = ledger.take(match number {
        Some(t) => Err(Failure::option("WHAT", format!("`{t}` is no quantity. An instant is written --at {t}"))),
        None => quantities(engine.model(), &args.what),
    });
    let (At { t, setup, output }, wanted) = ledger.close(at.zip(wanted))?;
    let setup = Setup { least_norm: args.freedom.least_norm, ..setup };
    if !wanted.is_empty() {
        return named(args, (t, &setup, &wanted), &output, &*engine, session);
    }
    let mut solved = solve(engine, &setup, t, args.freedom.least_norm)?;
    let forces = args.forces.then(|| engine.forces(&setup, &solved.state)).transpose();
    solved.motion.forces = forces.map_err(|error| analysis(engine, &error))?;
    solved.certificate = args.certify.then(|| engine.certify(&setup, &solved.state));
    let solved = solved.shown(engine.model(), args.angles.degrees);
    note_freedom(session, solved.state.degrees_of_freedom_left);
    note_start(session, &solved.mobility);
    note_modes(session, engine, &setup, t);
    let model = engine.model();
    let text = match output.form {
        Form::Json => json(&record(engine, &solved))?,
        Form::Csv => {
            let mut measures = Measure::standard(model, false);
            let mut values: Vec<f64> = measures.iter().filter_map(|m| m.of_state(&solved.state)).collect();
            if let Some(forces) = &solved.motion.forces {
                measures.extend(Measure::forces(model));
                column_values(model, Some(forces), &mut values);
                for (measure, value) in Measure::further_efforts(forces) {
                    measures.push(measure);
                    values.push(value);
                }
            }
            let bounds =
                solved.certificate.as_ref().map_or_else(Vec::new, |certified| certificate::columns(model, certified));
            let names = measures.iter().map(Measure::name).chain(bounds.iter().map(|(name, _)| name.as_str()));
            csv(names, values.into_iter().chain(bounds.iter().map(|(_, value)| *value)))?
        }
        _ => format!(
            "{} at t = {}{}\n{}{}",
            model.name,
            rounded(t),
            if solved.degrees { ", angles in degrees" } else { "" },
            body(model, &solved),
            text::quality(&solved.state, &solved.mobility)
        ),
    };
    session.deliver(&output, &text)?;
    match &solved.certificate {
        Some(Err(why)) => Err(Failure::Analysis(format!("{}: not certified: {why}", model.name))),
        _ => Ok(()),
    }
}

/// The quantities that were requested by name.
fn named(
    args: &SolveArgs,
    (t, setup, wanted): (f64, &Setup, &[Measure]),
    output: &Destination<'_>,
    engine: &dyn Engine,
    session: &mut Session<'_>,
) -> Result<(), Failure> {
    let (model, degrees) = (engine.model(), args.angles.degrees);
    let (state, mobility) = driven_state(engine, setup, t, args.freedom.least_norm)?;
    let mut values = engine.measure(setup, &state, wanted).map_err(|error| analysis(engine, &error))?;
    if let Some(note) = missing_force((engine, setup), &state, wanted, &values) {
        session.note(&note);
    }
    if degrees {
        values.iter_mut().zip(wanted).for_each(|(value, measure)| *value *= measure.in_degrees());
    }
    note_freedom(session, state.degrees_of_freedom_left);
    note_start(session, &mobility);
    note_modes(session, engine, setup, t);
    let units = ResultUnits::of(model).in_degrees(degrees);
    let names = wanted.iter().map(Measure::name);
    let text = match output.form {
        Form::Json => {
            let mut all = fields(&QuantitiesState::new(t, wanted, &values));
            let parameters = Parameters::new(model, &engine.parameters());
            all.extend(record! { mechanism: model.name, parameters: parameters, units: units.record() });
            json(&all)?
        }
        Form::Csv => csv(std::iter::once("t").chain(names), std::iter::once(t).chain(values))?,
        _ => {
            let table = Table::new()
                .words("quantity", names)
                .right("value", values.iter().copied().map(rounded))
                .words("unit", wanted.iter().map(|measure| units.of_measure(measure).unwrap_or_default()));
            text::section(&format!("{} at t = {}", model.name, rounded(t)), &table).trim_start().to_owned()
        }
    };
    session.deliver(output, &text)
}

/// A header and one row.
fn csv<'n>(names: impl Iterator<Item = &'n str>, values: impl Iterator<Item = f64>) -> Result<String, Failure> {
    let mut bytes = Vec::new();
    let row = |rows: &mut CsvRows<&mut Vec<u8>>| rows.row(values).and_then(|()| rows.flush());
    let written = CsvRows::new(names, &mut bytes).and_then(|mut rows| row(&mut rows));
    written.map_err(|error| Failure::Output(format!("cannot write csv: {error}")))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// All tables of a solved instant.
pub(super) fn body(model: &'static Model, solved: &SolvedInstant) -> String {
    let units = ResultUnits::of(model).in_degrees(solved.degrees);
    [
        text::coordinates(model, units, &solved.state),
        text::inputs(model, units, &solved.state),
        text::bodies(model, units, &solved.motion),
        text::points(model, units, &solved.motion),
        text::defines(model, units, &solved.motion),
        text::joints(model, units, &solved.motion),
        condition::values(model, &solved.motion),
        solved.motion.forces.as_ref().map(|forces| forces::text(forces, solved.degrees)).unwrap_or_default(),
        text::transmission(&solved.angles, solved.degrees),
        plan::text(&solved.modes),
        solved.certificate.as_ref().map(certificate::text).unwrap_or_default(),
    ]
    .concat()
}

/// The solved instant as one JSON object.
pub(super) fn record(engine: &dyn Engine, solved: &SolvedInstant) -> Record {
    let SolvedInstant { state, motion, mobility, ratios, angles, modes, certificate, degrees } = solved;
    let model = engine.model();
    let ratios_of =
        |list: &'_ [VelocityRatio]| list.iter().map(|ratio| (ratio.name, ratio.clone())).collect::<NamedValues<_>>();
    let mut all = record! {
        t: state.t,
        coordinates: coordinate_names(model),
        q: state.q,
        q_dot: state.q_dot,
        q_ddot: state.q_ddot,
    };
    all.extend(fields(motion));
    all.extend(record! {
        mechanism: model.name,
        parameters: Parameters::new(model, &engine.parameters()),
        units: ResultUnits::of(model).in_degrees(*degrees).record(),
        inputs: inputs(model, state),
        degrees_of_freedom: mobility.degrees_of_freedom,
        degrees_of_freedom_left: mobility.degrees_of_freedom_left,
        independent: text::coordinate_names(model, &mobility.independent),
        dependent: text::coordinate_names(model, &mobility.dependent),
        residual: state.residual,
        iterations: state.iterations,
        condition: mobility.condition,
        transmission_angles: angles,
        velocity_ratios: ratios_of(&ratios.drivers),
        input_ratios: ratios_of(&ratios.inputs),
        modes: modes,
    });
    all.extend(certificate.iter().map(|certified| ("certificate".to_owned(), certificate::record(certified).into())));
    all
}
