//! Extrapolation to a limit: where it is and the configuration there, more accurate than a state computed near the limit.
//!
//! Near a limit t and all of q are smooth functions of w, the signed distance of the group from its limit, both at a
//! fold, where q depends on √(t* − t), and at a crossing of branches. So t and q at w = 0 follow from states on the way
//! to the limit by the interpolating polynomial:
//!
//! ```text
//! f(0) ≈ Σₖ f(wₖ) Πⱼ≠ₖ wⱼ/(wⱼ − wₖ)
//! ```

use super::follower::{PlanFollower, PlanSolution};
use super::group_limit::LimitKind;
use super::lists::BranchValues;
use super::predict::parabola;
use super::substeps::Blocked;
use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::scalar::Scalar;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Number of states that the polynomial interpolates.
const SAMPLES: usize = 7;

/// Lower bounds of w of the farthest state, which are tried in turn.
const FARTHEST_DISTANCES: [f64; 9] = [0.02, 0.006, 0.002, 6e-4, 2e-4, 6e-5, 2e-5, 6e-6, 2e-6];

/// Further bounds between these, which are tried where none of them is accurate.
const FURTHER_WIDTHS: [f64; 8] = [0.011, 0.0035, 1.1e-3, 3.5e-4, 1.1e-4, 3.5e-5, 1.1e-5, 3.5e-6];

/// The smallest w of the farthest state where the motion did not start farther away.
const MIN_FARTHEST_DISTANCE: f64 = 1e-6;

/// The largest w of a state near which an iteration may fail because of rounding errors alone.
const WITHIN_ROUNDING: f64 = 1e-4;

/// Largest number of times that the distance from the limit is doubled.
const DOUBLINGS: usize = 60;

/// Slope ds/dw at a limit, relative to that of the whole interval, below which it counts as zero.
const FLAT_SLOPE: f64 = 0.1;

/// Largest change that leaving out one of the samples may cause, relative to 1 + |q_k| for a coordinate and to the
/// interval for its parameter.
const AGREEMENT: f64 = 1e-7;

/// Largest branch value of an iterated group at its limit, relative to that of the nearest sample. Within a sharp corner
/// of a curve w may seem to go to 0 before it is followed around the corner.
const AT_LIMIT: f64 = 0.01;

/// A limit that is located more accurately than by the last state reached.
pub(super) struct RefinedLimit<M: Mechanism> {
    /// Its parameter on the course.
    pub(super) s: f64,
    /// q there.
    pub(super) q: M::Coordinates<f64>,
    /// The change that leaving out one of the samples causes, relative to 1 + |q_k| for a coordinate, and to the
    /// interval for its parameter; 0 if it was not extrapolated.
    pub(super) error: f64,
    /// The kind of limit, where it is clear.
    pub(super) kind: Option<LimitKind>,
}

