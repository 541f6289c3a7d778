//! Extrapolation to a limit: its place and the configuration there, with more digits than a state near the limit has.
//!
//! Near a limit all moving coordinates are smooth functions of w, the signed distance of the group from its limit: t
//! and all of q, at a fold, where q depends on √(t* − t), as well as at a crossing of branches. So t and q at w = 0
//! follow from states on the way to the limit by the interpolating polynomial:
//!
//! ```text
//! f(0) ≈ Σₖ f(wₖ) Πⱼ≠ₖ wⱼ/(wⱼ − wₖ)
//! ```

use super::error::LimitKind;
use super::follower::{Follower, Poses};
use super::predict::parabola;
use super::walk::Blocked;
use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::scalar::Scalar;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Number of states that the polynomial interpolates.
const SAMPLES: usize = 7;

/// Lower bounds of w of the farthest state, which are tried in turn.
const WIDTHS: [f64; 7] = [0.02, 0.006, 0.002, 6e-4, 2e-4, 6e-5, 2e-5];

/// The smallest w of the farthest state where the motion did not start farther away.
const NARROWEST: f64 = 1e-5;

/// Largest number of times that the distance from the limit is doubled.
const DOUBLINGS: usize = 60;

/// Slope ds/dw at a limit, relative to that of the whole interval, below which it counts as zero.
const FLAT: f64 = 0.1;

/// Largest change, in radians or units of length, that leaving out one of the samples may cause.
const AGREEMENT: f64 = 1e-7;

/// An extrapolated limit.
pub(super) struct Found<M: Mechanism> {
    /// Its place on the course.
    pub(super) place: f64,
    /// q there.
    pub(super) q: M::Coordinates<f64>,
    /// The change that leaving out one of the samples causes, in radians or lengths, or relative to the interval.
    error: f64,
    /// The kind of limit, where it is clear.
    pub(super) kind: Option<LimitKind>,
}

impl<M: Mechanism> Follower<M> {
    /// The limit of a group, near the place `at` of the course; `sign` is the index of the group among the signs.
    /// `None` where the motion did not start far enough away, or the states are not on a smooth curve.
    pub(super) fn extrapolate(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        (sign, at): (usize, f64),
        blocked: &Blocked<M>,
    ) -> Option<Found<M>> {
        let margin = M::model().plan.margin_of_sign(sign)?;
        // Narrow intervals avoid the influence of other limits, wide ones that of rounding; the one with the smallest
        // error wins.
        let mut best: Option<Found<M>> = None;
        for width in WIDTHS {
            let found = self.extrapolate_from(mechanism, course, (margin, at, width), blocked);
            let is_better = |found: &Found<M>| best.as_ref().is_none_or(|best| found.error < best.error);
            if let Some(found) = found.filter(is_better) {
                best = Some(found);
            }
        }
        best.filter(|found| found.error <= AGREEMENT)
    }

