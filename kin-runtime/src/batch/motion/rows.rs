//! The check of a common step where the gradients of rows turn otherwise than bodies do.

use super::{BlockMotion, BlockSolution};
use crate::course::{Between, Course, kind};
use crate::mechanism::Mechanism;
use crate::planned::follower::Control;
use crate::planned::hidden_motion::{CourseStep, certainty_within, curves_are_followed, leaves_its_rates};
use crate::planned::inputs::write_lane_of_inputs;
use crate::planned::interior::IRREGULAR_FRACTIONS;
use crate::planned::predict::largest_turn;
use crate::planned::steep_rows::certainty_of_slopes;
use crate::planned::turning_rows::TrialStep;
use crate::scalar::Scalar;
use crate::scalar::compare::{Compare, least_or_nan, write_lane};
use crate::scalar::lanes::Octet;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

impl<M: Mechanism> BlockMotion<M> {
    /// The largest turn of the gradients of rows in a step of the length h from the last instant.
    pub(super) fn turn_of_rows(&self, h: f64) -> Octet {
        let poses = self.poses();
        largest_turn([poses.q_dot.as_ref(), poses.q_ddot.as_ref()], self.turns[self.good].as_ref(), h)
    }

    /// Not negative in lanes in which a step of the length h turns the gradients of rows no farther than bodies may turn,
    /// its end is near its prediction by the same measure, and no group whose branch value must be looked at comes near
    /// its limit in between.
    pub(super) fn certainty_of_rows(&self, mechanism: &M, at: &Instant<'_, Octet>, h: f64, control: &Control) -> Octet {
        let (before, tried) = (self.poses(), &self.poses[1 - self.good]);
        let step = TrialStep {
            parameters: self.parameters.as_ref(),
            modes: &self.modes,
            turns: self.turns[self.good].as_ref(),
            before: [before.q.as_ref(), before.q_dot.as_ref(), before.q_ddot.as_ref()],
            predicted: self.predicted.as_ref(),
            tried: [tried.q.as_ref(), tried.q_dot.as_ref()],
            inputs: self.inputs.as_ref(),
            h,
            at,
        };
        let certainty = step.certainty_of_rows(mechanism, control);
        debug_assert!(certainty.is_ok(), "the columns have been counted");
        certainty.unwrap_or_else(|_| Octet::from_f64(-1.0))
    }

    /// Not negative in lanes in which rounding errors are small in the trial state; may be NaN in others.
    #[cold]
    #[inline(never)]
    pub(super) fn certainty_of_slopes(&self) -> Octet {
        let BlockSolution { q, q_dot, q_ddot, .. } = &self.poses[1 - self.good];
        let turns = self.turns[1 - self.good].as_ref();
        certainty_of_slopes(M::model(), M::DISTANCES_IN_ROWS, turns, [q.as_ref(), q_dot.as_ref(), q_ddot.as_ref()])
    }

    /// Not negative in lanes in which the step to the time t hides no motion; `allowed` is the largest distance of the
    /// motion from the cubic through both ends, in radians.
    #[cold]
    #[inline(never)]
    pub(super) fn certainty_within(&self, mechanism: &M, at: &Instant<'_, Octet>, t: f64, allowed: Octet) -> Octet {
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        write_lane_of_inputs(inputs.as_mut(), at.inputs, 0);
        let from = Instant { t: self.t, inputs: self.inputs.as_ref() };
        let to = Instant { t, inputs: inputs.as_ref() };
        let course = Between { kind: kind(&from, &to), from, to };
        let leaves = leaves_its_rates::<M>(&course);
        if leaves || course.is_frozen() || !M::KNOWN_VALUES_CURVE {
            return Octet::from_f64(if leaves { -1.0 } else { 1.0 });
        }
        let (accepted, tried) = (self.poses(), &self.poses[1 - self.good]);
        let ends = [accepted.q.as_ref(), accepted.q_dot.as_ref(), tried.q.as_ref(), tried.q_dot.as_ref()];
        let stretch = CourseStep { course: &course, interval: course.ends(), ends };
        let (parameters, weights) = (self.parameters.as_ref(), self.weights.as_ref());
        let certainty_at = |fraction: f64| {
            let place = (stretch, fraction);
            let known = (weights, allowed);
            let certainty = certainty_within(mechanism, parameters, place, &self.modes, known, &Control::USUAL);
            debug_assert!(certainty.is_ok(), "the columns have been counted");
            certainty.unwrap_or_else(|_| Octet::from_f64(-1.0))
        };
        let mut least = Octet::from_f64(1.0);
        for fraction in IRREGULAR_FRACTIONS {
            least = least_or_nan(least, certainty_at(fraction));
        }
        for lane in 0..Octet::LANES {
            let mut numbers = [M::Coordinates::<f64>::filled(0.0); 4];
            for (to, from) in numbers.iter_mut().zip(ends) {
                write_lane(to.as_mut(), from, lane);
            }
            let [q0, v0, q1, v1] = &numbers;
            let CourseStep { course, interval, .. } = stretch;
            let ends = [q0.as_ref(), v0.as_ref(), q1.as_ref(), v1.as_ref()];
            let stretch = CourseStep { course, interval, ends };
            let mut own_parameters = M::Parameters::<f64>::filled(0.0);
            write_lane(own_parameters.as_mut(), parameters, lane);
            let mut is_near = |fraction: f64| Ok(certainty_at(fraction).lane(lane) >= 0.0);
            let is_certain = least.lane(lane) >= 0.0;
            if is_certain && curves_are_followed(mechanism, own_parameters.as_ref(), stretch, &mut is_near) != Ok(true)
            {
                least.set_lane(lane, -1.0);
            }
        }
        least
    }
}
