//! Options that several commands share, and what they mean for a mechanism.

use super::engine::Engine;
use super::failure::{Failure, Ledger};
use super::names::{NameKind, find};
use super::number::Measured;
use super::setup::Setup;
use super::values::{self, TimeOrAngle};
use crate::model::Model;
use crate::signal::Signal;

/// Parameters, inputs, prescribed coordinates, and where assembly starts.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct SetupArgs {
    /// Set parameters: NAME=0.12,OTHER=200mm or ARRAY[3]=pi/2, or @FILE
    #[arg(
        long,
        value_name = "NAME=VALUE",
        long_help = "\
Set parameters: NAME=0.12,OTHER=200mm or ARRAY[3]=pi/2.
@FILE takes those of a json file with `parameters`, as `design` writes it, and its
assembly modes where `--mode` does not name them"
    )]
    set: Vec<String>,
    /// Where assembly starts; coordinates without a guess are found
    #[arg(
        long,
        value_name = "NAME=VALUE",
        long_help = "\
Where assembly starts, in place of the mechanism's own guess.
Coordinates without a guess are found; where it can close in several ways, guesses decide"
    )]
    guess: Vec<String>,
    /// Prescribe open coordinates: NAME=VALUE[:RATE[:ACCELERATION]]
    #[arg(
        long,
        value_name = "NAME=VALUE",
        long_help = "\
Prescribe coordinates that the drivers leave open:
NAME=VALUE, NAME=VALUE:RATE or NAME=VALUE:RATE:ACCELERATION.
A motion starts with these values and keeps the acceleration"
    )]
    given: Vec<String>,
    /// Inputs of the mechanism: NAME=VALUE[,RATE[,ACCELERATION]]
    #[arg(
        long,
        value_name = "NAME=VALUE",
        long_help = "\
Inputs of the mechanism:
NAME=VALUE, NAME=VALUE,RATE or NAME=VALUE,RATE,ACCELERATION, with commas or colons.
A motion starts with these values and keeps the accelerations"
    )]
    input: Vec<String>,
    /// Assembly modes, which `info` lists: NAME=+ or NAME=-
    #[arg(long, value_name = "NAME=SIGN")]
    mode: Vec<String>,
}

/// The name with which `--mode` requests a closure by its number, in place of a mode by its sign.
const CLOSURE: &str = "closure";

