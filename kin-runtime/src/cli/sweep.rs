//! `sweep`: the motion over many instants.

use super::engine::Engine;
use super::failure::Failure;
use super::moving::{GridArgs, Moved, motions, moved, note_motion};
use super::options::{Format, FreedomArgs, OutputArgs, SetupArgs};
use super::session::Session;
use super::solved::note_freedom;
use crate::motion::Motion;
use crate::present::grid;
use crate::present::json::to_json;
use crate::present::number::rounded;
use crate::present::record::{Parameters, SweepRecord};
use crate::present::text::count;
use crate::trajectory::Trajectory;

/// Steps when --steps is not there.
const STEPS: usize = 100;

/// The motion over many instants, on one branch from the first to the last
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "\
Examples, after the program's name:
  sweep --to 1                                          101 instants from t = 0 to t = 1
  sweep --from 0 --to 1 --steps 100 --format csv --out motion.csv
  sweep --from 1 --to -1 --steps 50 --set omega=3
  sweep --times -1,0,0.5,10 --format json
  sweep --to 1 --mode A-B-D=-                           in the other closure of a dyad
  sweep --to 2 --stop-at-events                         up to the first limit that is met
  sweep --to 2 --given crank.phi=0:3                    crank.phi starts at 0 and turns at 3 rad/s

csv has one header line and one row per instant: t, then every coordinate, its rate (name_dot) and
acceleration (name_ddot). Inputs and given coordinates hold at the first instant and go on with
their acceleration. Where a unilateral condition meets its limit is said on stderr, and in json under
`events`. When a sweep fails midway the finished rows are written and the status is 1.")]
pub(super) struct SweepArgs {
    #[command(flatten)]
    grid: GridArgs,
    /// End the sweep where the first unilateral condition meets its limit
    #[arg(long)]
    stop_at_events: bool,
    /// Also points, defines and joint quantities, behind the coordinates
    #[arg(long)]
    points: bool,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &SweepArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let setup = args.setup.apply_complete(engine)?;
    let engine = &*engine;
    let times = args.grid.times(|_| None, STEPS)?;
    let Moved { trajectory, ended, left } = moved(engine, &setup, &times, args.stop_at_events, args.freedom)?;
    let motions = if args.points { motions(engine, &trajectory.states)? } else { Vec::new() };
    let text = render(args, engine, &trajectory, &motions, ended.is_none())?;
    note_motion(session, &trajectory);
    match ended {
        None => {
            note_freedom(session, left);
            session.deliver(&args.output, &text)
        }
        Some(failure) => {
            let states = &trajectory.states;
            if !states.is_empty() {
                session.deliver(&args.output, &text)?;
                let instants = count(times.len(), "instant");
                session.note(&format!("the sweep ended early: {} of {instants} written", states.len()));
            }
            Err(failure)
        }
    }
}

fn render(
    args: &SweepArgs,
    engine: &dyn Engine,
    trajectory: &Trajectory,
    motions: &[Motion],
    complete: bool,
) -> Result<String, Failure> {
    let (model, states) = (engine.model(), &trajectory.states);
    match args.output.format() {
        Format::Csv => grid::csv(model, states, motions).map_err(Failure::Output),
        Format::Json => {
            let parameters = Parameters::new(model, &engine.parameters());
            to_json(&SweepRecord::new(model, parameters, trajectory, motions, complete)).map_err(Failure::Output)
        }
        Format::Text => {
            let (first, last) = (states.first(), states.last());
            let [from, to] = [first, last].map(|s| s.map_or_else(String::new, |s| rounded(s.t)));
            let heading = format!("{}, {} from t = {from} to t = {to}\n", model.name, count(states.len(), "instant"));
            Ok(heading + &grid::text(model, states, motions))
        }
    }
}
