//! The command-line program of a mechanism.
//!
//! ```no_run
//! # use kin_runtime::{cli, Mechanism};
//! # fn program<FourBar: Mechanism + Default>() -> std::process::ExitCode {
//! cli::main::<FourBar>()
//! # }
//! ```
//!
//! The commands are `info`, `solve`, `sweep`, `animate`, `plot` and `equations` (with the
//! features of their names) and `check`, one per file; without a command a report at t = 0 is printed.
//! Results go to stdout or to the file of `--out`, everything else to stderr. The exit status is 0 only when the
//! answer is good, 2 when the options make no sense, and 1 when the mechanism has no good answer.
//!
//! Only the few calls that touch the mechanism's type are generic; they are behind the trait of `engine.rs`, so that
//! this program is compiled once and not for every mechanism.

use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::error::{ContextKind, ErrorKind};
use clap::{CommandFactory, FromArgMatches};

use crate::mechanism::Mechanism;
use crate::model::Model;
use engine::{Bound, Engine};
use failure::Failure;
use session::Session;

mod animate;
mod check;
mod columns;
mod engine;
#[cfg(feature = "equations")]
mod equations;
mod failure;
mod info;
mod moving;
mod names;
mod options;
#[cfg(feature = "plot")]
mod plot;
mod report;
mod session;
mod solve;
mod solved;
mod sweep;
mod values;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;

/// Runs the program of the mechanism `M` with the arguments of this process.
pub fn main<M: Mechanism + Default>() -> ExitCode {
    run_from::<M>(std::env::args_os())
}

/// Runs the program of the mechanism `M` with these arguments; the first is the program's name.
///
/// For a program that hosts several mechanisms.
pub fn run_from<M: Mechanism + Default>(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    let args = args.into_iter().map(Into::into).collect();
    let mut engine = Bound::new(M::default());
    let (mut out, mut err) = (io::stdout().lock(), io::stderr());
    ExitCode::from(run(&mut engine, args, &mut out, &mut err))
}

/// Exact position, velocity and acceleration analysis of one mechanism.
#[derive(Debug, clap::Parser)]
#[command(args_conflicts_with_subcommands = true, subcommand_value_name = "COMMAND")]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    report: report::ReportArgs,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    Info(info::InfoArgs),
    Solve(solve::SolveArgs),
    Sweep(sweep::SweepArgs),
    Check(check::CheckArgs),
    #[cfg(feature = "equations")]
    Equations(equations::EquationsArgs),
    Animate(animate::AnimateArgs),
    #[cfg(feature = "plot")]
    Plot(plot::PlotArgs),
}

/// The whole program, with its streams as arguments; gives the exit status.
fn run(engine: &mut dyn Engine, args: Vec<OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    let mut session = Session::new(out, err);
    let arguments = match parse(engine, args) {
        Ok(arguments) => arguments,
        Err(error) => {
            let mut text = error.render().to_string();
            if error.kind() == ErrorKind::ArgumentConflict && error.get(ContextKind::InvalidSubcommand).is_some() {
                text.push_str("\nOptions stand behind the command: solve --at 0.5\n");
            }
            let asked_for = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
            return if asked_for { session.print(&text) } else { session.complain(&text, 2) };
        }
    };
    let done: Result<(), Failure> = match &arguments.command {
        None => report::run(&arguments.report, engine, &mut session),
        Some(Command::Info(args)) => info::run(args, engine, &mut session),
        Some(Command::Solve(args)) => solve::run(args, engine, &mut session),
        Some(Command::Sweep(args)) => sweep::run(args, engine, &mut session),
        Some(Command::Check(args)) => check::run(args, engine, &mut session),
        #[cfg(feature = "equations")]
        Some(Command::Equations(args)) => equations::run(args, engine, &mut session),
        Some(Command::Animate(args)) => animate::run(args, engine, &mut session),
        #[cfg(feature = "plot")]
        Some(Command::Plot(args)) => plot::run(args, engine, &mut session),
    };
    session.finish(done)
}

fn parse(engine: &dyn Engine, args: Vec<OsString>) -> Result<Arguments, clap::Error> {
    let model = engine.model();
    let command = Arguments::command()
        .name(model.name)
        .about(if model.doc.is_empty() { "A planar mechanism" } else { model.doc })
        .version(concat!("(kin ", env!("CARGO_PKG_VERSION"), ")"))
        .after_help(after_help(model));
    Arguments::from_arg_matches(&command.try_get_matches_from(with_negative_values(args))?)
}

/// Writes `--at -0.5` as `--at=-0.5`, so that a minus sign starts a value and two start the next option.
fn with_negative_values(args: Vec<OsString>) -> Vec<OsString> {
    let text = |arg: &OsString| arg.to_str().unwrap_or_default().to_owned();
    let mut out: Vec<OsString> = Vec::with_capacity(args.len());
    for arg in args {
        let takes_value = out.last().map(text).is_some_and(|before| before.starts_with("--") && !before.contains('='));
        let this = text(&arg);
        let negative = this.len() > 1 && this.starts_with('-') && !this.starts_with("--");
        match out.last_mut() {
            Some(before) if takes_value && negative && !matches!(this.as_str(), "-h" | "-V") => {
                before.push("=");
                before.push(arg);
            }
            _ => out.push(arg),
        }
    }
    out
}

/// What stands under the options: the names of this mechanism, and examples.
fn after_help(model: &Model) -> String {
    let parameters: Vec<&str> = model.parameters.iter().map(|p| p.name).collect();
    let coordinates: Vec<&str> = model.coordinates.iter().map(|c| c.name).collect();
    [
        ("Parameters:  ", parameters.as_slice()),
        ("Coordinates: ", coordinates.as_slice()),
        ("Inputs:      ", model.inputs),
    ]
    .into_iter()
    .filter(|(_, names)| !names.is_empty())
    .map(|(lead, names)| names::listing(lead, names) + "\n")
    .chain(std::iter::once(format!("\n{EXAMPLES}")))
    .collect()
}

const EXAMPLES: &str = "\
Without a command: a full report at t = 0 (or --at T).

Examples, after the program's name:
  info                                    counts, rows, degrees of freedom
  solve --at 0.5 --set l1=0.12            position, velocity, acceleration at one instant
  sweep --from 0 --to 1 --steps 100 --format csv --out motion.csv
  animate --out motion.html               see it move, in a browser
  check                                   are the closed forms right?
Every command has --help with examples of its own. --set, --guess, --given and --input may be repeated.
Negative numbers are fine as values: --at -0.5.";
