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
        for _ in 0..DOUBLINGS {
            // With inputs, nothing is known before the start of the course.
            let back = farther_back((at, s), start, M::INPUTS > 0);
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
        let w = core::array::from_fn(|k| samples[k].0);
        if !w.is_sorted_by(|a, b| a < b) {
            return None;
        }
        let places = core::array::from_fn(|k| samples[k].1);
        let mut found = Found::<M> { place: 0.0, q: from.q, error: 0.0, kind: None };
        (found.place, found.error, found.kind) = at_limit(&w, &places, reach);
        let q: &mut [f64] = found.q.as_mut();
        for (k, q) in q.iter_mut().enumerate() {
            let values = core::array::from_fn(|sample| samples[sample].2.as_ref()[k]);
            let (value, error) = extrapolated(&w, &values);
            *q = value;
            found.error = found.error.max(error);
        }
        found.error.is_finite().then_some(found)
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

/// The next place on the way back from a limit near `at`, in steps that grow with the distance, and never before the
/// start of the course if `stops_there`.
fn farther_back((at, s): (f64, f64), start: f64, stops_there: bool) -> f64 {
    let least = 4.0 * f64::EPSILON * at.abs().max(start.abs());
    let stride = if (at - s).abs() > least { at - s } else { least.copysign(at - start) };
    if stops_there && (stride > 0.0) == (s - stride < start) { start } else { s - stride }
}

/// A number of every sample, the nearest to the limit first.
type Samples = [f64; SAMPLES];

/// The value at the limit, w = 0, and the change that leaving out the farthest sample causes, relative to 1 plus the
/// size of the values.
fn extrapolated(w: &Samples, values: &Samples) -> (f64, f64) {
    let (found, other) = sums(w, values);
    (values[0] + found, (found - other).abs() / (1.0 + values[0].abs()))
}

/// The differences between the value at w = 0 and the first one: by all samples, and by all but the farthest.
fn sums(w: &Samples, values: &Samples) -> (f64, f64) {
    let sum = |count: usize| {
        let terms = (0..count).map(|k| weight(&w[..count], k) * (values[k] - values[0]));
        terms.sum::<f64>()
    };
    (sum(SAMPLES), sum(SAMPLES - 1))
}

/// The place of the limit, the change that leaving out the farthest sample causes, relative to the interval, and the
/// kind of limit, where it is clear.
fn at_limit(w: &Samples, places: &Samples, reach: f64) -> (f64, f64, Option<LimitKind>) {
    let (found, other) = sums(w, places);
    let place = places[0] + found;
    // At a fold the slope ds/dw is 0, and w is proportional to the square root of the distance.
    let slope = |k: usize| (places[k] - place) / w[k];
    let slope_at_0: f64 = (0..SAMPLES).map(|k| weight(w, k) * slope(k)).sum();
    let is_flat = slope_at_0.abs() < FLAT * slope(SAMPLES - 1).abs();
    let [near, far] = [SAMPLES / 2, SAMPLES - 1].map(|k| (w[k], (places[k] - place).abs()));
    let is_root = far.1 * near.0 * Scalar::sqrt(near.0) > near.1 * far.0 * Scalar::sqrt(far.0);
    let kind = match (is_flat, is_root) {
        (true, true) => Some(LimitKind::DeadCentre),
        (false, false) => Some(LimitKind::BranchPoint),
        _ => None,
    };
    (place, ((found - other) / reach).abs(), kind)
}

/// The weight of the value at `places[k]` in the interpolating polynomial at 0.
fn weight(places: &[f64], k: usize) -> f64 {
    let others = places.iter().enumerate().filter(|(j, _)| *j != k);
    others.map(|(_, other)| other / (other - places[k])).product()
}

#[cfg(test)]
mod tests {
    use super::weight;

    #[test]
    fn a_polynomial_of_lower_degree_is_met() {
        let places = [0.1, 0.15, 0.3, 0.45, 0.7];
        let f = |x: f64| 3.0 + x * (2.0 - x * (1.0 + x * (4.0 - 5.0 * x)));
        let at_0: f64 = (0..places.len()).map(|k| weight(&places, k) * f(places[k])).sum();
        assert!((at_0 - 3.0).abs() < 1e-12, "{at_0}");
    }
}
