//! Closed forms compared with dual numbers.
//!
//! The generic Φ alone is differentiated: Φ_q column by column and Φ_t with first-order dual numbers, γ as the negative
//! second derivative of s ↦ Φ(q + s q̇, t + s) at 0 with second-order ones. Inputs move with their rates and
//! accelerations. Entries that the sparsity pattern calls zero are compared as well.
//!
//! Supplied functions enter both sides as they are, so that their derivatives are compared with their own differences, at
//! the arguments at which they are evaluated in these configurations.
//! Rows of velocity level are compared in the same places: B, b and γ against derivatives of the generic η.

mod automatic;
mod comparison;
mod configuration;
mod functions;
mod plan;
mod result;

use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::observer::{Observed, Observer};
use crate::random::Random;
use comparison::Comparison;
use configuration::random_configuration;
pub use configuration::{Configuration, CrossCheckOptions};
pub use functions::FunctionCheck;
pub(crate) use plan::plan_check;
pub use result::{CrossCheck, WorstEntry};

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
