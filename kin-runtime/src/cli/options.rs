//! Options that several commands share, and what they mean for a mechanism.

use std::path::{Path, PathBuf};

use super::engine::{Engine, Setup};
use super::failure::Failure;
use super::names::{Kind, find};
use super::values;

/// Which mechanism, and where it starts.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct SetupArgs {
    /// Set parameters: l1=0.12,l2=0.4 or l[3]=0.1
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Where assembly starts: coupler.phi=0.9,rocker.phi=5
    #[arg(long, value_name = "NAME=VALUE")]
    guess: Vec<String>,
    /// Prescribe coordinates: crank.phi=0.3 or crank.phi=0.3:rate:acceleration
    #[arg(long, value_name = "NAME=VALUE")]
    given: Vec<String>,
    /// Inputs of the mechanism: u=value,rate,acceleration
    #[arg(long, value_name = "NAME=VALUE")]
    input: Vec<String>,
    /// Assembly modes, `info` lists them: A-B-D=+ or A-B-D=-
    #[arg(long, value_name = "NAME=SIGN")]
    mode: Vec<String>,
}

impl SetupArgs {
    /// Sets the parameters and looks up all names.
    pub(super) fn apply(&self, engine: &mut dyn Engine) -> Result<Setup, Failure> {
        let model = engine.model();
        let parameters: Vec<&str> = model.parameters.iter().map(|p| p.name).collect();
        for (name, value) in values::assignments("--set", "l1=0.12,l2=0.4", &self.set)? {
            let place = find("--set", Kind::Parameter, &name, &parameters)?;
            let value = values::number(&format!("--set {name}"), &value)?;
            if !engine.set_parameter(place, value) {
                return Err(Failure::option("--set", format!("`{name}` cannot be set")));
            }
        }
        let coordinates: Vec<&str> = model.coordinates.iter().map(|c| c.name).collect();
        let mut setup = Setup::default();
        for (name, value) in values::assignments("--guess", "coupler.phi=0.9", &self.guess)? {
            let place = find("--guess", Kind::Coordinate, &name, &coordinates)?;
            setup.guesses.push((place, values::number(&format!("--guess {name}"), &value)?));
        }
        for (name, value) in values::assignments("--given", "crank.phi=0.3", &self.given)? {
            let place = find("--given", Kind::Coordinate, &name, &coordinates)?;
            let parts: Vec<&str> = value.split(':').collect();
            setup.given.push((place, values::signal(&format!("--given {name}"), &name, &parts)?));
        }
        let modes: Vec<&str> = model.plan.modes.iter().map(|mode| mode.name).collect();
        for (name, sign) in values::assignments("--mode", "A-B-D=+", &self.mode)? {
            if let Some(why) = model.plan.absent {
                return Err(Failure::option("--mode", format!("there are no modes, because there is no plan: {why}")));
            }
            let place = find("--mode", Kind::Mode, &name, &modes)?;
            setup.modes.push((place, values::sign(&format!("--mode {name}"), &sign)?));
        }
        let mut inputs = vec![None; model.inputs.len()];
        for (name, signal) in values::inputs("--input", &self.input)? {
            let place = find("--input", Kind::Input, &name, model.inputs)?;
            if let Some(slot) = inputs.get_mut(place) {
                *slot = Some(signal);
            }
        }
        let missing = model.inputs.iter().zip(&inputs).filter(|(_, slot)| slot.is_none());
        setup.missing_inputs = missing.map(|(name, _)| *name).collect();
        setup.inputs = inputs.into_iter().map(Option::unwrap_or_default).collect();
        Ok(setup)
    }

    /// As [`apply`](Self::apply), for a command that needs a value for every input.
    pub(super) fn apply_complete(&self, engine: &mut dyn Engine) -> Result<Setup, Failure> {
        let setup = self.apply(engine)?;
        setup.complete()?;
        Ok(setup)
    }
}

/// What to do about freedom that the drivers leave.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(super) struct FreedomArgs {
    /// Where drivers leave the motion open, take the smallest q̇ and q̈
    #[arg(long)]
    pub(super) least_norm: bool,
}

/// An instant.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct InstantArgs {
    /// The time t
    #[arg(long, value_name = "T", default_value = "0")]
    at: String,
}

impl InstantArgs {
    pub(super) fn time(&self) -> Result<f64, Failure> {
        values::number("--at", &self.at)
    }
}

/// How results are written: for people, or with numbers in full for other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Format {
    Text,
    Json,
    Csv,
}

/// How results are written, and where to.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct OutputArgs {
    /// text, json or csv [default: text, or what the ending of --out says]
    #[arg(long, value_name = "FORMAT", value_enum, hide_possible_values = true)]
    format: Option<Format>,
    /// Write the result to a file, whole or not at all
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl OutputArgs {
    pub(super) fn format(&self) -> Format {
        let by_ending = || match self.out.as_deref().and_then(Path::extension).and_then(|e| e.to_str()) {
            Some("json") => Format::Json,
            Some("csv") => Format::Csv,
            _ => Format::Text,
        };
        self.format.unwrap_or_else(by_ending)
    }

    /// The file; none for stdout.
    pub(super) fn file(&self) -> Option<&Path> {
        self.out.as_deref().filter(|path| *path != Path::new("-"))
    }
}
