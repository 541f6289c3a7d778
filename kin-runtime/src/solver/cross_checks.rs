//! The comparisons of closed forms with dual numbers, and of the plan with the equations.

use super::Solver;
use crate::analysis::fit::fit_inputs;
use crate::cross_check::{Centre, CrossCheck, CrossCheckOptions, cross_check, plan_check};
use crate::equations::scale::Scale;
use crate::equations::system::Evaluator;
use crate::equations::{Equations, finite};
use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::signal::{Instant, Signal};

impl<M: Mechanism> Solver<'_, M> {
    /// Compares every entry of Φ_q, Φ_t and γ with dual numbers, at the configurations given and at random ones around
    /// the guess.
    ///
    /// # Errors
    /// [`NothingCompared`](SolveError::NothingCompared) where Φ is not finite at any of them;
    /// [`NonFinite`](SolveError::NonFinite) and [`Length`](SolveError::Length).
    pub fn cross_check(&self, options: &CrossCheckOptions) -> Result<CrossCheck, SolveError> {
        let centre = self.check_centre(options)?;
        cross_check(self.mechanism, options, &centre, self.settings.observer)
    }

    /// Compares the plan with the equations, from the configurations given and from random ones around the guess, and
    /// with full Newton from those given. Parameters are not varied.
    ///
    /// # Errors
    /// [`Plan`](SolveError::Plan) without a plan; as [`state_from`](Self::state_from) for the configurations given.
    pub fn plan_check(&self, options: &CrossCheckOptions) -> Result<CrossCheck, SolveError> {
        let centre = self.check_centre(options)?;
        let mut system = Evaluator::<_, M>::new(self.mechanism);
        let newton = |at: &Instant<'_>, start: &[f64]| Self::new(self.mechanism).state_from(at, start);
        plan_check(&mut system, options, &centre, self.settings.observer, &newton)
    }

    /// The guess, and inputs that fit it, as centre of random configurations. Checks the configurations of the caller.
    fn check_centre(&self, options: &CrossCheckOptions) -> Result<Centre, SolveError> {
        let guess = self.checked_guess()?;
        let inputs = vec![Signal::default(); M::INPUTS];
        centre(&mut self.equations(&Instant { t: 0.0, inputs: &inputs })?, options, &guess)
    }
}

/// The centre of random configurations; checks the configurations of the caller. Inputs are those of the first given
/// configuration, or else their defaults. Those without either have values with which the mechanism closes near its
/// guess, or 0 if none are found.
fn centre(
    equations: &mut Equations<'_>,
    options: &CrossCheckOptions,
    guess: &[Option<f64>],
) -> Result<Centre, SolveError> {
    for given in &options.given {
        finite("t", 0, "t", given.t)?;
        equations.check("q", &given.q)?;
        equations.check("q_dot", &given.q_dot)?;
    }
    let q: Vec<f64> = guess.iter().map(|g| g.unwrap_or(0.0)).collect();
    equations.check("guess", &q)?;
    let length = Scale::around(equations, &q).length;
    let model = equations.model;
    let given = options.given.first().map_or(&[][..], |first| &first.inputs);
    let known = |k: usize| given.get(k).map(|u| u.value).or_else(|| model.input_defaults.get(k).copied().flatten());
    let known: Vec<Option<f64>> = (0..model.inputs.len()).map(known).collect();
    let mut inputs: Vec<f64> = known.iter().map(|value| value.unwrap_or(0.0)).collect();
    let unknown: Vec<usize> = (0..inputs.len()).filter(|&k| known[k].is_none()).collect();
    let at: Vec<Signal> = inputs.iter().map(|&value| Signal::constant(value)).collect();
    if !unknown.is_empty()
        && equations.set_instant(&Instant { t: 0.0, inputs: &at }).is_ok()
        && fit_inputs(equations, guess, &unknown).unwrap_or(false)
    {
        unknown.iter().for_each(|&k| inputs[k] = equations.inputs[k].value);
    }
    Ok(Centre { q, inputs, length })
}
