//! `forces`: the efforts of drivers and the reactions in joints at one instant.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::force_notes::unilateral_violations;
use super::options::SetupArgs;
use super::output::{Form, OutputArgs, json};
use super::session::Session;
use super::setup::Setup;
use super::solved::{analysis, driven_state, note_freedom, note_modes};
use super::task::{At, AtArgs};
use crate::analysis::forces::unbounded;
use crate::error::SolveError;
use crate::measure::{Measure, column_values, columns};
use crate::present::forces::text;
use crate::present::grid::exact;
use crate::present::number::{plain, rounded};

/// Efforts of drivers and reactions in joints at one instant
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ForcesArgs {
    #[command(flatten)]
    at: AtArgs,
    /// The least forces and rates where these are left open
    #[arg(
        long,
        long_help = "\
Where redundant joints share a load, the least forces; where drivers leave the
motion open, the smallest q̇ and q̈"
    )]
    least_norm: bool,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let all = vec![
            names.analysis(&format!("forces --at {}", names.at), ""),
            names.with("forces --set", &names.set, "with dimensions of your own"),
            names.analysis("forces --format json", "for another program"),
        ];
        // Without masses and loads no example has an answer.
        if names.loads { all } else { Vec::new() }
    },
    details: "\
Efforts are torques along angles and forces along lengths, positive when they do positive work
while the driven quantity grows. A joint's force and moment act on the body of its second
operand, at the joint's point; the other body receives the opposite. Shaking is what the
mechanism exerts on the ground, its moment about the origin. Units follow the parameters.

A note reports contacts whose normal force is negative and ropes that would have to push (`sweep`
finds when they lift off and go slack). At a dead centre forces do not exist; the error names the
joints and drivers whose forces grow without bounds.",
};

pub(super) fn run(args: &ForcesArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let at = args.at.read(&mut ledger, ("forces", &args.output), SetupArgs::apply_complete, engine, session);
    let At { t, setup, output } = ledger.close(at)?;
    let setup = Setup { least_norm: args.least_norm, ..setup };
    let (state, _) = driven_state(engine, &setup, t, args.least_norm).map_err(|failure| {
        // In a singular configuration, where velocities do not exist, the error names the joints whose forces grow
        // without bounds near it.
        let singular = engine.state(&setup, t).err().filter(|error| matches!(error, SolveError::Singular { .. }));
        singular.map_or(failure, |error| analysis(engine, &unbounded(engine.model(), error)))
    })?;
    note_freedom(session, state.degrees_of_freedom_left);
    note_modes(session, engine, &setup, t);
    let forces = engine.forces(&setup, &state).map_err(|error| analysis(engine, &error))?;
    let undetermined = forces.reactions.iter().any(|reaction| !reaction.determined)
        || forces.efforts.iter().any(|effort| !effort.determined);
    if undetermined {
        session.note(match args.least_norm {
            true => {
                "note: redundant rows share the load, and equilibrium alone does not determine how; these are the forces \
                 of least norm"
            }
            false => {
                "note: redundant rows share the load, and equilibrium alone does not determine how: that depends on the \
                 bodies' stiffness; --least-norm gives the forces of least norm"
            }
        });
    }
    unilateral_violations(&forces).iter().for_each(|sentence| session.note(&format!("note: {sentence}")));
    let text = match output.form {
        Form::Json => json(&forces)?,
        Form::Csv => {
            let mut names: Vec<String> = columns(engine.model()).into_iter().map(|(name, ..)| name).collect();
            let mut values = Vec::new();
            column_values(engine.model(), Some(&forces), &mut values);
            for (measure, value) in Measure::further_efforts(&forces) {
                names.push(measure.name().to_owned());
                values.push(value);
            }
            let values: Vec<String> = values.into_iter().map(exact).collect();
            format!("t,{}\n{},{}\n", names.join(","), plain(t), values.join(","))
        }
        _ => format!("{}, forces at t = {}\n{}", engine.model().name, rounded(t), text(&forces, false)),
    };
    session.deliver(&output, &text)
}
