//! The check of a step in which the gradients of rows turn otherwise than bodies do, for a single set of parameters and
//! for several in lanes.

use super::follower::{Control, NEGLIGIBLE_CORRECTION};
use super::gradient_turns::bends_are_followed;
use super::inputs::{spread_inputs, write_lane_of_inputs};
use super::interior::{certainty_at_samples, certainty_of_rates};
use super::lists::Modes;
use super::parts::Span;
use super::predict::{largest_turn, turned};
use crate::mechanism::{LengthError, Mechanism};
use crate::scalar::compare::{Compare, least_or_nan, write_lane};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// A step from a solution to a trial solution.
pub(crate) struct TrialStep<'a, M: Mechanism, V: Compare = f64> {
    pub(crate) parameters: &'a [V],
    pub(crate) modes: &'a Modes<M, V>,
    /// The angles by which the gradients of rows turn per unit of each coordinate.
    pub(crate) turns: &'a [V],
    /// q, q̇ and q̈ of the solution.
    pub(crate) before: [&'a [V]; 3],
    /// The prediction of q.
    pub(crate) predicted: &'a [V],
    /// q and q̇ of the trial solution.
    pub(crate) tried: [&'a [V]; 2],
    /// The inputs of the solution, which all sets share.
    pub(crate) inputs: &'a [Signal],
    /// The length of the step, and the instant of the trial solution.
    pub(crate) h: f64,
    pub(crate) at: &'a Instant<'a, V>,
}

impl<M: Mechanism, V: Compare> TrialStep<'_, M, V> {
    /// A measure that is not negative where the step turns the gradients of rows no farther than bodies may turn, its end
    /// is near its prediction by the same measure, and no group whose branch value must be looked at comes near its limit
    /// in between; NaN where this is not certain.
    #[cold]
    #[inline(never)]
    pub(crate) fn certainty_of_rows(&self, mechanism: &M, control: &Control) -> Result<V, LengthError> {
        let &Self { parameters, modes, turns, before: [q, q_dot, q_ddot], predicted, tried, inputs, h, at } = self;
        let (model, number) = (M::model(), V::from_f64);
        let turn = largest_turn([q_dot, q_ddot], turns, h);
        let allowed = number(control.correction) * turn + number(NEGLIGIBLE_CORRECTION);
        let near = allowed - turned(tried[0], predicted, turns);
        let mut certainty = least_or_nan(number(control.rotation) - turn, near);
        if h == 0.0 {
            // An input may have jumped; its rates do not show how far the rows have turned.
            let jumps = M::CLOSED_ROWS_TURN && inputs_jump(inputs, at.inputs);
            return Ok(if jumps { number(-1.0) } else { certainty });
        }
        if !M::CLOSED_ROWS_TURN && !model.plan.iterates() {
            return Ok(certainty);
        }
        let ends = [q, q_dot, tried[0], tried[1]];
        certainty = least_or_nan(certainty, certainty_of_rates(model, M::CLOSED_ROWS_TURN, (ends, turns), h));
        if M::ROWS_CURVE {
            for lane in 0..V::LANES {
                if certainty.lane(lane) >= 0.0 && !self.bends_are_followed(mechanism, control, lane)? {
                    certainty.set_lane(lane, -1.0);
                }
            }
        }
        let samples = M::CLOSED_ROWS_TURN || !M::ROWS_CURVE;
        if !samples || !any_lane_is_certain(certainty) {
            return Ok(certainty);
        }
        let mut from = M::Inputs::<V>::filled(Signal::constant(number(0.0)));
        spread_inputs(from.as_mut(), inputs);
        let known = (parameters, from.as_ref(), at);
        Ok(least_or_nan(certainty, certainty_at_samples(mechanism, known, modes, ends, h)?))
    }

    /// True if no iterated group of a set comes near its limit in a bend of the rows.
    fn bends_are_followed(&self, mechanism: &M, control: &Control, lane: usize) -> Result<bool, LengthError> {
        let [mut q0, mut v0, mut q1, mut v1] = [M::Coordinates::<f64>::filled(0.0); 4];
        write_lane(q0.as_mut(), self.before[0], lane);
        write_lane(v0.as_mut(), self.before[1], lane);
        write_lane(q1.as_mut(), self.tried[0], lane);
        write_lane(v1.as_mut(), self.tried[1], lane);
        let ends = [q0.as_ref(), v0.as_ref(), q1.as_ref(), v1.as_ref()];
        let span = Span { ends, inputs: self.inputs, h: self.h };
        let mut parameters = M::Parameters::<f64>::filled(0.0);
        write_lane(parameters.as_mut(), self.parameters, lane);
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        write_lane_of_inputs(inputs.as_mut(), self.at.inputs, lane);
        let at = Instant { t: self.at.t.lane(lane), inputs: inputs.as_ref() };
        let modes = Modes::lane_of(self.modes, lane);
        bends_are_followed(mechanism, (parameters.as_ref(), &at), &modes, span, control.rotation)
    }
}

// These functions are not generic over the mechanism, so that they are compiled once for all.

/// Whether an input has another value at the end of a step, in its first lane; all lanes share the inputs.
fn inputs_jump<V: Compare>(before: &[Signal], now: &[Signal<V>]) -> bool {
    before.iter().zip(now).any(|(before, now)| before.value != now.value.lane(0))
}

/// Whether a measure is certain in any lane.
fn any_lane_is_certain<V: Compare>(certainty: V) -> bool {
    (0..V::LANES).any(|lane| certainty.lane(lane) >= 0.0)
}
