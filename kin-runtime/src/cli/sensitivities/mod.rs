//! `sensitivities`: derivatives with respect to the parameters at one instant or along a motion, and the deviations
//! that tolerances cause.

mod motion;

use crate::cli::columns::quantities as named;
use crate::cli::degrees;
use crate::cli::engine::Engine;
use crate::cli::examples::{Help, Names};
use crate::cli::failure::{Failure, Ledger};
use crate::cli::instants::GridArgs;
use crate::cli::options::{AngleArgs, FreedomArgs};
use crate::cli::output::{Form, OutputArgs, json};
use crate::cli::session::Session;
use crate::cli::solved::{analysis, driven_state, note_modes};
use crate::cli::task::{AtArgs, MotionTask};
use crate::cli::tolerance::tolerances;
use crate::measure::Measure;
use crate::present::json::{fields, record};
use crate::present::number::{plain, rounded};
use crate::present::sensitivities::{deviations, quantities, text, tolerance_text};
use crate::present::units::ResultUnits;
use crate::sensitivities::Sensitivities;
use std::collections::BTreeMap;

/// Derivatives by the dimensions: which of them matters most
#[derive(Clone, Debug, clap::Args)]
pub(in crate::cli) struct SensitivitiesArgs {
    /// Quantities by name: B.transmission, tip.x [default: all, or the outputs along a motion]
    #[arg(value_name = "WHAT")]
    what: Vec<String>,
    #[command(flatten)]
    at: AtArgs,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    angles: AngleArgs,
    /// Deviations caused by tolerances, NAME=D on either side
    #[arg(
        long,
        value_name = "NAME=D",
        long_help = "\
Deviations caused by tolerances of parameters, NAME=D on either side: for every
quantity the worst case and the root sum of squares, to first order"
    )]
    tolerance: Vec<String>,
    #[command(flatten)]
    output: OutputArgs,
}

pub(in crate::cli) const HELP: Help = Help {
    examples: |names: &Names| {
        if !names.determined {
            return Vec::new();
        }
        vec![
            names.analysis(&format!("sensitivities --at {}", names.at), ""),
            names.with("sensitivities --tolerance", &names.tolerance, "deviations caused by tolerances"),
            names.with("sensitivities --steps 90 --tolerance", &names.tolerance, "the same along the motion"),
            names.analysis("sensitivities --format json", "for another program"),
        ]
    },
    details: "\
Derivatives are exact; instant, inputs and assembly mode are held. Units are those of the
quantity by those of the parameter.

With names of quantities (those of `sweep`), or with --from, --to, --steps or --times, it says
of every quantity which parameter matters most and when; with --tolerance the greatest deviations
and when. Its csv and json have the numbers of all instants, and `plot --tolerance` draws them.",
};

pub(in crate::cli) fn run(
    args: &SensitivitiesArgs,
    engine: &mut dyn Engine,
    session: &mut Session<'_>,
) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let to = ("sensitivities", &args.output);
    let task = args.at.read_motion(&mut ledger, to, (&args.grid, motion::STEPS, args.freedom), engine, session);
    let measures = ledger.take(named(engine.model(), &args.what).and_then(differentiable));
    let tolerances = ledger.take(tolerances(&args.tolerance, engine.model()));
    let (task, (tolerances, measures)) = ledger.close(task.zip(tolerances.zip(measures)))?;
    if args.grid.is_given() || !measures.is_empty() {
        let (freedom, degrees) = (args.freedom, args.angles.degrees);
        return motion::VariedMotion { task, measures, tolerances, freedom, degrees }.run(&*engine, session);
    }
    let MotionTask { requested, setup, output } = task;
    let t = requested.first(engine, &setup)?;
    let (state, _) = driven_state(engine, &setup, t, args.freedom.least_norm)?;
    note_modes(session, engine, &setup, t);
    let found = engine.sensitivities(&setup, &state).map_err(|error| analysis(engine, &error))?;
    let found = degrees::sensitivities(&found, args.angles.degrees).into_owned();
    let (model, values) = (engine.model(), engine.parameters());
    if model.parameters.is_empty() {
        session.note("note: this mechanism has no parameters by which anything could be differentiated");
    }
    let deviations = if args.tolerance.is_empty() { Vec::new() } else { deviations(&found, &tolerances) };
    let text = match output.form {
        Form::Json => {
            let mut all = fields(&found);
            all.extend(record! { units: ResultUnits::of(model).in_degrees(args.angles.degrees).record() });
            if !deviations.is_empty() {
                let tolerances: BTreeMap<_, _> = deviations.iter().cloned().collect();
                all.extend(record! { tolerances: tolerances });
            }
            json(&all)?
        }
        Form::Csv => csv(&found),
        _ => format!(
            "{}, sensitivities at t = {}{}\n{}{}",
            model.name,
            rounded(t),
            if args.angles.degrees { ", angles in degrees" } else { "" },
            text(&found, &values),
            tolerance_text(&deviations)
        ),
    };
    session.deliver(&output, &text)
}

/// The quantities, if all of them have derivatives with respect to parameters.
fn differentiable(measures: Vec<Measure>) -> Result<Vec<Measure>, Failure> {
    match measures.iter().find(|measure| measure.is_ratio()) {
        None => Ok(measures),
        Some(ratio) => {
            let message =
                format!("`{}` is a velocity ratio, which has no derivatives by dimensions here", ratio.name());
            Err(Failure::option("WHAT", message))
        }
    }
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
