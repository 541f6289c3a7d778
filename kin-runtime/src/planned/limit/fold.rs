//! The fold at which the motion of an iterated group ends, found along the arc of the solutions.
//!
//! Near a fold an iteration converges badly, and beyond it not at all. But the solutions (q, s) of Φ(q, s) = 0 are a
//! smooth curve there, with the length of the arc as its parameter. Its tangent and Newton's correction orthogonal to a
//! direction d follow from the same two solutions of linear systems:
//!
//! ```text
//! u = −Φ_q⁻¹ Φ,   v = −Φ_q⁻¹ Φ_s,   z′ = ± (v, 1)/|(v, 1)|
//! δs = −(d_q·u)/(d_q·v + d_s),   δq = u + v δs
//! ```
//!
//! At a fold s′ changes its sign while the curve goes on (H. B. Keller, Numerical solution of bifurcation and nonlinear
//! eigenvalue problems, 1977). Beside the fold v is large, but its direction is accurate.

use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::planned::extrapolate::RefinedLimit;
use crate::planned::follower::PlanFollower;
use crate::planned::group_limit::LimitKind;
use crate::planned::lists::BranchValues;
use crate::planned::predict::weight;
use crate::planned::substeps::Blocked;
use crate::scalar::Scalar;
use crate::signal::{Instant, Signal};
use crate::workspace::{Array, Subset};

/// The first step and the longest one along the arc, on the scale on which angles count in radians.
const STEPS: [f64; 2] = [1e-6, 0.05];
/// Largest number of steps, and the distance along the arc within which a fold is looked for.
const MAX_STEPS: usize = 200;
const REACH: f64 = 0.5;
/// If only steps shorter than this are accepted, the solutions are no smooth curve.
const MIN_STEP: f64 = 1e-9;
/// Cosines of the angle between neighbouring tangents: below the first a step is rejected, above the second the next one
/// is longer.
const COSINES: [f64; 2] = [0.95, 0.99];
/// Largest correction, relative to the step, and that of the start.
const ALLOWED_CORRECTION: f64 = 0.1;
const START_CORRECTION: f64 = 1e-3;
/// Largest number of corrections; where they do not become smaller any more, they are due to rounding up to this length.
const CORRECTIONS: usize = 12;
const ROUNDING: f64 = 1e-8;
/// Shares of the speed of q with which s counts, which are tried in turn. With the first, the curve turns on the scale of
/// its distance from the fold; where this is the scale of rounding errors, it is straighter with a smaller one.
const SHARES_OF_S: [f64; 3] = [1.0, 1e-2, 1e-4];
/// Largest spacing of floating-point numbers near s, on the scale of the arc.
const SPACING_OF_S: f64 = 1e-10;
/// Width to which a fold is enclosed along the arc; the error of s is of the second order in it.
const ENCLOSED: f64 = 1e-10;
/// Largest number of trials for that, and the places between two ends that are tried in turn.
const TRIALS: usize = 60;
const TRIED_PLACES: [f64; 3] = [0.5, 0.4, 0.6];

/// The equations along a course.
trait CurveEquations<C> {
    /// u and v at q and s; `None` where they are not defined.
    fn directions(&mut self, q: &C, s: f64) -> Option<[C; 2]>;
}

/// The equations of a mechanism along a course.
struct CourseEquations<'a, M: Mechanism> {
    mechanism: &'a M,
    parameters: &'a [f64],
    course: &'a dyn Course,
}

