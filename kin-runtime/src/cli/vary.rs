//! `--vary`: one motion for every combination of the values of some parameters.

use super::engine::Engine;
use super::failure::{Failure, Ledger};
use super::names::{NameKind, find};
use super::values;
use crate::model::Model;
use crate::present::number::rounded;

/// Which parameters vary.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct VaryArgs {
    /// A motion for each value: NAME=0.08..0.12:5 or NAME=0.08,0.1
    #[arg(
        long,
        value_name = "NAME=VALUES",
        long_help = "\
A motion for each of several values of a parameter: NAME=0.08..0.12:5, which
are five values including both ends, or NAME=0.08,0.1. They take the place of a
value that --set gives it. If it is repeated, there is a motion for every
combination of values"
    )]
    vary: Vec<String>,
}

/// One combination of values: parameters by their indices.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Choice(Vec<(usize, f64)>);

impl VaryArgs {
    /// Every combination of values; a single empty one if nothing varies. More than `most` are an error, which gives
    /// `why` as the reason.
    pub(super) fn choices(&self, model: &Model, (most, why): (usize, &str)) -> Result<Vec<Choice>, Failure> {
        let mut ledger = Ledger::default();
        let mut choices = vec![Choice::default()];
        for text in &self.vary {
            let varied = values::variation("--vary", text, model, (most, why));
            let Some((name, values)) = ledger.take(varied) else { continue };
            let found = find(model, "--vary", NameKind::Parameter, &name);
            let Some(place) = ledger.take(found) else { continue };
            if choices[0].0.iter().any(|&(varied, _)| varied == place) {
                ledger.fault("--vary", format!("`{name}` is varied twice"));
                continue;
            }
            if choices.len() * values.len() > most {
                ledger.fault("--vary", format!("more than {most} combinations of values; {why}"));
                break;
            }
            let with = |Choice(choice): &Choice| -> Vec<Choice> {
                values.iter().map(|&value| Choice(choice.iter().copied().chain([(place, value)]).collect())).collect()
            };
            choices = choices.iter().flat_map(with).collect();
        }
        ledger.close(Some(choices))
    }
}

impl Choice {
    /// Gives the parameters these values.
    pub(super) fn set(&self, engine: &mut dyn Engine) {
        for &(index, value) in &self.0 {
            engine.set_parameter(index, value);
        }
    }

    /// `l1 = 0.1, l2 = 0.4`; empty if nothing varies.
    pub(super) fn name(&self, model: &Model) -> String {
        let one = |(name, value): (&str, f64)| format!("{name} = {}", rounded(value));
        self.pairs(model).map(one).collect::<Vec<_>>().join(", ")
    }

    /// The parameters with their values.
    pub(super) fn pairs(&self, model: &Model) -> impl Iterator<Item = (&'static str, f64)> {
        let parameters = model.parameters;
        self.0.iter().map(move |&(index, value)| (parameters[index].name, value))
    }
}
