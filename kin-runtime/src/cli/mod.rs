//! The command-line program of a mechanism.
//!
//! ```no_run
//! # use kin_runtime::{cli, Mechanism};
//! # fn program<FourBar: Mechanism + Default>() -> std::process::ExitCode {
//! cli::main::<FourBar>()
//! # }
//! ```
//!
//! The commands are `info`, `solve`, `sweep`, `extremes`, `forces`, `sensitivities`, `modes`, `limits`, `check`,
//! `animate`, `completions` and, with the features of the same names, `design`, `plot` and `equations`. Each has a file
//! of its own. Without a command a report at t = 0 is printed. Results go to stdout or to the file of `--out`, whose
//! extension chooses the format; everything else goes to stderr. The exit status is 0 after success, 1 if an analysis
//! or a check fails or a file cannot be written, 2 if the options are invalid, 130 after Ctrl-C, where the finished
//! part of a sweep, a plot or an animation is still written, and 141, without a message, if the reader of a pipe has
//! closed it early (`… | head`).
//!
//! A computation that takes longer than a second shows a progress bar if stderr is a terminal. Terminals get colours
//! unless `NO_COLOR` is set; with `CLICOLOR_FORCE` all output is coloured.
//!
//! Only calls that need the mechanism's type are generic. They are behind the trait of `engine.rs`, so that the rest of
//! this program is compiled once and not for every mechanism.

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches};

use engine::{Bound, Engine};
use failure::Failure;
pub use program::Program;
use session::{Session, Surroundings};

mod animate;
mod check;
mod closures;
mod columns;
mod completions;
mod degrees;
#[cfg(feature = "design")]
mod design;
mod engine;
#[cfg(feature = "equations")]
mod equations;
mod examples;
mod extremes;
mod failure;
mod followed;
mod force_notes;
mod forces;
mod help;
mod info;
mod instants;
mod interrupt;
mod leg;
mod limit_search;
mod limits;
#[cfg(not(all(feature = "plot", feature = "equations", feature = "design")))]
mod missing;
mod modes;
mod motion_notes;
mod moving;
mod names;
mod number;
mod options;
mod output;
mod paint;
mod places;
#[cfg(feature = "plot")]
mod plot;
mod program;
mod report;
mod sensitivities;
mod session;
mod setup;
mod solve;
mod solved;
mod sweep;
mod task;
mod tolerance;
mod trial;
mod turns;
mod values;
mod vary;
mod watch;
#[cfg(feature = "design")]
mod wishes;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;

/// Runs the program of the mechanism `M` with the arguments of this process.
pub fn main<M: Program>() -> ExitCode {
    run_from::<M>(std::env::args_os())
}

/// Runs the program of the mechanism `M` with these arguments; the first is the program's name.
///
/// This is for a program with several mechanisms. Ctrl-C is caught during long computations; at all other times, and
/// after this function has returned, it ends the process.
pub fn run_from<M: Program>(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    let args = args.into_iter().map(Into::into).collect();
    let mut engine = Bound::new(M::default());
    let (mut out, mut err) = (io::stdout().lock(), io::stderr());
    ExitCode::from(run(&mut engine, args, &mut out, &mut err, Surroundings::of_process()))
}

/// Exact position, velocity and acceleration analysis of one mechanism.
#[derive(Debug, clap::Parser)]
#[command(args_conflicts_with_subcommands = true, subcommand_value_name = "COMMAND")]
struct CommandLine {
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
    Extremes(extremes::ExtremesArgs),
    Forces(forces::ForcesArgs),
    Sensitivities(sensitivities::SensitivitiesArgs),
    #[cfg(feature = "design")]
    Design(Box<design::DesignArgs>),
    #[cfg(not(feature = "design"))]
    #[command(hide = true)]
    Design(missing::MissingArgs),
    Modes(modes::ModesArgs),
    Limits(limits::LimitsArgs),
    Check(check::CheckArgs),
    #[cfg(feature = "equations")]
    Equations(equations::EquationsArgs),
    #[cfg(not(feature = "equations"))]
    #[command(hide = true)]
    Equations(missing::MissingArgs),
    Animate(animate::AnimateArgs),
    #[cfg(feature = "plot")]
    Plot(plot::PlotArgs),
    #[cfg(not(feature = "plot"))]
    #[command(hide = true)]
    Plot(missing::MissingArgs),
    Completions(completions::CompletionsArgs),
}