impl<M: Mechanism> PlanFollower<M> {
    /// The limit of a group, near the parameter `at` of the course; `group` is its index.
    /// `None` where the motion did not start far enough away, or the states are not on a smooth curve.
    pub(super) fn extrapolate(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        (group, at): (usize, f64),
        blocked: &Blocked<M>,
    ) -> Option<RefinedLimit<M>> {
        // Narrow intervals avoid the influence of other limits, wide ones that of rounding; the one with the smallest
        // error is used.
        let mut best: Option<RefinedLimit<M>> = None;
        for (k, width) in FARTHEST_DISTANCES.into_iter().chain(FURTHER_WIDTHS).enumerate() {
            if k == FARTHEST_DISTANCES.len() && best.as_ref().is_some_and(|best| best.error <= AGREEMENT) {
                break;
            }
            let found = self.extrapolate_from(mechanism, course, (group, at, width), blocked);
            let is_better = |found: &RefinedLimit<M>| best.as_ref().is_none_or(|best| found.error < best.error);
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
        (group, at, width): (usize, f64, f64),
        blocked: &Blocked<M>,
    ) -> Option<RefinedLimit<M>> {
        let margin = M::model().plan.margin_of_group(group)?;
        // Moves away from the limit in steps that grow with the distance.
        let [start, _] = course.ends();
        let (mut s, mut from, mut w) = (blocked.interval[0], blocked.state, 0.0);
        let mut place = s;
        for _ in 0..DOUBLINGS {
            // With inputs, the motion before the start of the course is not known.
            let back = farther_back((at, place), start, M::INPUTS > 0);
            if w >= width || back == place {
                break;
            }
            place = back;
            // At the limit itself, within rounding, an iteration may fail that converges farther away.
            match self.sample(mechanism, course, (margin, back), (s, &from)) {
                Some(sample) => (s, (w, from)) = (back, sample),
                None if w < WITHIN_ROUNDING => {}
                None => break,
            }
        }
        if w < MIN_FARTHEST_DISTANCE {
            return None;
        }
        let reach = at - s;
        let mut samples = [(w, s, from.q); SAMPLES];
        for (k, sample) in samples.iter_mut().enumerate().rev().skip(1) {
            // At a fold w is proportional to the square root of the distance.
            let share = (k + 1) as f64 / SAMPLES as f64;
            let next = at - reach * share * share;
            (w, from) = self.sample(mechanism, course, (margin, next), (s, &from))?;
            s = next;
            *sample = (w, s, from.q);
        }
        let mut q = from.q;
        // A loop, because a closure would be compiled again for every mechanism.
        let mut seen = [(0.0, 0.0, &[][..]); SAMPLES];
        for (seen, (w, s, q)) in seen.iter_mut().zip(&samples) {
            *seen = (*w, *s, q.as_ref());
        }
        let (s, error, kind) = interpolated(&seen, reach, q.as_mut())?;
        let found = RefinedLimit::<M> { s, q, error, kind };
        let is_there = group < M::model().plan.modes.len() || {
            let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
            let at = Instant { t: course.at(s, inputs.as_mut()), inputs: inputs.as_ref() };
            let values = BranchValues::<M>::at(mechanism, self.parameters.as_ref(), &at, found.q.as_ref()).ok()?;
            values.as_ref()[group].abs() <= AT_LIMIT * samples[0].0
        };
        (is_there && found.error.is_finite()).then_some(found)
    }

    /// w, as the root of a margin, and the state at a parameter of the course that the motion has passed; the prediction
    /// starts from the state `from` at the parameter `beside`.
    fn sample(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        (margin, s): (usize, f64),
        (beside, from): (f64, &PlanSolution<M>),
    ) -> Option<(f64, PlanSolution<M>)> {
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let rates = [from.q.as_ref(), from.q_dot.as_ref(), from.q_ddot.as_ref()];
        parabola(self.predicted.as_mut(), rates, self.weights.as_ref(), s - beside);
        let is_good = self.solve_at(mechanism, course, s, &mut inputs).ok()?;
        let at = Instant { t: course.at(s, inputs.as_mut()), inputs: inputs.as_ref() };
        let is_good = is_good && self.keeps_orientations(mechanism, &at).ok()?;
        let found = self.trial();
        is_good.then(|| (Scalar::sqrt(found.margins.as_ref()[margin]), *found))
    }
}

/// The next parameter on the way back from a limit near `at`, in steps that grow with the distance, and never before the
/// start of the course if `stops_there`.
fn farther_back((at, s): (f64, f64), start: f64, stops_there: bool) -> f64 {
    let least = 4.0 * f64::EPSILON * at.abs().max(start.abs());
    let stride = if (at - s).abs() > least { at - s } else { least.copysign(at - start) };
    if stops_there && (stride > 0.0) == (s - stride < start) { start } else { s - stride }
}

/// The parameter, the error and the kind of the limit of samples (w, s, q); writes q there. `None` where w does not grow.
fn interpolated(
    samples: &[(f64, f64, &[f64]); SAMPLES],
    reach: f64,
    q: &mut [f64],
) -> Option<(f64, f64, Option<LimitKind>)> {
    let w = samples.map(|sample| sample.0);
    if !w.is_sorted_by(|a, b| a < b) {
        return None;
    }
    let at_limit = Interpolation::new(w);
    let (s, mut worst, kind) = at_limit.limit(&samples.map(|sample| sample.1), reach);
    for (k, q) in q.iter_mut().enumerate() {
        let error;
        (*q, error) = at_limit.value(&samples.map(|sample| sample.2[k]));
        worst = f64::max(worst, error / (1.0 + samples[0].2[k].abs()));
    }
    Some((s, worst, kind))
}

/// One number of every sample; the nearest to the limit comes first.
type Samples = [f64; SAMPLES];

/// The interpolating polynomial at w = 0: the weights of its values, for all samples and for all but the farthest.
struct Interpolation {
    w: Samples,
    all: Samples,
    fewer: Samples,
}

impl Interpolation {
    fn new(w: Samples) -> Self {
        let [mut all, mut fewer] = [[0.0; SAMPLES]; 2];
        write_weights(&w, &mut all);
        write_weights(&w[..SAMPLES - 1], &mut fewer[..SAMPLES - 1]);
        Self { w, all, fewer }
    }

