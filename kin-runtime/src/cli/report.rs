//! The report, which is printed without a command: everything about the mechanism at one instant.

use super::check::{facts, find};
use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::info;
use super::options::{AngleArgs, FreedomArgs, SetupArgs};
use super::output::{Form, OutputArgs, json};
use super::session::Session;
use super::solve::{body, record};
use super::solved::{note_freedom, note_modes, note_start, solve};
use super::task::{At, AtArgs};
use crate::present::json::record;
use crate::present::number::rounded;
use crate::present::structure::KnownConfiguration;
use crate::present::text;

/// Random configurations of the cross-check in the report.
const CONFIGURATIONS: usize = 32;

/// The options of the report.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ReportArgs {
    #[command(flatten)]
    at: AtArgs,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    angles: AngleArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let plot = if cfg!(feature = "plot") { names.analysis("plot --out motion.svg", "diagrams") } else { None };
        let animate = names.analysis("animate --out motion.html", "see it move, in a browser");
        let written = cfg!(feature = "equations").then(|| ("equations".to_owned(), "how they are derived"));
        vec![
            names.analysis("", "everything at t = 0"),
            names.analysis(&format!("solve --at {}", names.at), "position, velocity and acceleration at one instant"),
            if names.drawn { animate } else { None },
            names.analysis("info", "counts, rows, degrees of freedom, the solution plan"),
            names.analysis("sweep --steps 100 --out motion.csv", "over many instants"),
            plot,
            written,
            names.with("solve --set", &names.set, "with a dimension of your own"),
            Some(("check".to_owned(), "are the closed forms right?")),
        ]
    },
    details: "\
Without a command: a full report at t = 0, or at --at T. Every command has --help with examples of
its own. --set, --guess, --given, --input and --mode may be repeated.

Numbers may be expressions (-0.5, pi/2, 2*(1 + 0.1)) and have units if the unit of the quantity is
known: --set r=200mm, --guess crank.phi=60deg, --input u=0.3m,5cm/s. They are converted to the unit
of the quantity; a number without a unit is in that unit already. An instant may be written as the
angle by which a crank that is driven at constant speed has turned since t = 0: --to 1turn.
--degrees shows the angles of the result in degrees, also in csv and in json (see `units` there).

Results go to stdout or --out, everything else to stderr. The status is 0 when the answer is good,
1 when there is none, 2 when the options make no sense, 130 after Ctrl-C. On a terminal there are
colours, unless NO_COLOR is set.",
};

pub(super) fn run(args: &ReportArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let at = args.at.read(&mut ledger, ("", &args.output), SetupArgs::apply, engine, session);
    let At { t, setup, output } = ledger.close(at)?;
    let engine = &*engine;
    let solved = match setup.complete().and_then(|()| solve(engine, &setup, t, args.freedom.least_norm)) {
        Ok(solved) => solved,
        Err(failure) => {
            // Text on stdout begins with what is known without a solution; the error follows.
            if output.is_for_people() {
                session.deliver(&output, &info::text(engine, None))?;
            }
            return Err(failure);
        }
    };
    note_freedom(session, solved.state.degrees_of_freedom_left);
    note_start(session, &solved.mobility);
    note_modes(session, engine, &setup, t);
    let findings = find(engine, &setup, t, Some(&solved.state), CONFIGURATIONS, &session.watch())?;
    let q = solved.state.q.clone();
    let solved = solved.shown(engine.model(), args.angles.degrees);
    let known = KnownConfiguration { t, q: &q, mobility: &solved.mobility, modes: &solved.modes };
    let model = engine.model();
    let text = match output.form {
        Form::Json => {
            let (info, state) = (info::record(engine, Some(known)), record(engine, &solved));
            json(&record! { info: info, state: state, check: findings })?
        }
        _ => format!(
            "{}\nAt t = {}{}\n{}{}{}\nChecks\n{}",
            info::text(engine, Some(known)),
            rounded(t),
            if solved.degrees { ", angles in degrees" } else { "" },
            body(model, &solved),
            text::ratios(model, &solved.ratios),
            text::quality(&solved.state, &solved.mobility),
            facts(&findings).render(),
        ),
    };
    session.deliver(&output, &text)?;
    if findings.passed() {
        Ok(())
    } else {
        Err(Failure::Analysis("the checks fail; run `check` to see them".to_owned()))
    }
}