/// The whole program, with its streams as arguments; returns the exit status.
fn run(
    engine: &mut dyn Engine,
    args: Vec<OsString>,
    out: &mut dyn Write,
    err: &mut dyn Write,
    around: Surroundings,
) -> u8 {
    let mut session = Session::new(out, err, around);
    let helps = args.iter().any(|arg| matches!(arg.to_str(), Some("-h" | "--help" | "help")));
    let trial = if helps { trial::ExampleValues::of(engine) } else { None };
    let mut command = help::command(CommandLine::command(), engine, program(engine, &args), trial);
    let subcommand =
        args.iter().skip(1).filter_map(|arg| arg.to_str()).find(|arg| !arg.starts_with('-')).map(str::to_owned);
    let parsed = command.try_get_matches_from_mut(with_negative_values(args));
    let arguments = match parsed.and_then(|matches| CommandLine::from_arg_matches(&matches)) {
        Ok(arguments) => arguments,
        Err(error) if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) => {
            return session.help(&error.render());
        }
        Err(mut error) => {
            suggest_option(&mut error, &command, subcommand.as_deref());
            let hint = hint(&error, &command, subcommand.as_deref());
            return session.refuse(&error.render(), &hint);
        }
    };
    let outcome: Result<(), Failure> = match &arguments.command {
        None => report::run(&arguments.report, engine, &mut session),
        Some(Command::Info(args)) => info::run(args, engine, &mut session),
        Some(Command::Solve(args)) => solve::run(args, engine, &mut session),
        Some(Command::Sweep(args)) => sweep::run(args, engine, &mut session),
        Some(Command::Extremes(args)) => extremes::run(args, engine, &mut session),
        Some(Command::Forces(args)) => forces::run(args, engine, &mut session),
        Some(Command::Sensitivities(args)) => sensitivities::run(args, engine, &mut session),
        #[cfg(feature = "design")]
        Some(Command::Design(args)) => design::run(args, engine, &mut session),
        #[cfg(not(feature = "design"))]
        Some(Command::Design(args)) => missing::run(args, "design"),
        Some(Command::Modes(args)) => modes::run(args, engine, &mut session),
        Some(Command::Limits(args)) => limits::run(args, engine, &mut session),
        Some(Command::Check(args)) => check::run(args, engine, &mut session),
        #[cfg(feature = "equations")]
        Some(Command::Equations(args)) => equations::run(args, engine, &mut session),
        #[cfg(not(feature = "equations"))]
        Some(Command::Equations(args)) => missing::run(args, "equations"),
        Some(Command::Animate(args)) => animate::run(args, engine, &mut session),
        #[cfg(feature = "plot")]
        Some(Command::Plot(args)) => plot::run(args, engine, &mut session),
        #[cfg(not(feature = "plot"))]
        Some(Command::Plot(args)) => missing::run(args, "plot"),
        Some(Command::Completions(args)) => completions::run(args, command, engine.model(), &mut session),
    };
    session.finish(outcome)
}

/// A hint that follows clap's message about invalid arguments.
fn hint(error: &clap::Error, command: &clap::Command, subcommand: Option<&str>) -> String {
    let wrong = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(arg)) => arg.as_str(),
        _ => "",
    };
    let letters = wrong.strip_prefix('-').is_some_and(|rest| !rest.starts_with('-'));
    match error.kind() {
        ErrorKind::ArgumentConflict if error.get(ContextKind::InvalidSubcommand).is_some() => {
            "\n\nOptions follow the command: solve --at 0.5\n".to_owned()
        }
        ErrorKind::UnknownArgument if wrong.parse::<f64>().is_ok() => {
            format!("\n\nAn instant is written --at {wrong}\n")
        }
        ErrorKind::UnknownArgument if letters => "\n\nOptions have two dashes: --at 0.5\n".to_owned(),
        ErrorKind::UnknownArgument if wrong.starts_with("--") => options_there_are(wrong, command, subcommand),
        _ => "\n".to_owned(),
    }
}

