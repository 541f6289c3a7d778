//! `limits`: the intervals of time in which the mechanism closes, mode by mode, and the dead centres at which they end.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger, zip3};
use super::instants::{MotionEnd, RequestedInstants};
use super::options::SetupArgs;
use super::output::{Form, OutputArgs, json};
use super::session::Session;
use super::setup::Setup;
use super::solved::analysis;
use super::values;
use crate::present::number::rounded;
use crate::present::ranges;

/// How far the mechanism moves in each assembly mode, and the dead centres that end it
#[derive(Clone, Debug, clap::Args)]
pub(super) struct LimitsArgs {
    /// The first instant [default: 0]
    #[arg(long, value_name = "A")]
    from: Option<String>,
    /// The last instant [default: one driven turn, or 1]
    #[arg(long, value_name = "B")]
    to: Option<String>,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let all = vec![
            names.analysis("limits", ""),
            names.with("limits --set", &names.set, "with a dimension of your own"),
            names.analysis("limits --format json", "for another program"),
        ];
        let [.., limits] = names.proven;
        if limits { all } else { Vec::new() }
    },
    details: "\
Ranges are proven: the plan is evaluated over intervals of t; on an interval where all of its
margins are positive, the mechanism can be assembled at every t. Where groups close by iteration,
all dead centres are searched for, which takes seconds. Ranges that meet at a dead centre are one
circuit: there the motion can go from one mode into the other. The json has one entry per limit
and driver that can go no further. The status is 1 if a limit is not proven.",
};

pub(super) fn run(args: &LimitsArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let model = engine.model();
    let moment =
        |option: &str, text: &Option<String>| text.as_deref().map(|t| values::moment(option, t, model)).transpose();
    let ends = ledger.take(moment("--from", &args.from)).zip(ledger.take(moment("--to", &args.to)));
    let output = ledger.take(session.destination(&args.output, "limits"));
    let setup = ledger.take(args.setup.apply_complete(engine).and_then(Setup::without_closure));
    let all_modes = ledger.take(args.setup.without_mode("limits"));
    let (((from, to), output, setup), ()) = ledger.close(zip3(ends, output, setup).zip(all_modes))?;
    let from = MotionEnd::At(from.unwrap_or(values::TimeOrAngle::At(0.0)));
    let times = RequestedInstants::Grid { from, to: to.map(MotionEnd::At), steps: 1 }.instants(&*engine, &setup)?.times;
    let (Some(&from), Some(&to)) = (times.first(), times.last()) else { return Ok(()) };
    let all = engine.ranges(&setup, from, to).map_err(|error| analysis(engine, &error))?;
    let text = match output.form {
        Form::Json => json(&ranges::records(&all))?,
        _ => ranges::text(model, [from, to], &all),
    };
    for (coordinate, within) in &all.searched {
        let [from, to] = [within.lower(), within.upper()].map(rounded);
        session.note(&format!("note: closures are searched with {coordinate} between {from} and {to} only"));
    }
    if let (Form::Json, [], ranges) = (output.form, &all.limits[..], &all.ranges[..]) {
        let message = if ranges.is_empty() { "it closes nowhere" } else { "no range has a limit" };
        session.note(&format!("note: {message} from t = {} to t = {}", rounded(from), rounded(to)));
    }
    session.deliver(&output, &text)?;
    match all.limits.iter().find(|limit| !limit.proven) {
        None => Ok(()),
        Some(limit) => Err(Failure::Analysis(format!("{}: {limit}", model.name))),
    }
}
