//! The comparisons of closed forms with dual numbers, and of the plan with the equations.

use super::Solver;
use crate::cross_check::{CrossCheck, CrossCheckOptions, cross_check, plan_check};
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
        let (centre, length) = self.check_centre(options)?;
        cross_check(self.mechanism, options, &centre, length, self.settings.observer)
    }

    /// Compares the plan with the equations, from the configurations given and from random ones around the guess, and
    /// with full Newton from those given. Parameters are not varied.
    ///
    /// # Errors
    /// [`Plan`](SolveError::Plan) without a plan; as [`state_from`](Self::state_from) for the configurations given.
    pub fn plan_check(&self, options: &CrossCheckOptions) -> Result<CrossCheck, SolveError> {
        let (centre, length) = self.check_centre(options)?;
        let mut system = Evaluator::<_, M>::new(self.mechanism);
        let newton = |at: &Instant<'_>, start: &[f64]| Self::new(self.mechanism).state_from(at, start);
        plan_check(&mut system, options, &centre, length, self.settings.observer, &newton)
    }

    /// The guess as centre of random configurations, and their width in x and y. Checks the configurations of the
    /// caller.
    fn check_centre(&self, options: &CrossCheckOptions) -> Result<(Vec<f64>, f64), SolveError> {
        let guess = self.checked_guess()?;
        let inputs = vec![Signal::default(); M::INPUTS];
        centre(&mut self.equations(&Instant { t: 0.0, inputs: &inputs })?, options, &guess)
    }
}

/// The centre of random configurations and their width in x and y; checks the configurations of the caller.
fn centre(
    equations: &mut Equations<'_>,
    options: &CrossCheckOptions,
    guess: &[Option<f64>],
) -> Result<(Vec<f64>, f64), SolveError> {
    for given in &options.given {
        finite("t", 0, "t", given.t)?;
        equations.check("q", &given.q)?;
        equations.check("q_dot", &given.q_dot)?;
    }
    let centre: Vec<f64> = guess.iter().map(|g| g.unwrap_or(0.0)).collect();
    let length = Scale::around(equations, &centre).length;
    Ok((centre, length))
}
