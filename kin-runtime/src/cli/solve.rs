//! `solve`: position, velocity and acceleration at one instant.

use super::engine::Engine;
use super::failure::Failure;
use super::options::{Format, FreedomArgs, InstantArgs, OutputArgs, SetupArgs};
use super::session::Session;
use super::solved::{Solved, note_freedom, note_start, solve};
use crate::model::Model;
use crate::present::condition;
use crate::present::json::to_json;
use crate::present::number::plain;
use crate::present::plan::{self, ModeRecord};
use crate::present::record::{Parameters, StateRecord};
use crate::present::{grid, text};

/// Position, velocity and acceleration at one instant
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "\
Examples, after the program's name:
  solve
  solve --at 0.5 --set l1=0.12,l2=0.4 --guess coupler.phi=0.9
  solve --at -0.5 --format json
  solve --given crank.phi=0.3:2 --format csv --out state.csv   a coordinate in place of a driver
  solve --mode A-B-D=-                                         the other closure of a dyad
  solve --input u=0.1,2,0                                      an input with its rate and acceleration

csv has one row: t, then every coordinate, its rate (name_dot) and acceleration (name_ddot).")]
pub(super) struct SolveArgs {
    #[command(flatten)]
    instant: InstantArgs,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &SolveArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let t = args.instant.time()?;
    let setup = args.setup.apply_complete(engine)?;
    let solved = solve(engine, &setup, t, args.freedom.least_norm)?;
    note_freedom(session, solved.state.degrees_of_freedom_left);
    note_start(session, &solved.mobility);
    let model = engine.model();
    let text = match args.output.format() {
        Format::Text => format!(
            "{} at t = {}\n{}{}",
            model.name,
            plain(t),
            body(model, &solved),
            text::quality(&solved.state, &solved.mobility)
        ),
        Format::Json => json(engine, &solved)?,
        Format::Csv => grid::csv(model, std::slice::from_ref(&solved.state), &[]).map_err(Failure::Output)?,
    };
    session.deliver(&args.output, &text)
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
        text::transmission(&solved.angles),
        plan::modes(&ModeRecord::of(&solved.modes)),
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
}

fn json(engine: &dyn Engine, solved: &Solved) -> Result<String, Failure> {
    to_json(&record(engine, solved)).map_err(Failure::Output)
}
