//! Closed forms held against dual numbers.
//!
//! The generic Φ alone is differentiated: Φ_q column by column and Φ_t with first-order dual numbers, γ as the negative
//! second derivative of s ↦ Φ(q + s q̇, t + s) at 0 with second-order ones. Inputs move with their rates and
//! accelerations. Entries that the sparsity pattern calls zero are compared as well.
//!
//! Supplied functions enter both sides as they are, so that their derivatives are held against their own differences, at
//! the arguments at which they are evaluated in these configurations.
//! Rows of velocity level are compared in the same places: B, b and γ against derivatives of the generic η.

mod automatic;
mod comparison;
mod functions;
mod plan;

use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::model::{Component, CoordinateKind, Model};
use crate::observer::{Observed, Observer};
use crate::random::Random;
use crate::text::numbers;
use crate::workspace::Instant;
use crate::workspace::Signal;
use comparison::Comparison;
use core::fmt;
pub use functions::FunctionCheck;
pub(crate) use plan::plan_check;
pub use plan::{PlanCheck, WorstPlanned};

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

/// The entry with the largest error.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WorstEntry {
    /// `Φ_q`, `Φ_t` or `γ`.
    pub matrix: &'static str,
    /// Row.
    pub row_name: &'static str,
    /// Column of Φ_q; empty for Φ_t and γ.
    pub column_name: &'static str,
    /// The closed form's value.
    pub closed_form: f64,
    /// The dual numbers' value.
    pub automatic: f64,
    /// The error, see [`CrossCheck::max_error`].
    pub error: f64,
    /// q of that configuration.
    pub q: Vec<f64>,
    /// q̇ of that configuration.
    pub q_dot: Vec<f64>,
    /// Time of that configuration.
    pub t: f64,
}

/// Result of a cross-check.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CrossCheck {
    /// Configurations compared.
    pub configurations: usize,
    /// Configurations skipped because Φ itself is not finite there.
    pub skipped: usize,
    /// Numbers compared.
    pub entries: usize,
    /// The entry with the largest error; without names where a mechanism has no rows.
    pub worst: WorstEntry,
    /// Largest error over all entries: |closed form − automatic|, relative to the largest entry of that row of Φ_q,
    /// to Φ_t, or to γ (or that row of Φ_q times the largest q̇ squared, if larger), but to no less than one. Whatever
    /// is not a number has an infinite error.
    pub max_error: f64,
    /// Every supplied function that is evaluated: f, f′ and f″ against one another, by differences.
    pub functions: Vec<FunctionCheck>,
}

impl CrossCheck {
    /// True when no error exceeds `tolerance`, and no supplied function differs from its own differences by more than
    /// these can tell ([`FunctionCheck::TOLERANCE`], or `tolerance` if that is larger).
    pub fn passes(&self, tolerance: f64) -> bool {
        let of_functions = tolerance.max(FunctionCheck::TOLERANCE);
        self.max_error <= tolerance && self.functions.iter().all(|function| function.error <= of_functions)
    }

    /// The supplied function with the largest error.
    pub fn worst_function(&self) -> Option<&FunctionCheck> {
        self.functions.iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }
}

impl fmt::Display for CrossCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} entries at {} configurations", self.entries, self.configurations)?;
        if self.skipped > 0 {
            write!(f, " ({} skipped)", self.skipped)?;
        }
        write!(f, ": worst {}", self.worst)?;
        match self.worst_function() {
            Some(function) => write!(f, "; function {function}"),
            None => Ok(()),
        }
    }
}

/// Largest perturbation of a parameter, relative.
const PERTURBATION: f64 = 0.1;

/// Compares the closed forms of `mechanism` at the configurations that `options` ask for.
///
/// `centre` is the configuration around which random ones are drawn, `length` the width of x and y.
pub(crate) fn cross_check<M: Mechanism>(
    mechanism: &M,
    options: &CrossCheckOptions,
    centre: &[f64],
    length: f64,
    observer: Option<Observer<'_>>,
) -> Result<CrossCheck, SolveError> {
    let mut observed = Observed::new(observer, options.given.len() + options.configurations);
    let mut random = Random::new(options.seed);
    let exact = mechanism.parameters::<f64>();
    let mut comparison = Comparison::new(M::model());
    for configuration in &options.given {
        comparison.compare(mechanism, exact.as_ref(), configuration)?;
        observed.finish(configuration.t, None)?;
    }
    for number in 0..options.configurations {
        let configuration = random_configuration(M::model(), &mut random, number, centre, length);
        let mut parameters = exact;
        if options.perturb_parameters && number % 2 == 1 {
            for parameter in parameters.as_mut() {
                *parameter *= 1.0 + PERTURBATION * random.symmetric();
            }
        }
        comparison.compare(mechanism, parameters.as_ref(), &configuration)?;
        observed.finish(configuration.t, None)?;
    }
    comparison.finish()
}

/// A configuration near the centre, or a wide one, by turns.
fn random_configuration(
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

/// `error 4.1e-17 in γ[B.x] at t = 0: closed form …, automatic …`.
impl fmt::Display for WorstEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error {:.1e} in {}[{}", self.error, self.matrix, self.row_name)?;
        if !self.column_name.is_empty() {
            write!(f, ", {}", self.column_name)?;
        }
        write!(f, "] at t = {}: closed form {}, automatic {}", self.t, self.closed_form, self.automatic)
    }
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
