//! The search for the limit of an input in one direction.

use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::planned::error::PlanError;
use crate::planned::follower::{Control, PlanFollower};
use crate::planned::group_limit::Limit;
use crate::planned::substeps::natural_step;
use crate::signal::{Instant, Signal};

/// Length, in steps, of the first interval of the input (*stretch*) in which a limit is searched.
const STRETCH: f64 = 40.0;
/// Ratio of the lengths of successive stretches.
const GROWTH: f64 = 8.0;
/// Number of stretches.
const STRETCHES: usize = 24;

/// Largest number of steps on one stretch.
const STEPS: usize = 20_000;

/// The path of one input, with time and the other inputs constant.
pub(super) struct OfInput<'a> {
    pub(super) at: Instant<'a>,
    pub(super) input: usize,
    pub(super) ends: [f64; 2],
}

impl Course for OfInput<'_> {
    fn ends(&self) -> [f64; 2] {
        self.ends
    }

    fn at(&self, s: f64, inputs: &mut [Signal]) -> f64 {
        for (k, (to, u)) in inputs.iter_mut().zip(self.at.inputs).enumerate() {
            *to = if k == self.input { Signal::new(s, 1.0, 0.0) } else { Signal::constant(u.value) };
        }
        self.at.t
    }

    fn is_frozen(&self) -> bool {
        true
    }

    fn has_rates_of_end(&self) -> bool {
        false
    }
}

impl<M: Mechanism> PlanFollower<M> {
    /// The value of an input at which the branch ends in one direction, and the limit there; infinite if no limit was
    /// met in all stretches.
    #[cold]
    #[inline(never)]
    pub(super) fn range_end(
        &self,
        mechanism: &M,
        input: usize,
        direction: f64,
    ) -> Result<(f64, Option<Limit>), PlanError> {
        let mut follower = *self;
        let nowhere = Ok((direction * f64::INFINITY, None));
        let mut reach: f64 = 0.0;
        for _ in 0..STRETCHES {
            let Some(from) = follower.value_of(input) else { return nowhere };
            if !follower.solve_along(mechanism, input) {
                return nowhere;
            }
            let tried = follower.trial();
            let rates = [tried.q_dot.as_ref(), tried.q_ddot.as_ref()];
            let step = natural_step(rates, follower.weights.as_ref(), Control::USUAL.rotation);
            if !step.is_finite() && reach == 0.0 {
                // The input turns no body, or moves nothing, at least here.
                reach = 1.0 + from.abs();
            } else {
                reach = f64::max(GROWTH * reach, if step.is_finite() { STRETCH * step } else { 0.0 });
            }
            match follower.move_input(mechanism, input, from + direction * reach) {
                Ok(()) => {}
                Err((error @ PlanError::TooManySteps { .. }, _)) => return Err(error),
                Err((error, place)) => return Ok((place, error.limit().copied())),
            }
        }
        nowhere
    }

    /// The value of an input at the accepted state.
    pub(super) fn value_of(&self, input: usize) -> Option<f64> {
        self.inputs.as_ref().get(input).map(|u| u.value)
    }

    /// Solves at the accepted state with rates with respect to the input; the result is the trial state. False if there
    /// is none.
    pub(super) fn solve_along(&mut self, mechanism: &M, input: usize) -> bool {
        let mut signals = self.inputs;
        let inputs = self.inputs;
        let at = Instant { t: self.t, inputs: inputs.as_ref() };
        let Some(from) = self.value_of(input) else { return false };
        self.predicted = self.state().q;
        self.solve_at(mechanism, &OfInput { at, input, ends: [from; 2] }, from, &mut signals).unwrap_or(false)
    }

    /// Moves the input to another value; otherwise the reason and the value at which the branch ends.
    pub(super) fn move_input(&mut self, mechanism: &M, input: usize, to: f64) -> Result<(), (PlanError, f64)> {
        let inputs = self.inputs;
        let at = Instant { t: self.t, inputs: inputs.as_ref() };
        let from = self.value_of(input).unwrap_or(to);
        let mut signals = inputs;
        if let Some(u) = signals.as_mut().get_mut(input) {
            *u = Signal::constant(to);
        }
        let end = Instant { t: at.t, inputs: signals.as_ref() };
        let course = OfInput { at, input, ends: [from, to] };
        let control = Control { max_steps: STEPS, ..Control::USUAL };
        match self.walk(mechanism, &course, &end, &control) {
            Ok(()) => {
                let nearest = self.measure();
                self.accept(&end, nearest, false);
                let q = self.state().q;
                self.measure_turns(mechanism, &end, &q);
                Ok(())
            }
            Err(blocked) => Err(self.refusal_at(mechanism, &course, &end, &blocked)),
        }
    }
}
