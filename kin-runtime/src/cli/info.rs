//! `info`: the structure of the mechanism.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::options::SetupArgs;
use super::output::{Form, OutputArgs, json};
use super::session::Session;
use super::solved::analysis;
use super::task::{At, AtArgs};
use crate::mobility::RedundantRow;
use crate::model::{Model, OperationCount};
use crate::present::condition;
use crate::present::json::Record;
use crate::present::plan;
use crate::present::structure::{KnownConfiguration, drivers, structure};
use crate::present::text::{self, Facts, coordinate_names, count};
use crate::signal::Instant;

/// Counts, rows and their classes, degrees of freedom, the solution plan
#[derive(Clone, Debug, clap::Args)]
pub(super) struct InfoArgs {
    #[command(flatten)]
    at: AtArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        vec![
            names.analysis("info", ""),
            names.with("info --at 0.5 --set", &names.set, "at another instant, with a dimension of your own"),
            names.analysis("info --format json", "for another program"),
        ]
    },
    details: "\
Degrees of freedom follow from the rank of Φ_q at an assembled configuration. If the mechanism
cannot be assembled, everything else is printed and the status is 1.",
};

pub(super) fn run(args: &InfoArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let at = args.at.read(&mut ledger, ("info", &args.output), SetupArgs::apply, engine, session);
    let At { t, setup, output } = ledger.close(at)?;
    let engine = &*engine;
    if !setup.missing_inputs.is_empty() {
        session.note(&format!("note: inputs without a value are taken as 0: {}", setup.missing_inputs.join(", ")));
    }
    let at = Instant { t, inputs: &setup.inputs };
    let solved = engine.assemble(&setup, t).and_then(|q| engine.mobility(&setup, &at, &q).map(|m| (q, m)));
    let modes = solved.as_ref().map_or_else(|_| Vec::new(), |(q, _)| engine.modes(&at, q));
    let known = solved.as_ref().ok().map(|(q, mobility)| KnownConfiguration { t, q, mobility, modes: &modes });
    let text = match output.form {
        Form::Json => json(&record(engine, known))?,
        _ => text(engine, known) + &plan::text(&plan::modes(engine.model(), known.map(|k| k.modes))),
    };
    session.deliver(&output, &text)?;
    match solved {
        Ok(_) => Ok(()),
        // Inputs without a value were taken as 0. If the mechanism does not close with 0, that is no error.
        Err(_) if !setup.missing_inputs.is_empty() => {
            session
                .note("note: with these the mechanism has no configuration; degrees of freedom and ranks need --input");
            Ok(())
        }
        Err(error) => {
            session.note("note: degrees of freedom, ranks and redundant rows need a configuration, and there is none");
            Err(analysis(engine, &error))
        }
    }
}

/// The structure, for JSON.
pub(super) fn record(engine: &dyn Engine, known: Option<KnownConfiguration<'_>>) -> Record {
    structure(engine.model(), &engine.parameters(), known)
}

/// Name, counts, parameters, rows.
pub(super) fn text(engine: &dyn Engine, known: Option<KnownConfiguration<'_>>) -> String {
    let model = engine.model();
    let mut facts = Facts::default();
    if !model.bodies.is_empty() {
        facts.add("bodies", model.bodies.len(), model.bodies.iter().map(|b| b.name));
    }
    facts
        .add("coordinates", model.coordinates.len(), Vec::<String>::new())
        .add("rows of Φ", model.rows.len(), row_summary(model))
        .add("drivers", drivers(model).len(), drivers(model));
    if !model.conditions.is_empty() {
        facts.add("conditions", model.conditions.len(), model.conditions.iter().map(|c| c.name));
    }
    if !model.inputs.is_empty() {
        facts.add("inputs", model.inputs.len(), model.inputs.iter().copied());
    }
    if !model.functions.is_empty() {
        facts.add("supplied functions", model.functions.len(), model.functions.iter().copied());
    }
    if let Some(KnownConfiguration { mobility, .. }) = known {
        let freedom_left = mobility.degrees_of_freedom_left;
        let (coordinates, of_joints) = (mobility.coordinates, mobility.rows - mobility.driving_rows);
        let counted = coordinates as i64 - of_joints as i64;
        let driven = if freedom_left == 0 {
            "fully driven".to_owned()
        } else {
            format!("{freedom_left} left open by the drivers")
        };
        facts
            .add("degrees of freedom", mobility.degrees_of_freedom, [driven])
            .add(
                "  Grübler's count",
                counted,
                [format!("{} − {} of joints", count(coordinates, "coordinate"), count(of_joints, "row"))],
            )
            .add("  independent", mobility.independent.len(), coordinate_names(model, &mobility.independent))
            .add("  dependent", mobility.dependent.len(), coordinate_names(model, &mobility.dependent));
        if mobility.velocity_level_rows > 0 {
            let freedom_left = mobility.position_degrees_of_freedom_left;
            let start = if freedom_left == 0 {
                "all determined".to_owned()
            } else {
                format!("{freedom_left} decided by the start")
            };
            facts.add("  of position", mobility.position_degrees_of_freedom, [start]);
        }
        if let Some(generic) = mobility.generic_degrees_of_freedom.filter(|g| *g < mobility.degrees_of_freedom) {
            facts.add("  in general", generic, ["with other dimensions, at another pose"]);
        }
        if !mobility.redundant.is_empty() {
            facts.add("redundant rows", mobility.redundant.len(), mobility.redundant.iter().map(redundancy));
        }
    }
    let (total, each) = operations(model.operations);
    facts.add("operations", total, [format!("{} for Φ, Φ_q, Φ_t, γ together", each.join(", "))]);
    if let Some(forces) = model.forces {
        let (total, each) = operations(forces.operations);
        facts.add("  of all forces", total, [each.join(", ")]);
    }
    let doc = text::title(model);
    let parameters = text::parameters(model, &engine.parameters());
    let (rows, conditions) = (text::rows(model), condition::declared(model));
    format!("{doc}\n{}{parameters}{rows}{conditions}{}", facts.render(), plan::plan(model))
}

fn redundancy(row: &RedundantRow) -> String {
    format!("{} {}", row.name, row.relation(" + "))
}

/// How many rows of which class.
fn row_summary(model: &Model) -> Vec<String> {
    let mut kinds: Vec<([&str; 3], usize)> = Vec::new();
    for row in model.rows {
        match kinds.iter_mut().find(|(class, _)| *class == row.classes()) {
            Some((_, number)) => *number += 1,
            None => kinds.push((row.classes(), 1)),
        }
    }
    kinds.iter().map(|(class, number)| format!("{number} {}", class.join(" "))).collect()
}

/// The number of all operations of one evaluation, and the number of each kind.
fn operations(o: OperationCount) -> (usize, Vec<String>) {
    let all = [
        (o.mul, "mul"),
        (o.add, "add"),
        (o.neg, "neg"),
        (o.div, "div"),
        (o.sqrt, "sqrt"),
        (o.sincos, "sincos"),
        (o.function, "function"),
    ];
    let shown = all
        .iter()
        .filter(|(number, _)| *number > 0)
        .map(|(number, operation)| format!("{number} {operation}"))
        .collect();
    (all.iter().map(|(number, _)| number).sum(), shown)
}