impl SetupArgs {
    /// Sets the parameters and looks up all names; reports all errors at once.
    pub(super) fn apply(&self, engine: &mut dyn Engine) -> Result<Setup, Failure> {
        let model = engine.model();
        let mut ledger = Ledger::default();
        let mut setup = Setup::default();
        let [set, file_modes] = ledger.take(expanded("--set", &self.set)).unwrap_or_default();
        let number =
            |name: &str, value: &str| values::number(&format!("--set {name}"), value, Measured::parameter(model, name));
        for (index, value) in values::of_names(&mut ledger, ("--set", NameKind::Parameter, "0.12"), &set, model, number)
        {
            if !engine.set_parameter(index, value) {
                ledger.fault("--set", format!("`{}` cannot be set", model.parameters[index].name));
            }
        }
        let number = |name: &str, value: &str| {
            values::number(&format!("--guess {name}"), value, Measured::quantity(model, name))
        };
        let guess = ("--guess", NameKind::Coordinate, "0.9");
        setup.guesses = values::of_names(&mut ledger, guess, &self.guess, model, number);
        let signal = |name: &str, value: &str| {
            let parts: Vec<&str> = value.split(':').collect();
            values::signal(&format!("--given {name}"), name, &parts, Measured::quantity(model, name))
        };
        let given = ("--given", NameKind::Coordinate, "0.3");
        setup.given = values::of_names(&mut ledger, given, &self.given, model, signal);
        let example = values::example_of(NameKind::Mode, model, "+");
        let mut mode_signs = ledger.take(values::assignments("--mode", &example, &self.mode)).unwrap_or_default();
        let of_files = ledger.take(values::assignments("--set", &example, &file_modes)).unwrap_or_default();
        let of_files_only = of_files.into_iter().filter(|(name, _)| mode_signs.iter().all(|(other, _)| other != name));
        let of_files_only: Vec<_> = of_files_only.collect();
        let is_number = |name: &str| name == CLOSURE && model.plan.modes.iter().all(|mode| mode.name != CLOSURE);
        // The number of a closure takes the place of all of them.
        if !mode_signs.iter().any(|(name, _)| is_number(name)) {
            mode_signs.extend(of_files_only);
        }
        for (name, sign) in mode_signs {
            if is_number(&name) {
                let number = sign.parse().map_err(|_| {
                    Failure::option("--mode", format!("`{sign}` is no number of a closure; `modes` lists them"))
                });
                setup.closure = ledger.take(number);
                continue;
            }
            let found = match model.plan.absent {
                Some(why) => {
                    Err(Failure::option("--mode", format!("there are no modes, because there is no plan: {why}")))
                }
                None => find(model, "--mode", NameKind::Mode, &name),
            };
            let sign = values::sign(&format!("--mode {name}"), &sign);
            setup.modes.extend(ledger.take(found).zip(ledger.take(sign)));
        }
        let default = |value: &f64| Signal { value: *value, rate: 0.0, acceleration: 0.0 };
        let defaults = model.input_defaults.iter().map(|value| value.as_ref().map(default));
        let mut inputs: Vec<Option<Signal>> =
            defaults.chain(std::iter::repeat(None)).take(model.inputs.len()).collect();
        for (name, signal) in ledger.take(values::inputs("--input", &self.input, model)).unwrap_or_default() {
            let found = ledger.take(find(model, "--input", NameKind::Input, &name));
            if let Some(slot) = found.and_then(|index| inputs.get_mut(index)) {
                *slot = Some(signal);
            }
        }
        let missing = model.inputs.iter().zip(&inputs).filter(|(_, slot)| slot.is_none());
        setup.missing_inputs = missing.map(|(name, _)| *name).collect();
        setup.inputs = inputs.into_iter().map(Option::unwrap_or_default).collect();
        ledger.close(Some(setup))
    }

    /// An error if an assembly mode is chosen, for a command that lists all of them.
    pub(super) fn without_mode(&self, command: &str) -> Result<(), Failure> {
        match self.mode.first() {
            None => Ok(()),
            Some(mode) => Err(Failure::option("--mode", format!("`{command}` lists all modes; leave `{mode}` out"))),
        }
    }

    /// As [`apply`](Self::apply), for a command that needs a value for every input.
    pub(super) fn apply_complete(&self, engine: &mut dyn Engine) -> Result<Setup, Failure> {
        let setup = self.apply(engine)?;
        setup.complete()?;
        Ok(setup)
    }
}

/// The assignments of parameters, with every `@FILE` replaced by those of that file, and the assembly modes of the
/// files.
fn expanded(option: &str, texts: &[String]) -> Result<[Vec<String>; 2], Failure> {
    let (mut ledger, mut all) = (Ledger::default(), <[Vec<String>; 2]>::default());
    for text in texts {
        match text.strip_prefix('@') {
            Some(file) => {
                let found = ledger.take(values::of_file(option, file)).unwrap_or_default();
                all.iter_mut().zip(found).for_each(|(list, found)| list.extend(found));
            }
            None => all[0].push(text.clone()),
        }
    }
    ledger.close(Some(all))
}

/// What to do about degrees of freedom that the drivers leave open.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(super) struct FreedomArgs {
    /// Where drivers leave the motion open, take the smallest q̇ and q̈
    #[arg(long)]
    pub(super) least_norm: bool,
}

/// The unit of angles in the result.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(super) struct AngleArgs {
    /// Angles of the result in degrees; values of options stay in rad
    #[arg(long)]
    pub(super) degrees: bool,
}

/// An instant.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct InstantArgs {
    /// The time t, or an angle of the driven crank: 20ms, 60deg
    #[arg(long, value_name = "T", default_value = "0")]
    at: String,
}

impl InstantArgs {
    pub(super) fn time(&self, model: &Model) -> Result<TimeOrAngle, Failure> {
        values::moment("--at", &self.at, model)
    }
}
