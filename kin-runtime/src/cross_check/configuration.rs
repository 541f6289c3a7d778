//! The configurations of a check: those of the caller, and random ones.

use crate::model::{Component, CoordinateKind, Model};
use crate::random::Random;
use crate::text::numbers;
use crate::workspace::{Instant, Signal};
use core::fmt;

/// How a cross-check chooses its configurations.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossCheckOptions {
    /// Number of random configurations.
    pub configurations: usize,
    /// Seed of the random numbers; the same seed gives the same configurations.
    pub seed: u64,
    /// Configurations of the caller, compared before the random ones.
    pub given: Vec<Configuration>,
    /// Also perturb the parameters, by up to ten per cent.
    pub perturb_parameters: bool,
}

impl Default for CrossCheckOptions {
    fn default() -> Self {
        Self { configurations: 32, seed: 0x6b69_6e00, given: Vec::new(), perturb_parameters: true }
    }
}

/// A configuration to compare at; it need not be assembled.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Time.
    pub t: f64,
    /// q, n numbers.
    pub q: Vec<f64>,
    /// q̇, n numbers.
    pub q_dot: Vec<f64>,
    /// The inputs; empty where the mechanism has none.
    pub inputs: Vec<Signal>,
}

/// A configuration near the centre, or a wide one, by turns.
pub(super) fn random_configuration(
    model: &Model,
    random: &mut Random,
    number: usize,
    centre: &[f64],
    length: f64,
) -> Configuration {
    let width = if number % 4 < 2 { 0.2 } else { 2.0 };
    let mut draw = |k: usize| {
        let unit = match model.coordinates[k].kind {
            CoordinateKind::Pose { component: Component::X | Component::Y, .. } => length,
            _ => 1.0,
        };
        unit * random.symmetric()
    };
    let q = centre.iter().enumerate().map(|(k, c)| c + width * draw(k)).collect();
    let q_dot = (0..centre.len()).map(|k| 2.0 * draw(k)).collect();
    let mut signal = || random.symmetric();
    let inputs = model.inputs.iter().map(|_| Signal { value: signal(), rate: signal(), acceleration: signal() });
    let inputs = inputs.collect();
    Configuration { t: signal(), q, q_dot, inputs }
}

/// t, q, q̇ and the inputs.
impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, q = ", Instant { t: self.t, inputs: &self.inputs })?;
        numbers(f, &self.q)?;
        f.write_str(", q̇ = ")?;
        numbers(f, &self.q_dot)
    }
}

/// How many configurations, from where.
impl fmt::Display for CrossCheckOptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} given and {} random configurations, seed {}", self.given.len(), self.configurations, self.seed)?;
        f.write_str(if self.perturb_parameters { ", parameters perturbed" } else { "" })
    }
}