impl<M: Mechanism> CurveEquations<M::Coordinates<f64>> for CourseEquations<'_, M> {
    fn directions(&mut self, q: &M::Coordinates<f64>, s: f64) -> Option<[M::Coordinates<f64>; 2]> {
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let t = self.course.at(s, inputs.as_mut());
        let at = Instant { t, inputs: inputs.as_ref() };
        let still = M::Coordinates::<f64>::filled(0.0);
        let mut work = M::workspace::<f64>();
        let subset = Subset { phi: true, phi_t: true, ..Subset::PHI };
        self.mechanism.evaluate_with(self.parameters, subset, &at, q.as_ref(), still.as_ref(), &mut work).ok()?;
        let (mut right, mut by_s) = (M::Rows::<f64>::filled(0.0), M::Rows::<f64>::filled(0.0));
        right.as_mut().iter_mut().zip(work.phi()).for_each(|(to, phi)| *to = -phi);
        by_s.as_mut().iter_mut().zip(work.phi_t()).for_each(|(to, phi_t)| *to = -phi_t);
        let mut factors = M::Factors::<f64>::filled(0.0);
        self.mechanism.factorise_with(self.parameters, &at, q.as_ref(), &mut factors).ok()?;
        if self.course.is_frozen() {
            // The contribution of time itself, which does not change.
            inputs.as_mut().iter_mut().for_each(|u| *u = Signal::constant(u.value));
            let at = Instant { t, inputs: inputs.as_ref() };
            let subset = Subset::TIME_DERIVATIVE;
            self.mechanism.evaluate_with(self.parameters, subset, &at, q.as_ref(), still.as_ref(), &mut work).ok()?;
            by_s.as_mut().iter_mut().zip(work.phi_t()).for_each(|(to, phi_t)| *to += phi_t);
        }
        let mut found = [still; 2];
        let [u, v] = &mut found;
        M::solve_factorised(&factors, right.as_ref(), u.as_mut()).ok()?;
        M::solve_factorised(&factors, by_s.as_ref(), v.as_mut()).ok()?;
        Some(found)
    }
}

/// A place on the curve: (q, s) and the tangent (q′, s′).
#[derive(Clone, Copy)]
struct ArcPoint<C> {
    q: C,
    s: f64,
    tangent: C,
    s_rate: f64,
}

/// The curve of solutions; its length is measured in radians, to which the weights convert the coordinates and s.
struct SolutionCurve<'a, C> {
    equations: &'a mut dyn CurveEquations<C>,
    weights: C,
    weight_of_s: f64,
}

