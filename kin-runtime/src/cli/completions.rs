//! `completions`: scripts with which a shell completes the command line, including the mechanism's own names.

use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap_complete::Shell;

use super::examples::{Help, Names};
use super::failure::Failure;
use super::names::NameKind;
use super::output::{Destination, Form, Target, either, forms};
use super::session::Session;
use crate::model::Model;

/// Completions for a shell, with the names of this mechanism
#[derive(Clone, Debug, clap::Args)]
pub(super) struct CompletionsArgs {
    /// The shell [default: $SHELL]
    #[arg(value_name = "SHELL")]
    shell: Option<Shell>,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let program = names.program.as_str();
        let bash = "completions bash > ~/.local/share/bash-completion/completions/";
        vec![
            Some((format!("{bash}{program}"), "for every new bash")),
            Some((format!("completions zsh > \"${{fpath[1]}}/_{program}\""), "for every new zsh")),
            Some((format!("completions fish > ~/.config/fish/completions/{program}.fish"), "for every new fish")),
        ]
    },
    details: "\
For the current bash only: source <(PROGRAM completions bash). Parameters, coordinates, inputs,
modes, joints and quantities are completed by name. When the mechanism changes, write the file
again.",
};

pub(super) fn run(
    args: &CompletionsArgs,
    command: clap::Command,
    model: &'static Model,
    session: &mut Session<'_>,
) -> Result<(), Failure> {
    let Some(shell) = args.shell.or_else(Shell::from_env) else {
        let names: Vec<String> = Shell::value_variants().iter().map(ToString::to_string).collect();
        return Err(Failure::usage(format!("which shell? write completions {}", either(&names))));
    };
    let program = command.get_bin_name().unwrap_or(model.name).to_owned();
    let mut command = with_names(command, model);
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command, &program, &mut script);
    if shell == Shell::Bash {
        let name = program.replace('-', "__");
        script.extend_from_slice(no_space(&name, &program).as_bytes());
    }
    session.deliver_bytes(&Destination { form: Form::Text, target: Target::Out, ending: None }, &script)
}

/// bash adds a space after a completed word. After `l1=` a value follows, so that there must be no space.
fn no_space(name: &str, program: &str) -> String {
    format!(
        "\n_{name}_names() {{\n    _{name} \"$@\"\n    \
         if [[ ${{#COMPREPLY[@]}} -gt 0 && ${{COMPREPLY[0]}} == *= ]]; then\n        \
         compopt -o nospace 2>/dev/null\n    fi\n}}\n\
         complete -F _{name}_names -o nosort -o bashdefault -o default {program} 2>/dev/null ||\n    \
         complete -F _{name}_names -o bashdefault -o default {program}\n"
    )
}

/// The commands with possible values of their options, for completion only: a parser would reject `l1=0.1`, since only
/// `l1=` is one of these values.
fn with_names(command: clap::Command, model: &'static Model) -> clap::Command {
    let assigned = |kind: NameKind| kind.names(model).into_iter().map(|name| format!("{name}=")).collect::<Vec<_>>();
    let [parameters, coordinates, inputs] = [NameKind::Parameter, NameKind::Coordinate, NameKind::Input].map(assigned);
    let modes = model.plan.modes.iter().flat_map(|mode| ["+", "-"].map(|sign| format!("{}={sign}", mode.name)));
    let modes: Vec<String> = modes.collect();
    let joints: Vec<String> = model.joints.iter().map(|joint| joint.name.to_owned()).collect();
    let carried = model.points.iter().map(|p| p.name).chain(model.bodies.iter().map(|b| b.name));
    let quantities: Vec<String> = carried
        .map(str::to_owned)
        .chain(crate::measure::Measure::all(model).iter().skip(1).map(|measure| measure.name().to_owned()))
        .collect();
    let values_of = |id: &str| match id {
        "set" | "vary" => Some(&parameters),
        "guess" | "given" => Some(&coordinates),
        "input" => Some(&inputs),
        "mode" => Some(&modes),
        "joints" => Some(&joints),
        "what" => Some(&quantities),
        _ => None,
    };
    let named = |command: clap::Command| {
        let formats: Vec<String> = forms(own_name(&command)).iter().map(|form| form.name().to_owned()).collect();
        command.mut_args(|arg| match values_of(arg.get_id().as_str()) {
            Some(values) if !values.is_empty() => arg.value_parser(possible(values)),
            _ if arg.get_id() == "format" => arg.value_parser(possible(&formats)),
            _ => arg,
        })
    };
    named(command).mut_subcommands(named)
}

/// The name of a command in the table of forms, where the report has the empty name.
fn own_name(command: &clap::Command) -> &str {
    if command.has_subcommands() { "" } else { command.get_name() }
}

fn possible(values: &[String]) -> PossibleValuesParser {
    values.iter().map(PossibleValue::new).collect::<Vec<_>>().into()
}
