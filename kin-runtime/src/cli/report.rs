//! Without a command: everything about the mechanism at one instant.

use serde::Serialize;

use super::check::{Findings, facts, find};
use super::engine::Engine;
use super::failure::Failure;
use super::info;
use super::options::{Format, FreedomArgs, InstantArgs, OutputArgs, SetupArgs};
use super::session::Session;
use super::solve::{body, record};
use super::solved::{note_freedom, note_start, solve};
use crate::present::json::to_json;
use crate::present::number::plain;
use crate::present::record::StateRecord;
use crate::present::structure::{Known, StructureRecord};
use crate::present::text;

/// Random configurations of the cross-check in the report.
const CONFIGURATIONS: usize = 32;

/// The options of the report.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ReportArgs {
    #[command(flatten)]
    instant: InstantArgs,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// The report as JSON.
#[derive(Serialize)]
struct ReportRecord<'a> {
    info: StructureRecord<'a>,
    state: StateRecord<'a>,
    check: Findings,
}

pub(super) fn run(args: &ReportArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let t = args.instant.time()?;
    let setup = args.setup.apply(engine)?;
    let engine = &*engine;
    let format = args.output.format();
    if format == Format::Csv {
        return Err(Failure::option("--format", "the report has no csv form; `solve --format csv` has"));
    }
    let solved = match setup.complete().and_then(|()| solve(engine, &setup, t, args.freedom.least_norm)) {
        Ok(solved) => solved,
        Err(failure) => {
            // A person is told what can be said without a solution; the error follows.
            if format == Format::Text && args.output.file().is_none() {
                session.deliver(&args.output, &info::text(engine, None))?;
            }
            return Err(failure);
        }
    };
    note_freedom(session, solved.state.degrees_of_freedom_left);
    note_start(session, &solved.mobility);
    let known = Known { t, q: &solved.state.q, mobility: &solved.mobility, modes: &solved.modes };
    let findings = find(engine, t, Some(&solved.state), CONFIGURATIONS)?;
    let model = engine.model();
    let text = match format {
        Format::Json => to_json(&ReportRecord {
            info: info::record(engine, Some(known)),
            state: record(engine, &solved),
            check: findings.clone(),
        })
        .map_err(Failure::Output)?,
        _ => format!(
            "{}\nAt t = {}\n{}{}{}\nChecks\n{}",
            info::text(engine, Some(known)),
            plain(t),
            body(model, &solved),
            text::ratios(model, &solved.ratios),
            text::quality(&solved.state, &solved.mobility),
            facts(&findings).render(),
        ),
    };
    session.deliver(&args.output, &text)?;
    if findings.passed() { Ok(()) } else { Err(Failure::Analysis("the checks fail; `check` says more".to_owned())) }
}
