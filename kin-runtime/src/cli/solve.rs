//! `solve`: position, velocity and acceleration at one instant.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::options::{AngleArgs, FreedomArgs, SetupArgs};
use super::output::{Form, OutputArgs};
use super::session::Session;
use super::solved::{Solved, analysis, note_freedom, note_modes, note_start, solve};
use super::task::{At, AtArgs};
use crate::measure::Measure;
use crate::model::Model;
use crate::present::certificate;
use crate::present::condition;
use crate::present::forces;
use crate::present::grid::CsvRows;
use crate::present::json::to_json;
use crate::present::number::plain;
use crate::present::plan::{self, ModeRecord};
use crate::present::record::{Parameters, StateRecord};
use crate::present::text;

/// Position, velocity and acceleration at one instant
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SolveArgs {
    #[command(flatten)]
    at: AtArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    angles: AngleArgs,
    /// Also what drivers supply and joints carry
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
            names.with("solve --set", &names.set_two.clone().or(names.set.clone()), "with other dimensions"),
            names.with("solve --guess", &names.guess, "another start of the assembly"),
            names.with("solve --mode", &names.mode, "in an assembly mode, whatever the guess"),
            names.analysis(&format!("solve --at {} --format json", names.at), "for another program"),
            names.analysis("solve --certify", "with a proof").filter(|_| certified),
            names.analysis("solve --out state.csv", "one row with a header"),
        ]
    },
    details: "\
csv has one row: t, then every coordinate, its rate (NAME_dot) and acceleration (NAME_ddot).
A certificate is a proof by interval arithmetic: a box with exactly one solution, and an interval
for every coordinate, rate and acceleration. Where there is none, it says why and the status is 1.",
};

pub(super) fn run(args: &SolveArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let at = args.at.read(&mut ledger, ("solve", &args.output), SetupArgs::apply_complete, engine, session);
    let At { t, setup, output } = ledger.close(at)?;
    let mut solved = solve(engine, &setup, t, args.freedom.least_norm)?;
    let forces = args.forces.then(|| engine.forces(&setup, &solved.state, args.freedom.least_norm)).transpose();
    solved.motion.forces = forces.map_err(|error| analysis(engine, &error))?;
    solved.certificate = args.certify.then(|| engine.certify(&setup, &solved.state));
    let solved = solved.shown(engine.model(), args.angles.degrees);
    note_freedom(session, solved.state.degrees_of_freedom_left);
    note_start(session, &solved.mobility);
    note_modes(session, engine, &setup, t);
    let model = engine.model();
    let text = match output.form {
        Form::Json => json(engine, &solved)?,
        Form::Csv => {
            let mut bytes = Vec::new();
            let columns = Measure::standard(model, false);
            let values = columns.iter().filter_map(|measure| measure.of_state(&solved.state));
            let row = |rows: &mut CsvRows<&mut Vec<u8>>| rows.row(values).and_then(|()| rows.flush());
            let names = columns.iter().map(Measure::name);
            let written = CsvRows::new(names, &mut bytes).and_then(|mut rows| row(&mut rows));
            written.map_err(|error| Failure::Output(format!("cannot write csv: {error}")))?;
            String::from_utf8_lossy(&bytes).into_owned()
        }
        _ => format!(
            "{} at t = {}{}\n{}{}",
            model.name,
            plain(t),
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

/// All tables of a solved instant.
pub(super) fn body(model: &'static Model, solved: &Solved) -> String {
    [
        text::coordinates(model, &solved.state),
        text::inputs(model, &solved.state),
        text::bodies(model, &solved.motion),
        text::points(model, &solved.motion),
        text::defines(model, &solved.motion),
        text::joints(model, &solved.motion),
        condition::values(model, &solved.motion),
        solved.motion.forces.as_ref().map(forces::text).unwrap_or_default(),
        text::transmission(&solved.angles, solved.degrees),
        plan::modes(&ModeRecord::of(&solved.modes)),
        solved.certificate.as_ref().map(certificate::text).unwrap_or_default(),
    ]
    .concat()
}

/// The solved instant as one JSON object.
pub(super) fn record<'a>(engine: &dyn Engine, solved: &'a Solved) -> StateRecord<'a> {
    let model = engine.model();
    StateRecord::new(
        model,
        &solved.state,
        &solved.motion,
        Parameters::new(model, &engine.parameters()),
        &solved.mobility,
        &solved.ratios,
        &solved.angles,
    )
    .with_modes(&solved.modes)
    .with_certificate(solved.certificate.as_ref())
    .in_degrees(model, solved.degrees)
}

fn json(engine: &dyn Engine, solved: &Solved) -> Result<String, Failure> {
    to_json(&record(engine, solved)).map_err(Failure::Output)
}