impl<C: Array<f64>> SolutionCurve<'_, C> {
    /// The scalar product of two displacements (δq, δs).
    fn dot(&self, (a, a_s): (&C, f64), (b, b_s): (&C, f64)) -> f64 {
        let terms = a.as_ref().iter().zip(b.as_ref()).zip(self.weights.as_ref());
        let product = terms.map(|((a, b), weight)| (a * weight) * (b * weight)).sum::<f64>();
        product + (a_s * self.weight_of_s) * (b_s * self.weight_of_s)
    }

    /// The point of the curve to which corrections orthogonal to a direction lead from (q, s), each no longer than
    /// `allowed`; its tangent points in that direction.
    fn point(&mut self, (mut q, mut s): (C, f64), direction: (&C, f64), allowed: f64) -> Option<ArcPoint<C>> {
        let mut length = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let [mut step, v] = self.equations.directions(&q, s)?;
            let ds = -self.dot(direction, (&step, 0.0)) / self.dot(direction, (&v, 1.0));
            add(&mut step, ds, &v);
            add(&mut q, 1.0, &step);
            s += ds;
            let before = length;
            length = Scalar::sqrt(self.dot((&step, ds), (&step, ds)));
            // The comparison is written so that NaN is rejected.
            let is_near = length <= allowed;
            if !is_near {
                return None;
            }
            if length <= f64::EPSILON || length > 0.5 * before {
                break;
            }
        }
        if length > ROUNDING {
            return None;
        }
        let [_, mut tangent] = self.equations.directions(&q, s)?;
        let length = Scalar::sqrt(self.dot((&tangent, 1.0), (&tangent, 1.0)));
        let factor = 1.0_f64.copysign(self.dot((&tangent, 1.0), direction)) / length;
        tangent.as_mut().iter_mut().for_each(|x| *x *= factor);
        (factor.is_finite() && factor != 0.0).then_some(ArcPoint { q, s, tangent, s_rate: factor })
    }

    /// The point at this distance along the arc.
    fn advance(&mut self, from: &ArcPoint<C>, length: f64) -> Option<ArcPoint<C>> {
        let mut q = from.q;
        add(&mut q, length, &from.tangent);
        let direction = (&from.tangent, from.s_rate);
        self.point((q, from.s + length * from.s_rate), direction, ALLOWED_CORRECTION * length)
    }

    /// The first fold beyond (q, s), where s changes in the direction of this sign; and points before and after it. `share`
    /// is the weight of s relative to that at which q and s move equally fast.
    fn first_fold(&mut self, (q, s): (C, f64), (sign, share): (f64, f64)) -> Option<(ArcPoint<C>, [ArcPoint<C>; 2])> {
        let [_, mut tangent] = self.equations.directions(&q, s)?;
        let speed = Scalar::sqrt(self.dot((&tangent, 0.0), (&tangent, 0.0)));
        if !speed.is_finite() || speed == 0.0 {
            return None;
        }
        // Close to a fold q moves so fast that the rounding of s would be felt on its scale.
        self.weight_of_s = share * speed.min(SPACING_OF_S / (f64::EPSILON * s.abs()));
        tangent.as_mut().iter_mut().for_each(|x| *x *= sign);
        let mut here = self.point((q, s), (&tangent, sign), START_CORRECTION)?;
        let ([mut length, longest], mut travelled) = (STEPS, 0.0);
        for _ in 0..MAX_STEPS {
            let next = self.advance(&here, length);
            let cosine =
                next.as_ref().map_or(0.0, |next| self.dot((&here.tangent, here.s_rate), (&next.tangent, next.s_rate)));
            match next.filter(|_| cosine >= COSINES[0]) {
                Some(next) if next.s_rate * sign <= 0.0 => {
                    return Some((self.enclosed(&here, length, sign)?, [here, next]));
                }
                Some(next) => {
                    travelled += length;
                    here = next;
                    length = if cosine > COSINES[1] { longest.min(2.0 * length) } else { length };
                }
                None => length *= 0.5,
            }
            if length < MIN_STEP || travelled > REACH {
                break;
            }
        }
        None
    }

    /// The fold within this distance from a point.
    fn enclosed(&mut self, from: &ArcPoint<C>, length: f64, sign: f64) -> Option<ArcPoint<C>> {
        let (mut low, mut high, mut found) = (0.0, length, None);
        for _ in 0..TRIALS {
            if high - low <= ENCLOSED {
                break;
            }
            // At the fold itself the directions may not be defined.
            let tried = TRIED_PLACES.into_iter().find_map(|x| {
                let place = low + x * (high - low);
                Some((place, self.advance(from, place)?))
            });
            let (place, point) = tried?;
            *(if point.s_rate * sign > 0.0 { &mut low } else { &mut high }) = place;
            found = Some(point);
        }
        found
    }
}

/// Adds a multiple of a displacement.
fn add<C: Array<f64>>(to: &mut C, factor: f64, displacement: &C) {
    to.as_mut().iter_mut().zip(displacement.as_ref()).for_each(|(to, x)| *to += factor * x);
}

