//! `modes`: all closures of the mechanism at one instant.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::options::SetupArgs;
use super::output::{Form, OutputArgs, json};
use super::session::Session;
use super::solved::analysis;
use super::task::{At, AtArgs};
use crate::present::assemblies;
use crate::present::number::rounded;

/// All ways to assemble the mechanism at one instant, each proven
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ModesArgs {
    #[command(flatten)]
    at: AtArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let all = vec![
            names.analysis("modes", ""),
            names.with("modes --set", &names.set, "with a dimension of your own"),
            names.analysis("modes --format json", "for another program"),
        ];
        let [_, closures, _] = names.proven;
        if closures { all } else { Vec::new() }
    },
    details: "\
Each closure, a way to assemble the mechanism, is certified: interval arithmetic proves that it
exists and is the only one nearby. The command also proves that the list is complete. Where signs
do not tell all closures apart, as in groups that close by iteration, all angles are searched
within a full turn around the guess; other commands select such a closure by its number,
--mode closure=2 for the second at the first instant of a motion. Undecided cases are listed, and
the status is then 1.",
};

pub(super) fn run(args: &ModesArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let at = args.at.read(&mut ledger, ("modes", &args.output), SetupArgs::apply_complete, engine, session);
    let all_modes = ledger.take(args.at.without_mode("modes"));
    let (At { t, setup, output }, ()) = ledger.close(at.zip(all_modes))?;
    let all = engine.assemblies(&setup, t).map_err(|error| analysis(engine, &error))?;
    let text = match output.form {
        Form::Json => json(&assemblies::records(&all))?,
        _ => format!("{} at t = {}\n{}", engine.model().name, rounded(t), assemblies::text(engine.model(), &all)),
    };
    session.deliver(&output, &text)?;
    if all.is_complete() {
        return Ok(());
    }
    let name = engine.model().name;
    Err(Failure::Analysis(format!("{name}: these are not proven to be all\n{}", assemblies::doubts(&all))))
}
