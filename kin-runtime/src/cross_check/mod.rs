//! Comparison of the closed forms of Φ_q, Φ_t and γ with derivatives by dual numbers.
//!
//! Only the generic Φ is differentiated: Φ_q column by column and Φ_t with first-order dual numbers, γ as the negative
//! second derivative of s ↦ Φ(q + s q̇, t + s) at 0 with second-order ones. Inputs change with their rates and
//! accelerations. Entries that are zero by the sparsity pattern are compared as well.
//!
//! Both sides use supplied functions in the same way. Their derivatives are therefore compared with difference
//! quotients, at the arguments at which they are evaluated in these configurations. Rows of velocity level are compared
//! in the same places: B, b and γ with derivatives of the generic η.

mod automatic;
mod checked;
mod comparison;
mod configuration;
mod functions;
mod plan;
mod result;

use crate::error::SolveError;
use crate::observer::{Observed, Observer};
use crate::random::Random;
pub(crate) use checked::Checked;
use comparison::Comparison;
pub(crate) use configuration::Centre;
use configuration::random_configuration;
pub use configuration::{Configuration, CrossCheckOptions};
pub use functions::FunctionCheck;
pub(crate) use plan::plan_check;
pub use result::{CrossCheck, WorstEntry};

/// Largest relative perturbation of a parameter.
const PERTURBATION: f64 = 0.1;

/// Compares the closed forms of `mechanism` at the configurations that `options` describe.
///
/// Random configurations are drawn around `centre`.
pub(crate) fn cross_check(
    mechanism: &dyn Checked,
    options: &CrossCheckOptions,
    centre: &Centre,
    observer: Option<Observer<'_>>,
) -> Result<CrossCheck, SolveError> {
    let mut observed = Observed::new(observer, options.given.len() + options.configurations);
    let mut random = Random::new(options.seed);
    let (model, exact) = (mechanism.model(), mechanism.own_parameters());
    let mut comparison = Comparison::new(model);
    for configuration in &options.given {
        comparison.compare(mechanism, &exact, configuration)?;
        observed.finish(configuration.t, None)?;
    }
    for number in 0..options.configurations {
        let configuration = random_configuration(model, &mut random, number, centre);
        let mut parameters = exact.clone();
        if options.perturb_parameters && number % 2 == 1 {
            for parameter in &mut parameters {
                *parameter *= 1.0 + PERTURBATION * random.symmetric();
            }
        }
        comparison.compare(mechanism, &parameters, &configuration)?;
        observed.finish(configuration.t, None)?;
    }
    comparison.finish()
}
