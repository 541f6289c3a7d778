//! The check of a common step where the gradients of rows turn otherwise than bodies do.

use super::Motion;
use crate::course::{Between, Course, kind};
use crate::mechanism::Mechanism;
use crate::planned::follower::{Control, NEGLIGIBLE};
use crate::planned::gradient_turns::{Span, bends_are_followed};
use crate::planned::hidden_motion::{FRACTIONS, Stretch, certainty_within, least_or_nan};
use crate::planned::interior::{certainty_at_samples, certainty_of_rates};
use crate::planned::lists::Modes;
use crate::planned::predict::{largest_turn, turned};
use crate::scalar::Scalar;
use crate::scalar::compare::Compare;
use crate::scalar::lanes::Octet;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

impl<M: Mechanism> Motion<M> {
    /// The largest turn of the gradients of rows in a step of the length h from the last instant.
    pub(super) fn turn_of_rows(&self, h: f64) -> Octet {
        let here = self.poses();
        largest_turn([here.q_dot.as_ref(), here.q_ddot.as_ref()], self.turns.as_ref(), h)
    }

    /// Not negative in lanes in which a step of the length h turns the gradients of rows no farther than bodies may turn,
    /// its end is near its prediction by the same measure, and no group whose branch value must be looked at comes near
    /// its limit in between.
    #[cold]
    #[inline(never)]
    pub(super) fn certainty_of_rows(&self, mechanism: &M, at: &Instant<'_, Octet>, h: f64, control: &Control) -> Octet {
        let (here, tried, turns) = (self.poses(), &self.poses[1 - self.good], self.turns.as_ref());
        let turn = self.turn_of_rows(h);
        let away = turned(tried.q.as_ref(), self.predicted.as_ref(), turns);
        let allowed = Octet::from_f64(control.correction) * turn + Octet::from_f64(NEGLIGIBLE);
        let ends = [here.q.as_ref(), here.q_dot.as_ref(), tried.q.as_ref(), tried.q_dot.as_ref()];
        let mut certainty = (Octet::from_f64(control.rotation) - turn).least(allowed - away);
        if h == 0.0 {
            // An input may have jumped; its rates do not show how far the rows have turned.
            let mut inputs = self.inputs.as_ref().iter().zip(at.inputs);
            let jumps = M::CLOSED_ROWS_TURN && inputs.any(|(before, now)| before.value != now.value.lane(0));
            return if jumps { Octet::from_f64(-1.0) } else { certainty };
        }
        if !M::CLOSED_ROWS_TURN && !M::model().plan.iterates() {
            return certainty;
        }
        certainty = certainty.least(certainty_of_rates(M::model(), M::CLOSED_ROWS_TURN, (ends, turns), h));
        if M::ROWS_CURVE {
            for lane in 0..Octet::COUNT {
                if certainty.lane(lane) >= 0.0 && !self.bends_are_followed(mechanism, at, h, control, lane) {
                    certainty.set(lane, -1.0);
                }
            }
            if !M::CLOSED_ROWS_TURN {
                return certainty;
            }
        }
        let from = M::Inputs::<Octet>::generate(Signal::constant(Octet::default()), |k| {
            self.inputs.as_ref()[k].map(Octet::from_f64)
        });
        let known = (self.parameters.as_ref(), from.as_ref(), at);
        let at_places = certainty_at_samples(mechanism, known, &self.modes, ends, h);
        debug_assert!(at_places.is_ok(), "the columns have been counted");
        certainty.least(at_places.unwrap_or_else(|_| Octet::from_f64(-1.0)))
    }

    /// Not negative in lanes in which the step to the time t hides no motion; `allowed` is the largest distance of the
    /// motion from the cubic through both ends, in radians.
    #[cold]
    #[inline(never)]
    pub(super) fn certainty_within(&self, mechanism: &M, at: &Instant<'_, Octet>, t: f64, allowed: Octet) -> Octet {
        let inputs = M::Inputs::<f64>::generate(Signal::constant(0.0), |k| at.inputs[k].map(|x| x.lane(0)));
        let from = Instant { t: self.t, inputs: self.inputs.as_ref() };
        let to = Instant { t, inputs: inputs.as_ref() };
        let course = Between { kind: kind(&from, &to), from, to };
        if course.is_frozen() {
            let mut inputs = from.inputs.iter().zip(to.inputs);
            return Octet::from_f64(if inputs.all(|(before, now)| before.value == now.value) { 1.0 } else { -1.0 });
        }
        let (here, tried) = (self.poses(), &self.poses[1 - self.good]);
        let ends = [here.q.as_ref(), here.q_dot.as_ref(), tried.q.as_ref(), tried.q_dot.as_ref()];
        let stretch = Stretch { course: &course, interval: [self.t, t], ends };
        let (parameters, weights) = (self.parameters.as_ref(), self.weights.as_ref());
        FRACTIONS.into_iter().fold(Octet::from_f64(1.0), |least, fraction| {
            let there = (stretch, fraction);
            let certainty = certainty_within(mechanism, parameters, there, &self.modes, (weights, allowed));
            debug_assert!(certainty.is_ok(), "the columns have been counted");
            least_or_nan(least, certainty.unwrap_or_else(|_| Octet::from_f64(-1.0)))
        })
    }

    /// True if no iterated group of a set comes near its limit in a bend of the rows.
    fn bends_are_followed(
        &self,
        mechanism: &M,
        at: &Instant<'_, Octet>,
        h: f64,
        control: &Control,
        lane: usize,
    ) -> bool {
        let pick = |list: &[Octet]| -> M::Coordinates<f64> { Array::generate(0.0, |k| list[k].lane(lane)) };
        let (here, tried) = (self.poses(), &self.poses[1 - self.good]);
        let ends = [&here.q, &here.q_dot, &tried.q, &tried.q_dot].map(|list| pick(list.as_ref()));
        let span = Span { ends: ends.each_ref().map(AsRef::as_ref), inputs: self.inputs.as_ref(), h };
        let parameters: M::Parameters<f64> = Array::generate(0.0, |k| self.parameters.as_ref()[k].lane(lane));
        let inputs = M::Inputs::<f64>::generate(Signal::constant(0.0), |k| at.inputs[k].map(|x| x.lane(lane)));
        let at = Instant { t: at.t.lane(lane), inputs: inputs.as_ref() };
        let modes = Modes::lane_of(&self.modes, lane);
        bends_are_followed(mechanism, (parameters.as_ref(), &at), &modes, span, control.rotation).unwrap_or(false)
    }
}
