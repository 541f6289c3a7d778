//! The help: clap's, with examples and names of the mechanism.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::names::{NameKind, listing};
use super::output::{either, forms};
use super::trial::ExampleValues;
use super::{
    animate, check, completions, extremes, forces, info, limits, modes, paint, report, sensitivities, solve, sweep,
};
use crate::model::Model;

/// The command line of a mechanism, made from the options that all mechanisms have.
pub(super) fn command(
    options: clap::Command,
    engine: &dyn Engine,
    program: String,
    trial: Option<ExampleValues>,
) -> clap::Command {
    let model = engine.model();
    let names = Names::new(program.clone(), engine, trial);
    let with = |command: clap::Command, name: &str, help: &Help| {
        let command = with_defaults(command, name);
        let examples = (help.examples)(&names);
        let few = names.render(&examples.iter().flatten().take(3).cloned().map(Some).collect::<Vec<_>>());
        let all = names.render(&examples);
        let listed = listed(model, &command);
        command.after_help(few).after_long_help(format!("{all}\n{}{listed}", help.details))
    };
    let mut command = options
        .name(model.name)
        .bin_name(program)
        .about(if model.doc.is_empty() { "A planar mechanism" } else { model.doc })
        .version(concat!("(kin ", env!("CARGO_PKG_VERSION"), ")"));
    for (name, help) in COMMANDS {
        command = command.mut_subcommand(name, |command| with(command, name, help));
    }
    if engine.model().forces.is_none() {
        command = command.mut_subcommand("forces", |command| command.hide(true));
    }
    with(command, "", &report::HELP)
}

const COMMANDS: &[(&str, Help)] = &[
    ("info", info::HELP),
    ("solve", solve::HELP),
    ("sweep", sweep::HELP),
    ("extremes", extremes::HELP),
    ("forces", forces::HELP),
    ("sensitivities", sensitivities::HELP),
    #[cfg(feature = "design")]
    ("design", super::design::HELP),
    ("modes", modes::HELP),
    ("limits", limits::HELP),
    ("check", check::HELP),
    #[cfg(feature = "equations")]
    ("equations", super::equations::HELP),
    ("animate", animate::HELP),
    #[cfg(feature = "plot")]
    ("plot", super::plot::HELP),
    ("completions", completions::HELP),
];

/// The default end of a motion, as the help describes it.
const END: &str = " [default: one driven turn, or 1, or as far as it goes]";

/// Fills in what the shared options mean for this command: its forms and the default instants.
fn with_defaults(command: clap::Command, name: &str) -> clap::Command {
    let forms = forms(name);
    let Some(first) = forms.first() else { return command };
    let named: Vec<&str> = forms.iter().map(|form| form.name()).collect();
    let endings: Vec<String> = forms.iter().map(|form| format!(".{}", form.endings()[0])).collect();
    let short = format!("{} [default: by the ending of --out, or {}]", either(&named), first.name());
    let long = format!(
        "{}.\nThe default is the ending of --out: {}; without a file it is {}.\n--format wins over a different ending",
        either(&named),
        either(&endings),
        first.name(),
    );
    let command = command.mut_arg("format", |arg| arg.help(short).long_help(long));
    let (steps, end) = match name {
        // One instant, or those of a motion.
        "sensitivities" => {
            return command.mut_arg("at", |arg| arg.conflicts_with_all(["from", "to", "steps", "times"]));
        }
        // All modes are listed, and the option is refused.
        "modes" | "limits" => return command.mut_arg("mode", |arg| arg.hide(true)),
        "sweep" => (sweep::STEPS, END),
        "extremes" => (extremes::STEPS, END),
        "animate" => (animate::STEPS, END),
        #[cfg(feature = "plot")]
        "plot" => (super::plot::STEPS, END),
        _ => return command,
    };
    command
        .mut_arg("to", |arg| {
            let long =
                format!("The last instant. `limit` is the limit that the mechanism reaches.\n{}", end.trim_start());
            arg.help(format!("The last instant{end}")).long_help(long)
        })
        .mut_arg("steps", |arg| arg.help(format!("Number of steps; N steps are N + 1 instants [default: {steps}]")))
}

/// Lists the names that the options of a command accept.
fn listed(model: &Model, command: &clap::Command) -> String {
    if !command.get_arguments().any(|arg| arg.get_id() == "set") {
        return String::new();
    }
    let kinds = [
        ("Parameters:  ", NameKind::Parameter),
        ("Coordinates: ", NameKind::Coordinate),
        ("Inputs:      ", NameKind::Input),
        ("Modes:       ", NameKind::Mode),
    ];
    let kinds = kinds.map(|(lead, kind)| (lead, kind.names(model)));
    let lines = kinds.into_iter().filter(|(_, names)| !names.is_empty()).map(|(lead, names)| {
        let text = listing(lead, &names);
        let (head, rest) = text.split_at(lead.trim_end().len());
        format!("\n{}{rest}", paint::heading(head))
    });
    format!("\n{}", lines.collect::<String>())
}
