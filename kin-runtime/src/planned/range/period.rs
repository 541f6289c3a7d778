//! Whether the motion by an input repeats after whole turns of a body, so that the input has no limits.
//!
//! If the input u turns a body with the angle c u + d, and otherwise enters only through this angle, the configuration
//! repeats after m turns of the body, m > 1 where gears turn other bodies by fractions of a turn:
//!
//! ```text
//! q(u + P) = q(u) + D,   P = 2π m/|c|
//! ```
//!
//! D is the same for all u: whole turns of angles, and the lengths by which bodies move on steadily, as a rack does. The
//! spindle of a jack moves the other bodies by unequal amounts in every turn, and has limits.

use crate::mechanism::Mechanism;
use crate::planned::follower::PlanFollower;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use core::f64::consts::TAU;

/// Places in a turn, in parts of it, at which the configuration is compared with that of a later turn.
const PLACES: [f64; 5] = [0.11, 0.29, 0.53, 0.71, 0.97];

/// Largest number of turns after which the motion is expected to repeat.
const MOST_TURNS: u32 = 32;

/// Largest difference between both configurations, relative to the numbers.
const SAME: f64 = 1e-9;

/// A rate counts as constant if its own rate, relative to its square, is below this.
const CONSTANT_RATE: f64 = 1e-9;

impl<M: Mechanism> PlanFollower<M> {
    /// Whether the motion by the input, in either direction, repeats after whole turns of a body, and has no limit in
    /// between.
    #[cold]
    #[inline(never)]
    pub(super) fn repeats_in_turns(&self, mechanism: &M, input: usize) -> bool {
        let mut follower = *self;
        let Some(start) = follower.value_of(input) else { return false };
        if !follower.solve_along(mechanism, input) {
            return false;
        }
        let (mut steady, mut slowest) = (M::Coordinates::<f64>::filled(0.0), f64::INFINITY);
        let along = follower.trial();
        let rates = along.q_dot.as_ref().iter().zip(along.q_ddot.as_ref());
        for (k, (&rate, &acceleration)) in rates.enumerate() {
            if rate != 0.0 && acceleration.abs() <= CONSTANT_RATE * rate * rate {
                steady.as_mut()[k] = rate;
                if M::model().coordinates[k].kind.is_angle() {
                    slowest = f64::min(slowest, rate.abs());
                }
            }
        }
        if slowest.is_infinite() {
            // The input turns no body steadily.
            return false;
        }
        let turn = TAU / slowest;
        // Bit m − 1 is set while the configuration repeats after m turns at all places so far.
        let mut repeats = u32::MAX;
        for place in PLACES {
            if follower.move_input(mechanism, input, start + place * turn).is_err() {
                return false;
            }
            for turns in 1..=MOST_TURNS {
                let bit = 1 << (turns - 1);
                let after = f64::from(turns) * turn;
                if repeats & bit != 0 && !follower.is_same_after(mechanism, input, after, steady.as_ref()) {
                    repeats &= !bit;
                }
            }
            if repeats == 0 {
                return false;
            }
        }
        (1..=repeats.trailing_zeros() + 1)
            .all(|turns| follower.move_input(mechanism, input, start + f64::from(turns) * turn).is_ok())
    }

    /// Whether the configuration is the same where the input has moved on by `after`, apart from whole turns and from
    /// what moves on with a `steady` rate, and with the same margins. Only the trial state changes.
    fn is_same_after(&mut self, mechanism: &M, input: usize, after: f64, steady: &[f64]) -> bool {
        let mut signals = self.inputs;
        signals.as_mut().iter_mut().for_each(|u| *u = Signal::constant(u.value));
        if let Some(u) = signals.as_mut().get_mut(input) {
            u.value += after;
        }
        self.predicted = self.state().q;
        self.predicted.as_mut().iter_mut().zip(steady).for_each(|(q, rate)| *q += rate * after);
        let at = Instant { t: self.t, inputs: signals.as_ref() };
        if !self.solve_in_modes(mechanism, &at).unwrap_or(false) {
            return false;
        }
        let (now, then) = (self.state(), self.trial());
        let expected = self.predicted.as_ref();
        let is_same = |k: usize| {
            let (found, expected) = (then.q.as_ref()[k], expected[k]);
            let difference = (found - expected).abs();
            let part = difference % TAU;
            let is_angle = M::model().coordinates[k].kind.is_angle();
            let difference = if is_angle { part.min(TAU - part) } else { difference };
            difference <= SAME * (1.0 + found.abs() + expected.abs())
        };
        let mut margins = now.margins.as_ref().iter().zip(then.margins.as_ref());
        (0..expected.len()).all(is_same) && margins.all(|(now, then)| (now - then).abs() <= SAME)
    }
}
