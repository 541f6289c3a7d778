//! The ranges of inputs in which the mechanism closes.

use super::{AnySolver, Solver};
use crate::analysis::fit::fit_inputs;
use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::model::Input;
use crate::planned::{InputRange, OutOfRange};
use crate::signal::{Instant, Signal};

impl<M: Mechanism> Solver<'_, M> {
    /// The range of an input in which the mechanism closes, with time and the other inputs constant, at an instant at
    /// which it closes: see [`Planned::range_of`](crate::Planned::range_of).
    ///
    /// # Errors
    /// As [`planned`](Self::planned), and [`Plan`](SolveError::Plan) with the handle of another mechanism.
    pub fn range_of(&self, at: &Instant<'_>, input: Input) -> Result<InputRange, SolveError> {
        Ok(self.planned(at)?.range_of(input)?)
    }

    /// The input because of which the mechanism does not close at an instant, with the range in which it closes if the
    /// others are constant. If several inputs could be the cause, it is the one that is farthest from the value that
    /// fits the guess. If no value of one input alone closes the mechanism, the other inputs are set to the values that
    /// fit the guess, and the search is repeated. `None` if the mechanism closes, if no single input is the cause, and
    /// without a plan.
    pub fn out_of_range(&self, at: &Instant<'_>) -> Option<OutOfRange> {
        let guess = self.checked_guess().ok()?;
        let fitted = |indices: &[usize], values: &[Signal]| fitted(self, at.t, &guess, (indices, values));
        let range_of = |inputs: &[Signal], input: Input| self.range_of(&Instant { t: at.t, inputs }, input).ok();
        out_of_range(at.inputs, M::INPUTS, &fitted, &range_of)
    }
}

/// Inputs that fit the guess, of which those with the given indices may vary.
fn fitted(
    solver: &dyn AnySolver,
    t: f64,
    guess: &[Option<f64>],
    (indices, values): (&[usize], &[Signal]),
) -> Option<Vec<Signal>> {
    let mut equations = solver.equations_at(&Instant { t, inputs: values }).ok()?;
    let fits = fit_inputs(&mut equations, guess, indices).ok()?;
    fits.then_some(equations.inputs)
}

/// Inputs that fit the guess, of which those with the given indices may vary.
type Fitted<'f> = dyn Fn(&[usize], &[Signal]) -> Option<Vec<Signal>> + 'f;

/// The range of an input, with the other inputs constant.
type RangeOf<'f> = dyn Fn(&[Signal], Input) -> Option<InputRange> + 'f;

/// The input because of which a mechanism does not close.
fn out_of_range(inputs: &[Signal], count: usize, fitted: &Fitted<'_>, range_of: &RangeOf<'_>) -> Option<OutOfRange> {
    let mut all: Vec<usize> = (0..count).collect();
    let at_guess = fitted(&all, inputs);
    // Where several inputs could each be the cause, it is the one that is farthest from what fits the guess.
    let departure = |k: usize| {
        let fit = at_guess.as_ref()?.get(k)?.value;
        Some((inputs.get(k)?.value - fit).abs() / fit.abs().max(f64::MIN_POSITIVE))
    };
    all.sort_by(|&a, &b| departure(b).unwrap_or(0.0).total_cmp(&departure(a).unwrap_or(0.0)));
    let first = |inputs_held: &[Signal]| {
        all.iter().find_map(|&k| {
            let requested = inputs.get(k)?.value;
            let range = range_of(&fitted(&[k], inputs_held)?, Input(k))?;
            (!range.contains(requested)).then_some(OutOfRange { value: requested, range })
        })
    };
    first(inputs).or_else(|| first(at_guess.as_ref()?))
}