/// The longest arm of the rows at which bodies turn, from the entries of Φ_q for angles and those for lengths. All bodies
/// are turned by one radian from q, because all arms may pass through the pivots at a fold.
fn longest_arm<M: Mechanism>(mechanism: &M, parameters: &[f64], at: &Instant<'_>, mut q: M::Coordinates<f64>) -> f64 {
    let (model, still) = (M::model(), M::Coordinates::<f64>::filled(0.0));
    let turned = q.as_mut().iter_mut().zip(model.coordinates).filter(|(_, coordinate)| coordinate.kind.is_angle());
    turned.for_each(|(q, _)| *q += 1.0);
    let mut work = M::workspace::<f64>();
    if mechanism.evaluate_with(parameters, Subset::JACOBIAN, at, q.as_ref(), still.as_ref(), &mut work).is_err() {
        return 0.0;
    }
    let [mut of_angles, mut of_lengths] = [M::Rows::<f64>::filled(0.0); 2];
    for (&(row, k), entry) in model.constraint_pattern.entries.iter().zip(work.phi_q()) {
        let kind = model.coordinates[k].kind;
        let largest = if kind.is_angle() {
            &mut of_angles.as_mut()[row]
        } else if kind.is_length() {
            &mut of_lengths.as_mut()[row]
        } else {
            continue;
        };
        *largest = largest.max(entry.abs());
    }
    let arms = of_angles.as_ref().iter().zip(of_lengths.as_ref()).map(|(angle, length)| angle / length);
    arms.filter(|arm| arm.is_finite()).fold(0.0, f64::max)
}

/// Writes the weights that convert coordinates to radians: lengths count relative to the largest of q, now and where the
/// course began, or to the longest arm, since the coordinates of a platform may all be near 0, and so may that of a load at
/// the height of its pulley.
fn write_weights(model: &Model, [q, at_start]: [&[f64]; 2], arm: f64, weights: &mut [f64]) {
    let both = model.coordinates.iter().zip(q.iter().zip(at_start));
    let lengths = both.filter(|(coordinate, _)| coordinate.kind.is_length());
    let largest = lengths.fold(arm, |largest, (_, (q, at_start))| largest.max(q.abs()).max(at_start.abs()));
    for ((to, coordinate), q) in weights.iter_mut().zip(model.coordinates).zip(q) {
        *to = match coordinate.kind.is_length() {
            true if largest > 0.0 => 1.0 / largest,
            true => 0.0,
            false => weight(coordinate.kind, *q),
        };
    }
}

impl<M: Mechanism> PlanFollower<M> {
    /// The fold of a group beyond the last place that a walk has reached; `group` is its index. `None` where the motion
    /// does not turn back at a place at which this group first changes its sign.
    pub(super) fn fold(
        &self,
        mechanism: &M,
        course: &dyn Course,
        group: usize,
        blocked: &Blocked<M>,
    ) -> Option<RefinedLimit<M>> {
        let parameters = self.parameters.as_ref();
        let mut equations = CourseEquations { mechanism, parameters, course };
        let (mut weights, mut inputs) =
            (M::Coordinates::<f64>::filled(0.0), M::Inputs::<f64>::filled(Signal::constant(0.0)));
        let t = course.at(blocked.interval[0], inputs.as_mut());
        let arm = longest_arm(mechanism, parameters, &Instant { t, inputs: inputs.as_ref() }, blocked.state.q);
        write_weights(M::model(), [blocked.state.q.as_ref(), self.state().q.as_ref()], arm, weights.as_mut());
        let mut curve = SolutionCurve { equations: &mut equations, weights, weight_of_s: 0.0 };
        let ([start, end], place) = (course.ends(), (blocked.state.q, blocked.interval[0]));
        let sign = 1.0_f64.copysign(end - start);
        let (fold, sides) = SHARES_OF_S.into_iter().find_map(|share| curve.first_fold(place, (sign, share)))?;
        let mut branch_value = |point: &ArcPoint<M::Coordinates<f64>>| {
            let at = Instant { t: course.at(point.s, inputs.as_mut()), inputs: inputs.as_ref() };
            Some(BranchValues::<M>::at(mechanism, parameters, &at, point.q.as_ref()).ok()?.as_ref()[group])
        };
        let mode = self.branch.modes.as_ref()[group];
        let [before, after] = [branch_value(&sides[0])?, branch_value(&sides[1])?].map(|value| mode * value);
        let has_changed = before > 0.0 && after < 0.0;
        has_changed.then_some(RefinedLimit { s: fold.s, q: fold.q, error: 0.0, kind: Some(LimitKind::DeadCentre) })
    }
}