/// Suggests the option of the command that was called that is nearest to an unknown one; clap's suggestion may be far from
/// it, and may be one where another command has the option itself.
fn suggest_option(error: &mut clap::Error, command: &clap::Command, subcommand: Option<&str>) {
    let Some(ContextValue::String(wrong)) = error.get(ContextKind::InvalidArg).cloned() else { return };
    if error.kind() != ErrorKind::UnknownArgument || !wrong.starts_with("--") {
        return;
    }
    error.remove(ContextKind::SuggestedArg);
    error.remove(ContextKind::Usage);
    let options = options_of(command, subcommand);
    let options: Vec<&str> = options.iter().map(String::as_str).collect();
    if let Some(near) = names::nearest(&wrong, &options) {
        error.insert(ContextKind::SuggestedArg, ContextValue::String(near.to_owned()));
    }
}

/// The options of the command that was called.
fn options_of(command: &clap::Command, subcommand: Option<&str>) -> Vec<String> {
    let found = subcommand.and_then(|subcommand| command.find_subcommand(subcommand));
    let names =
        found.unwrap_or(command).get_arguments().filter(|arg| !arg.is_hide_set()).filter_map(clap::Arg::get_long);
    names.filter(|long| *long != "help").map(|long| format!("--{long}")).collect()
}

/// The commands that have the unknown option `wrong`, and the options of the command that was called.
fn options_there_are(wrong: &str, command: &clap::Command, subcommand: Option<&str>) -> String {
    let name = wrong.trim_start_matches('-').split('=').next().unwrap_or_default();
    let has = |command: &clap::Command| command.get_arguments().any(|arg| arg.get_long() == Some(name));
    let other_commands: Vec<String> =
        command.get_subcommands().filter(|c| has(c)).map(|c| format!("`{}`", c.get_name())).collect();
    let found = subcommand.and_then(|subcommand| command.find_subcommand(subcommand));
    let options = options_of(command, subcommand);
    let options: Vec<&str> = options.iter().map(String::as_str).collect();
    let owner = found.map_or_else(|| "the report".to_owned(), |command| format!("`{}`", command.get_name()));
    let elsewhere = match other_commands.is_empty() {
        true => String::new(),
        false => format!("--{name} is an option of {}\n", output::either(&other_commands).replace(" or ", " and ")),
    };
    format!("\n\n{elsewhere}{}\n", names::listing(&format!("{owner} has "), &options))
}

/// The program's name as it was called.
fn program(engine: &dyn Engine, args: &[OsString]) -> String {
    let path = args.first().map(Path::new);
    let name = path.and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
    name.unwrap_or_else(|| engine.model().name.to_owned())
}

/// Writes `--at -0.5` as `--at=-0.5`, so that a minus sign starts a value and two start the next option.
fn with_negative_values(args: Vec<OsString>) -> Vec<OsString> {
    let text = |arg: &OsString| arg.to_str().unwrap_or_default().to_owned();
    let mut out: Vec<OsString> = Vec::with_capacity(args.len());
    for arg in args {
        let takes_value = out.last().map(text).is_some_and(|before| before.starts_with("--") && !before.contains('='));
        let argument = text(&arg);
        let negative = argument.len() > 1 && argument.starts_with('-') && !argument.starts_with("--");
        match out.last_mut() {
            Some(before) if takes_value && negative && !matches!(argument.as_str(), "-h" | "-V") => {
                before.push("=");
                before.push(arg);
            }
            _ => out.push(arg),
        }
    }
    out
}