    /// The value at w = 0, and the change that leaving out the farthest sample causes.
    fn value(&self, values: &Samples) -> (f64, f64) {
        // Differences from the first value, so that no digits are lost.
        let differences = values.map(|value| value - values[0]);
        let found = dot(&self.all, &differences);
        (values[0] + found, (found - dot(&self.fewer, &differences)).abs())
    }

    /// The parameter of the limit, the change that leaving out the farthest sample causes, relative to `reach`, the length
    /// of the interval, and the kind of limit, where it is clear.
    fn limit(&self, parameters: &Samples, reach: f64) -> (f64, f64, Option<LimitKind>) {
        let (s, change) = self.value(parameters);
        // At a fold the slope ds/dw is 0, and w is proportional to the square root of the distance.
        let slopes = core::array::from_fn(|k| (parameters[k] - s) / self.w[k]);
        let is_flat = dot(&self.all, &slopes).abs() < FLAT_SLOPE * slopes[SAMPLES - 1].abs();
        let [near, far] = [SAMPLES / 2, SAMPLES - 1].map(|k| (self.w[k], (parameters[k] - s).abs()));
        let is_root = far.1 * near.0 * Scalar::sqrt(near.0) > near.1 * far.0 * Scalar::sqrt(far.0);
        let kind = match (is_flat, is_root) {
            (true, true) => Some(LimitKind::DeadCentre),
            (false, false) => Some(LimitKind::BranchPoint),
            _ => None,
        };
        (s, change / reach.abs(), kind)
    }
}

fn dot(a: &Samples, b: &Samples) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Writes the weights of the values at `at` in the interpolating polynomial at 0.
fn write_weights(at: &[f64], weights: &mut [f64]) {
    for (k, weight) in weights.iter_mut().enumerate() {
        let other_places = at.iter().enumerate().filter(|(j, _)| *j != k);
        *weight = other_places.map(|(_, other)| other / (other - at[k])).product();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_lower_degree_is_met() {
        let places = [0.1, 0.15, 0.3, 0.45, 0.7];
        let f = |x: f64| 3.0 + x * (2.0 - x * (1.0 + x * (4.0 - 5.0 * x)));
        let mut weights = [0.0; 5];
        write_weights(&places, &mut weights);
        let at_0: f64 = weights.iter().zip(places).map(|(weight, x)| weight * f(x)).sum();
        assert!((at_0 - 3.0).abs() < 1e-12, "{at_0}");
    }

    /// The distances w of seven states at a fold or at a crossing, at the parameters 0.7 − s.
    const W: Samples = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07];

    /// At a fold s is quadratic in w, at a crossing linear; both with terms of higher order.
    #[test]
    fn a_fold_is_told_from_a_crossing_and_both_are_met() {
        let of = |s: &dyn Fn(f64) -> f64| Interpolation::new(W).limit(&W.map(|w| 0.7 - s(w)), 0.01);
        let is = |expected: LimitKind, (place, error, kind): (f64, f64, Option<LimitKind>)| {
            assert!((place - 0.7).abs() < 1e-14 && error < 1e-11 && kind == Some(expected), "{place} {error} {kind:?}");
        };
        is(LimitKind::DeadCentre, of(&|w| w * w * (2.0 + w)));
        is(LimitKind::BranchPoint, of(&|w| w * (0.2 - w * w)));
        // A term that is not smooth counts as an error, relative to the interval.
        let (_, rough, _) = of(&|w| w + 1e-4 * (900.0 * w).sin());
        let (_, wider, _) = Interpolation::new(W).limit(&W.map(|w| 0.7 - w - 1e-4 * (900.0 * w).sin()), -0.02);
        assert!(rough > 1e-3 && (wider - 0.5 * rough).abs() < 1e-12, "{rough} {wider}");
    }

    #[test]
    fn the_way_back_doubles_and_ends_at_the_start_where_nothing_is_known_before() {
        let back = |at: f64, s: f64, stops: bool| farther_back((at, s), 0.0, stops);
        assert_eq!([0.75, 0.5], [back(1.0, 0.875, true), back(1.0, 0.75, true)]);
        assert_eq!([0.0, -0.5], [back(1.0, 0.25, true), back(1.0, 0.25, false)]);
        // Backwards in time.
        assert_eq!([0.0, 0.5], [back(-1.0, -0.25, true), back(-1.0, -0.25, false)]);
        // At the limit itself the first step is the smallest that changes a number.
        let first = 1.0 - back(1.0, 1.0, false);
        assert!(first > 0.0 && first < 2e-15, "{first}");
    }
}
