//! Where an analysis starts and what is prescribed, as the options of the command line specify it.

use super::failure::Failure;
use super::names::listing;
use crate::analysis::forces::Sharing;
use crate::model::Model;
use crate::planned::Sign;
use crate::signal::Signal;
use crate::solver::Settings;
use std::borrow::Cow;

/// Where the analysis starts and what is prescribed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Setup {
    /// Coordinates and the values at which assembly starts.
    pub(super) guesses: Vec<(usize, f64)>,
    /// Prescribed coordinates.
    pub(super) given: Vec<(usize, Signal)>,
    /// All inputs, at the first instant.
    pub(super) inputs: Vec<Signal>,
    /// The time at which prescribed coordinates and inputs have these values, if it is not the first instant.
    pub(super) since: Option<f64>,
    /// The requested signs of modes, by their indices.
    pub(super) modes: Vec<(usize, Sign)>,
    /// The requested closure, by its number in the list that the command `modes` prints; counted from 1.
    pub(super) closure: Option<usize>,
    /// Names of inputs without a value.
    pub(super) missing_inputs: Vec<&'static str>,
    /// Whether forces that redundant rows leave undetermined are those of least norm.
    pub(super) least_norm: bool,
}

impl Setup {
    /// An error when an input has no value.
    pub(super) fn complete(&self) -> Result<(), Failure> {
        let Some(first) = self.missing_inputs.first() else { return Ok(()) };
        let missing = listing("inputs without a value: ", &self.missing_inputs);
        Err(Failure::option("--input", format!("{missing}\n  write --input {first}=value,rate,acceleration")))
    }

    /// An error if a closure is requested, for commands without a single instant at which closures have numbers.
    pub(super) fn without_closure(self) -> Result<Self, Failure> {
        match self.closure {
            None => Ok(self),
            Some(_) => {
                Err(Failure::option("--mode", "closures have numbers at one instant only; name modes".to_owned()))
            }
        }
    }

    /// The settings of a solver.
    pub(super) fn settings(&self, model: &Model) -> Settings<'static> {
        let mut settings = Settings::default().starting_from(model, &self.guesses, &self.modes);
        self.given.iter().for_each(|&(coordinate, signal)| settings.prescribe(coordinate, signal));
        settings.sharing = if self.least_norm { Sharing::LeastNorm } else { Sharing::Undetermined };
        settings
    }

    /// The setup of an analysis that begins at `t`, with the values that prescribed coordinates and inputs have there.
    pub(super) fn beginning_at(&self, t: f64) -> Cow<'_, Self> {
        let Some(since) = self.since else { return Cow::Borrowed(self) };
        let inputs = self.inputs.iter().map(|input| input.after(t - since)).collect();
        Cow::Owned(Self { inputs, since: None, ..self.after(t - since) })
    }

    /// The same with prescribed coordinates as they are after some time.
    pub(super) fn after(&self, elapsed: f64) -> Self {
        let given = self.given.iter().map(|&(coordinate, signal)| (coordinate, signal.after(elapsed))).collect();
        Self { given, ..self.clone() }
    }

    /// The inputs as functions of time; they have their values at `first` and constant acceleration.
    pub(super) fn inputs_from(&self, first: f64) -> impl Fn(f64, &mut [Signal]) {
        move |t, out| {
            for (to, u) in out.iter_mut().zip(&self.inputs) {
                *to = u.after(t - first);
            }
        }
    }
}