    /// The extrapolation from states of which the farthest has at least this w.
    fn extrapolate_from(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        (margin, at, width): (usize, f64, f64),
        blocked: &Blocked<M>,
    ) -> Option<Found<M>> {
        // Moves away from the limit in steps that grow with the distance.
        let [start, _] = course.ends();
        let (mut s, mut from, mut w) = (blocked.places[0], blocked.here, 0.0);
        let least = 4.0 * f64::EPSILON * at.abs().max(start.abs());
        for _ in 0..DOUBLINGS {
            let stride = if (at - s).abs() > least { at - s } else { least.copysign(at - start) };
            // With inputs, nothing is known before the start of the course.
            let back = if M::INPUTS > 0 && (stride > 0.0) == (s - stride < start) { start } else { s - stride };
            if w >= width || back == s {
                break;
            }
            let Some(sample) = self.sample(mechanism, course, (margin, back), (s, &from)) else { break };
            (s, (w, from)) = (back, sample);
        }
        if w < NARROWEST {
            return None;
        }
        let reach = at - s;
        let mut samples = [(w, s, from.q); SAMPLES];
        for (k, sample) in samples.iter_mut().enumerate().rev().skip(1) {
            // At a fold w is proportional to the square root of the distance.
            let share = (k + 1) as f64 / SAMPLES as f64;
            let place = at - reach * share * share;
            (w, from) = self.sample(mechanism, course, (margin, place), (s, &from))?;
            s = place;
            *sample = (w, s, from.q);
        }
        if !samples.is_sorted_by(|a, b| a.0 < b.0) {
            return None;
        }
        let all = weights(&samples.map(|sample| sample.0));
        let nearer: [f64; SAMPLES - 1] = core::array::from_fn(|k| samples[k].0);
        let fewer = weights(&nearer);
        let sum = |weights: &[f64], of: &dyn Fn(usize) -> f64| -> f64 {
            weights.iter().enumerate().map(|(k, weight)| weight * of(k)).sum()
        };
        let first = &samples[0];
        let s = |k: usize| samples[k].1 - first.1;
        let place = first.1 + sum(&all, &s);
        let mut error = ((sum(&all, &s) - sum(&fewer, &s)) / reach).abs();
        let q = M::Coordinates::<f64>::generate(|k| {
            let first = first.2.as_ref()[k];
            let of = |sample: usize| samples[sample].2.as_ref()[k] - first;
            let (found, other) = (sum(&all, &of), sum(&fewer, &of));
            error = error.max((found - other).abs() / (1.0 + first.abs()));
            first + found
        });
        // At a fold the slope ds/dw is 0, and w is proportional to the square root of the distance.
        let slope = |k: usize| (samples[k].1 - place) / samples[k].0;
        let is_flat = sum(&all, &slope).abs() < FLAT * slope(SAMPLES - 1).abs();
        let [near, far] = [samples[SAMPLES / 2], samples[SAMPLES - 1]].map(|(w, s, _)| (w, (s - place).abs()));
        let is_root = far.1 * near.0 * Scalar::sqrt(near.0) > near.1 * far.0 * Scalar::sqrt(far.0);
        let kind = match (is_flat, is_root) {
            (true, true) => Some(LimitKind::DeadCentre),
            (false, false) => Some(LimitKind::BranchPoint),
            _ => None,
        };
        error.is_finite().then_some(Found { place, q, kind, error })
    }

    /// w, as the root of a margin, and the state at a place of the course that the motion has passed; the prediction
    /// starts from the state `from` at the place `beside`.
    fn sample(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        (margin, s): (usize, f64),
        (beside, from): (f64, &Poses<M>),
    ) -> Option<(f64, Poses<M>)> {
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let rates = [from.q.as_ref(), from.q_dot.as_ref(), from.q_ddot.as_ref()];
        parabola(self.predicted.as_mut(), rates, self.weights.as_ref(), s - beside);
        let is_good = self.solve_at(mechanism, course, s, &mut inputs).ok()?;
        let at = Instant { t: course.at(s, inputs.as_mut()), inputs: inputs.as_ref() };
        let is_good = is_good && self.keeps_orientations(mechanism, &at).ok()?;
        let found = &self.states[1 - self.good];
        is_good.then(|| (Scalar::sqrt(found.margins.as_ref()[margin]), *found))
    }
}

/// The weights of the values at `places` in the interpolating polynomial at 0.
fn weights<const N: usize>(places: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|k| {
        let others = places.iter().enumerate().filter(|(j, _)| *j != k);
        others.map(|(_, other)| other / (other - places[k])).product()
    })
}

#[cfg(test)]
mod tests {
    use super::weights;

    #[test]
    fn a_polynomial_of_lower_degree_is_met() {
        let places = [0.1, 0.15, 0.3, 0.45, 0.7];
        let f = |x: f64| 3.0 + x * (2.0 - x * (1.0 + x * (4.0 - 5.0 * x)));
        let at_0: f64 = weights(&places).iter().zip(places).map(|(weight, x)| weight * f(x)).sum();
        assert!((at_0 - 3.0).abs() < 1e-12, "{at_0}");
    }
}
