//! `sweep`: the motion over many instants.

use super::engine::Engine;
use super::failure::Failure;
use super::options::{Format, FreedomArgs, OutputArgs, SetupArgs};
use super::session::Session;
use super::solved::{analysis, driven_state, fully_driven, note_freedom};
use super::values;
use crate::motion::Motion;
use crate::present::condition;
use crate::present::grid;
use crate::present::json::to_json;
use crate::present::number::rounded;
use crate::present::record::{Parameters, SweepRecord};
use crate::present::text::count;
use crate::state::State;
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
    /// The first instant [default: 0]
    #[arg(long, value_name = "A")]
    from: Option<String>,
    /// The last instant
    #[arg(long, value_name = "B")]
    to: Option<String>,
    /// Number of steps; N steps are N + 1 instants [default: 100]
    #[arg(long, value_name = "N")]
    steps: Option<String>,
    /// The instants one by one, in place of --from, --to and --steps
    #[arg(long, value_name = "T1,T2,…")]
    times: Option<String>,
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

impl SweepArgs {
    fn times(&self) -> Result<Vec<f64>, Failure> {
        let number =
            |option: &str, text: &Option<String>| text.as_deref().map(|t| values::number(option, t)).transpose();
        if let Some(times) = &self.times {
            let beside = [("--from", &self.from), ("--to", &self.to), ("--steps", &self.steps)];
            if let Some((name, _)) = beside.into_iter().find(|(_, value)| value.is_some()) {
                return Err(Failure::option("--times", format!("cannot stand beside {name}; use one or the other")));
            }
            return values::times("--times", times);
        }
        let from = number("--from", &self.from)?.unwrap_or(0.0);
        let steps = self.steps.as_deref().map(values::steps).transpose()?.unwrap_or(STEPS);
        match number("--to", &self.to)? {
            Some(to) => values::grid(from, to, steps),
            None => Err(Failure::Usage("no instants: write --from A --to B --steps N, or --times T1,T2,…".to_owned())),
        }
    }
}

pub(super) fn run(args: &SweepArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let times = args.times()?;
    let setup = args.setup.apply_complete(engine)?;
    let engine = &*engine;
    // A long sweep fails at its start, when the drivers leave the motion open there.
    let first = times.first().copied().unwrap_or(0.0);
    let (start, _) = driven_state(engine, &setup, first, args.freedom.least_norm)?;
    let (mut trajectory, mut ended) = engine.sweep(&setup, &times, args.stop_at_events);
    let ended = ended.take().map(|error| analysis(engine, &error)).or_else(|| {
        // A sweep may also pass through a position where the drivers lose their grip.
        let states = &mut trajectory.states;
        let open = states.iter().position(|s| s.degrees_of_freedom_left > 0).filter(|_| !args.freedom.least_norm)?;
        let at = states.get(open).map_or(f64::NAN, |s| s.t);
        let failure = states.get(open).map(|s| engine.mobility(&setup, &s.instant(), &s.q));
        states.truncate(open);
        trajectory.events.retain(|event| (event.t - first).abs() < (at - first).abs());
        match failure {
            Some(Ok(mobility)) => fully_driven(engine, &mobility, at).err(),
            Some(Err(error)) => Some(analysis(engine, &error)),
            None => None,
        }
    });
    let motions = if args.points { motions(engine, &trajectory.states)? } else { Vec::new() };
    let text = render(args, engine, &trajectory, &motions, ended.is_none())?;
    note_events(session, &trajectory);
    note_fallbacks(session, &trajectory);
    match ended {
        None => {
            note_freedom(session, start.degrees_of_freedom_left);
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

/// Where unilateral conditions met their limits.
fn note_events(session: &mut Session<'_>, trajectory: &Trajectory) {
    let violated: Vec<&str> = trajectory.violated_at_start().map(|condition| condition.name).collect();
    if !violated.is_empty() {
        session.note(&format!("note: violated at the first instant: {}", violated.join(", ")));
    }
    for event in &trajectory.events {
        session.note(&condition::line(trajectory.model, event));
    }
    if trajectory.stopped {
        session.note("note: the sweep stopped there; the last row is the event");
    }
}

/// Where full Newton took over from the plan.
fn note_fallbacks(session: &mut Session<'_>, trajectory: &Trajectory) {
    if let Some(first) = trajectory.fallbacks.first() {
        let steps = count(trajectory.fallbacks.len(), "internal step");
        session.note(&format!("note: full Newton took over from the plan on {steps}, first {first}"));
    }
}

fn motions(engine: &dyn Engine, states: &[State]) -> Result<Vec<Motion>, Failure> {
    states.iter().map(|s| engine.motion(s).map_err(|e| analysis(engine, &e))).collect()
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
