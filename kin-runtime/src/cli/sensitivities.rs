//! `sensitivities`: derivatives by the parameters at one instant, and what tolerances come to.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::names::{Kind, find_in};
use super::number::Measured;
use super::options::{FreedomArgs, SetupArgs};
use super::output::{Form, OutputArgs};
use super::session::Session;
use super::solved::{analysis, driven_state, note_modes};
use super::task::{At, AtArgs};
use super::values;
use crate::model::Model;
use crate::present::json::to_json;
use crate::present::number::plain;
use crate::present::sensitivities::{deviations, quantities, text, tolerance_text};
use crate::sensitivities::{Deviation, Sensitivities};
use std::collections::BTreeMap;

/// Derivatives by the dimensions: which of them matters most
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SensitivitiesArgs {
    #[command(flatten)]
    at: AtArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    /// What tolerances come to: NAME=DEVIATION on either side
    #[arg(
        long,
        value_name = "NAME=DEVIATION",
        long_help = "\
What tolerances of parameters come to, NAME=DEVIATION on either side: for every quantity
the worst case and the root sum of squares, to first order"
    )]
    tolerance: Vec<String>,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        if !names.determined {
            return Vec::new();
        }
        vec![
            names.analysis(&format!("sensitivities --at {}", names.at), ""),
            names.with("sensitivities --tolerance", &names.set, "what deviations come to"),
            names.analysis("sensitivities --format json", "for another program"),
        ]
    },
    details: "\
Derivatives are exact; instant, inputs and assembly mode are held. Units are those of the
quantity by those of the parameter.",
};

/// Sensitivities, and what tolerances come to.
#[derive(serde::Serialize)]
struct Record<'a> {
    #[serde(flatten)]
    sensitivities: &'a Sensitivities,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    tolerances: BTreeMap<&'a str, Deviation>,
}

pub(super) fn run(args: &SensitivitiesArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let to = ("sensitivities", &args.output);
    let at = args.at.read(&mut ledger, to, SetupArgs::apply_complete, engine, session);
    let tolerances = ledger.take(tolerances(&args.tolerance, engine.model()));
    let (At { t, setup, output }, tolerances) = ledger.close(at.zip(tolerances))?;
    let (state, _) = driven_state(engine, &setup, t, args.freedom.least_norm)?;
    note_modes(session, engine, &setup, t);
    let found = engine.sensitivities(&setup, &state).map_err(|error| analysis(engine, &error))?;
    let (model, values) = (engine.model(), engine.parameters());
    let deviations = if args.tolerance.is_empty() { Vec::new() } else { deviations(&found, &tolerances) };
    let text = match output.form {
        Form::Json => {
            let tolerances = deviations.iter().map(|(name, deviation)| (name.as_str(), *deviation)).collect();
            to_json(&Record { sensitivities: &found, tolerances }).map_err(Failure::Output)?
        }
        Form::Csv => csv(&found),
        _ => format!(
            "{}, sensitivities at t = {}\n{}{}",
            model.name,
            plain(t),
            text(&found, &values),
            tolerance_text(&deviations)
        ),
    };
    session.deliver(&output, &text)
}

/// A tolerance for every parameter, 0 where none is given.
fn tolerances(texts: &[String], model: &Model) -> Result<Vec<f64>, Failure> {
    const OPTION: &str = "--tolerance";
    let names: Vec<&str> = model.parameters.iter().map(|parameter| parameter.name).collect();
    let mut all = vec![0.0; names.len()];
    let mut ledger = Ledger::default();
    let example = format!("{}=0.001", names.first().unwrap_or(&"NAME"));
    for (name, value) in ledger.take(values::assignments(OPTION, &example, texts)).unwrap_or_default() {
        let place = ledger.take(find_in(model, OPTION, Kind::Parameter, &name, &names));
        let value = values::number(&format!("{OPTION} {name}"), &value, Measured::parameter(model, &name));
        if let (Some(place), Some(value)) = (place, ledger.take(value)) {
            all[place] = value;
        }
    }
    ledger.close(Some(all))
}

/// A row per quantity, a column per parameter.
fn csv(found: &Sensitivities) -> String {
    let names: Vec<&str> = found.by.iter().map(|by| by.parameter).collect();
    let mut out = format!("quantity,{}\n", names.join(","));
    for (name, derivative) in quantities(found) {
        let values: Vec<String> = found.by.iter().map(|by| plain(derivative(by))).collect();
        out += &format!("{name},{}\n", values.join(","));
    }
    out
}
