//! `forces`: what drivers supply and joints carry at one instant.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger, zip3};
use super::instants::instant;
use super::options::{FreedomArgs, InstantArgs, SetupArgs};
use super::output::{Form, OutputArgs};
use super::session::Session;
use super::solved::{analysis, driven_state, note_freedom};
use crate::measure::{column_names, column_values};
use crate::present::forces::text;
use crate::present::json::to_json;
use crate::present::number::plain;

/// What drivers supply and joints carry at one instant
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ForcesArgs {
    #[command(flatten)]
    instant: InstantArgs,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let all = vec![
            names.analysis(&format!("forces --at {}", names.at), ""),
            names.with("forces --set", &names.set, "with other dimensions"),
            names.analysis("forces --format json", "for another program"),
        ];
        // Without masses and loads no example has an answer.
        if names.loads { all } else { Vec::new() }
    },
    details: "\
Efforts are torques along angles and forces along lengths, positive when they do positive work
while the driven quantity grows. A joint's force and moment act on the body of its second
operand, at the joint's point; the other body receives the opposite. Shaking is what the
mechanism exerts on the ground, its moment about the origin. Units follow the parameters.",
};

pub(super) fn run(args: &ForcesArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let (t, output) =
        (ledger.take(args.instant.time(engine.model())), ledger.take(session.destination(&args.output, "forces")));
    let setup = ledger.take(args.setup.apply_complete(engine));
    let (t, output, setup) = ledger.close(zip3(t, output, setup))?;
    let t = instant("--at", t, &*engine, &setup)?;
    let (state, _) = driven_state(engine, &setup, t, args.freedom.least_norm)?;
    note_freedom(session, state.degrees_of_freedom_left);
    let forces = engine.forces(&setup, &state).map_err(|error| analysis(engine, &error))?;
    if forces.reactions.iter().any(|reaction| !reaction.determined) {
        session.note(
            "note: redundant rows share the load: equilibrium alone does not tell what is undetermined; the bodies' \
             stiffness would",
        );
    }
    let text = match output.form {
        Form::Json => to_json(&forces).map_err(Failure::Output)?,
        Form::Csv => {
            let (names, mut values) = (column_names(engine.model()), Vec::new());
            column_values(engine.model(), Some(&forces), &mut values);
            let values: Vec<String> =
                values.into_iter().map(|v| if v.is_finite() { plain(v) } else { String::new() }).collect();
            format!("t,{}\n{},{}\n", names.join(","), plain(t), values.join(","))
        }
        _ => format!("{}, forces at t = {}\n{}", engine.model().name, plain(t), text(&forces)),
    };
    session.deliver(&output, &text)
}
