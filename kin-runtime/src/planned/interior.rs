//! The branch of groups between the ends of a step.
//!
//! A group in closed form has two closures, whose distance is known from its margin. An iteration may have any number
//! of solutions, and a curve may bend between two straight parts, which the ends of a step do not show. Therefore the
//! branch values w of iterated groups are also evaluated between the ends, on the cubic through q and q̇ of both:
//!
//! ```text
//! q(s) = (2s³ − 3s² + 1) q₀ + (s³ − 2s² + s) h q̇₀ + (3s² − 2s³) q₁ + (s³ − s²) h q̇₁
//! ```

use super::inputs::write_inputs_within;
use super::lists::{BranchValues, Modes};
use crate::mechanism::{LengthError, Mechanism};
use crate::model::{Component, CoordinateKind, Model};
use crate::plan::StepKind;
use crate::scalar::Scalar;
use crate::scalar::compare::{Compare, least_or_nan};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Number of instants between the ends of a step at which branch values are evaluated.
pub(crate) const SAMPLES: u32 = 7;

/// Smallest w accepted between the ends, relative to the smaller one of both ends.
pub(crate) const MIN_INTERIOR_RATIO: f64 = 0.5;

/// Largest accepted deviation of the mean velocity in a step from the mean of the rates at its ends, relative to the
/// larger rate.
const SMOOTH: f64 = 0.25;

/// Error of a converged iteration, relative to the size of the coordinate plus a radian or the radius of its rows (see
/// [`of_coordinate`]).
const ROUNDING: f64 = 1e-10;

/// Instants within a step at which a motion is looked at, as fractions of its length. They are irregularly spaced: of a
/// function that repeats itself up to 200 times within the step, at least three of them are more than a tenth of a half
/// period away from its zeros. A random number from each seventh of the step was drawn until they had this property.
pub(crate) const IRREGULAR_FRACTIONS: [f64; 7] = [0.091, 0.2175, 0.3422, 0.4602, 0.5892, 0.7423, 0.9181];

/// The instants at which branch values are evaluated, as fractions of the step, evenly spaced.
pub(crate) fn even_fractions() -> impl Iterator<Item = f64> {
    (1..=SAMPLES).map(|sample| f64::from(sample) / f64::from(SAMPLES + 1))
}

/// Writes the configuration at the fraction s between the ends of a step of the length h; `ends` are q₀, q̇₀, q₁ and q̇₁.
pub(crate) fn on_cubic<V: Compare>(to: &mut [V], [q0, v0, q1, v1]: [&[V]; 4], h: f64, s: f64) {
    let rest = 1.0 - s;
    let shares = [rest * rest * (1.0 + 2.0 * s), h * s * rest * rest, s * s * (3.0 - 2.0 * s), -h * s * s * rest];
    let [a, b, c, d] = shares.map(V::from_f64);
    for (((to, q0), v0), (q1, v1)) in to.iter_mut().zip(q0).zip(v0).zip(q1.iter().zip(v1)) {
        *to = (a * *q0 + c * *q1) + (b * *v0 + d * *v1);
    }
}

/// Writes the slope of the cubic of [`on_cubic`] at the fraction s of the step.
#[cfg(feature = "std")]
pub(crate) fn slope_of_cubic(to: &mut [f64], [q0, v0, q1, v1]: [&[f64]; 4], h: f64, s: f64) {
    let rise = 6.0 * s * (1.0 - s) / h;
    let [first, last] = [1.0 + s * (3.0 * s - 4.0), s * (3.0 * s - 2.0)];
    for (((to, q0), v0), (q1, v1)) in to.iter_mut().zip(q0).zip(v0).zip(q1.iter().zip(v1)) {
        *to = rise * (q1 - q0) + first * v0 + last * v1;
    }
}

/// The time at the fraction s of a step of the length h that ends at the time t.
pub(crate) fn time_within<V: Scalar>(t: V, h: f64, s: V) -> V {
    t - (V::from_f64(1.0) - s) * V::from_f64(h)
}

/// A measure that is negative if a group with a determinant, or any group where rows in closed form turn, comes much
/// nearer to its limit within a step than at its ends, or has another sign there; a number instead of a Boolean, so that
/// batches can take the least over their lanes.
/// `at` is the instant of the end, and `from` are the inputs at the start.
#[cold]
#[inline(never)]
pub(crate) fn certainty_at_samples<M: Mechanism, V: Compare>(
    mechanism: &M,
    (parameters, from, at): (&[V], &[Signal<V>], &Instant<'_, V>),
    modes: &Modes<M, V>,
    ends: [&[V]; 4],
    h: f64,
) -> Result<V, LengthError> {
    let first_group = if M::CLOSED_ROWS_TURN { 0 } else { M::model().plan.modes.len() };
    let mut inputs = M::Inputs::<V>::filled(Signal::constant(V::from_f64(0.0)));
    let mut branch_values_at = |s: f64, q: &[V]| {
        let s = V::from_f64(s);
        write_inputs_within(inputs.as_mut(), [from, at.inputs], s, |x| x);
        let instant = Instant { t: time_within(at.t, h, s), inputs: inputs.as_ref() };
        BranchValues::at(mechanism, parameters, &instant, q)
    };
    let (first, last) = (branch_values_at(0.0, ends[0])?, branch_values_at(1.0, ends[2])?);
    let mut certainty = V::from_f64(1.0);
    let mut q = M::Coordinates::<V>::filled(V::from_f64(0.0));
    for s in even_fractions() {
        on_cubic(q.as_mut(), ends, h, s);
        let between = branch_values_at(s, q.as_ref())?;
        let branch_values = [first.as_ref(), between.as_ref(), last.as_ref()];
        certainty = least_or_nan(certainty, certainty_between(modes.as_ref(), branch_values, first_group));
    }
    Ok(certainty)
}

/// A measure that is negative if a group, from `first_group` on, is much nearer to its limit within a step than at both
/// ends, or on the other side of it; NaN if one of its branch values there is unknown. `branch_values` are those at the
/// beginning, in between and at the end.
pub(super) fn certainty_between<V: Compare>(modes: &[V], branch_values: [&[V]; 3], first_group: usize) -> V {
    let mut certainty = V::from_f64(1.0);
    for (group, mode) in modes.iter().enumerate().skip(first_group) {
        let [first, between, last] = branch_values.map(|list| *mode * list[group]);
        certainty = least_or_nan(certainty, between - V::from_f64(MIN_INTERIOR_RATIO) * first.least(last));
    }
    certainty
}

/// A measure that is negative if the unknowns of an iteration or, with `with_closed`, of any group that has a branch
/// value have not moved as their rates at both ends imply:
///
/// ```text
/// |q₁ − q₀ − ½ h (q̇₀ + q̇₁)| ≤ ¼ |h| max(|q̇₀|, |q̇₁|)
/// ```
///
/// The left side is of third order in h. For lengths the largest left side is compared with the largest right side, and
/// likewise for angles; every scalar is compared alone.
#[cold]
#[inline(never)]
pub(crate) fn certainty_of_rates<V: Compare>(
    model: &Model,
    with_closed: bool,
    (ends, turns): ([&[V]; 4], &[V]),
    h: f64,
) -> V {
    let (plan, coordinates) = (&model.plan, model.coordinates);
    let has_sign = |index: usize| plan.modes.iter().chain(plan.orientations).any(|group| group.step == index);
    let mut certainty = V::from_f64(1.0);
    for (index, step) in plan.steps.iter().enumerate() {
        let unknowns = match step.kind {
            StepKind::Newton(unknowns) => unknowns,
            _ if with_closed && has_sign(index) => usize::MAX,
            _ => continue,
        };
        let (mut lengths, mut angles) = ([V::from_f64(0.0); 2], [V::from_f64(0.0); 2]);
        for &(k, _) in step.coordinates.iter().take(unknowns) {
            let kind = coordinates[k].kind;
            let [allowed, difference] = of_coordinate(kind, ends.map(|numbers| numbers[k]), turns[k], h);
            match kind {
                CoordinateKind::Scalar => certainty = certainty.least(allowed - difference),
                CoordinateKind::Pose { component: Component::Phi, .. } => {
                    angles = [angles[0].greatest(allowed), angles[1].greatest(difference)];
                }
                CoordinateKind::Pose { .. } => {
                    lengths = [lengths[0].greatest(allowed), lengths[1].greatest(difference)];
                }
            }
        }
        let least = V::from_f64(1e-300);
        certainty = certainty.least(lengths[0] + least - lengths[1]).least(angles[0] + least - angles[1]);
    }
    certainty
}

/// The largest deviation of a coordinate that is allowed, and the one found.
#[inline(never)]
fn of_coordinate<V: Compare>(kind: CoordinateKind, [first, v0, last, v1]: [V; 4], turn: V, h: f64) -> [V; 2] {
    let difference = (last - first - V::from_f64(0.5 * h) * (v0 + v1)).abs();
    let motion = V::from_f64(h.abs()) * v0.abs().greatest(v1.abs());
    // The coordinate may be 0, so a reference is added: a radian for an angle, otherwise the radius of its rows, which
    // is the displacement by which a gradient turns by one radian.
    let radius = match kind {
        CoordinateKind::Pose { component: Component::Phi, .. } => V::from_f64(1.0),
        _ => turn / (turn * turn + V::from_f64(1e-300)),
    };
    let rounding = V::from_f64(ROUNDING) * (last.abs() + radius + V::from_f64(1e-300));
    [V::from_f64(SMOOTH) * motion + rounding, difference]
}

#[cfg(test)]
mod tests {
    use super::{IRREGULAR_FRACTIONS, certainty_between, certainty_of_rates, even_fractions, of_coordinate, on_cubic};
    use crate::model::{Component, CoordinateKind};

    #[test]
    fn a_cubic_is_met_everywhere() {
        let at = |t: f64| 0.3 + t * (0.5 - t * (0.7 + 0.2 * t));
        let rate = |t: f64| 0.5 - t * (1.4 + 0.6 * t);
        for h in [0.4, -1.5] {
            for s in even_fractions().chain([0.0, 1.0]) {
                let mut q = [f64::NAN];
                on_cubic(&mut q, [&[at(0.1)], &[rate(0.1)], &[at(0.1 + h)], &[rate(0.1 + h)]], h, s);
                assert!((q[0] - at(0.1 + s * h)).abs() < 1e-14, "{h} {s}");
            }
        }
        let all: Vec<f64> = even_fractions().collect();
        assert!(all.len() == 7 && all[0] == 0.125 && all[6] == 0.875);
    }

    #[test]
    fn fractions_leave_no_wide_gap_and_have_no_common_period() {
        let all: Vec<f64> = [0.0].into_iter().chain(IRREGULAR_FRACTIONS).chain([1.0]).collect();
        assert!(all.windows(2).all(|pair| (0.06..0.18).contains(&(pair[1] - pair[0]))), "{all:?}");
        // The zeros of a function that has n half periods in the step are at the multiples of 1/n.
        for n in 1..=400 {
            let phases = IRREGULAR_FRACTIONS.map(|fraction| (f64::from(n) * fraction).fract());
            let far = phases.iter().filter(|phase| (0.1..0.9).contains(*phase)).count();
            assert!(far >= 3, "{n}: {phases:?}");
        }
    }

    const PHI: CoordinateKind = CoordinateKind::Pose { body: 0, component: Component::Phi };
    const X: CoordinateKind = CoordinateKind::Pose { body: 0, component: Component::X };

    /// Whether the unknown has moved as its rates imply.
    fn is_smooth(kind: CoordinateKind, ends: [f64; 4], turn: f64, h: f64) -> bool {
        let [allowed, difference] = of_coordinate::<f64>(kind, ends, turn, h);
        difference <= allowed
    }

    #[test]
    fn a_motion_that_its_rates_do_not_tell_is_none() {
        for kind in [PHI, X, CoordinateKind::Scalar] {
            for h in [2.0, -2.0] {
                // With the rates 1 and 1.4 the motion may be 1.2 h ± a quarter of 1.4 h.
                let moved = |share: f64| is_smooth(kind, [5.0, 1.0, 5.0 + share * h, 1.4], 0.0, h);
                assert!(moved(1.2) && moved(1.549) && moved(0.851) && !moved(1.551) && !moved(0.849), "{h}");
                // From rest with a jerk j: the rate is ½ j h², the motion j h³/6.
                assert!(is_smooth(kind, [0.0, 0.0, h * h * h / 6.0, 0.5 * h * h], 0.0, h));
            }
        }
        assert!(!is_smooth(PHI, [0.0, f64::NAN, 0.0, 0.0], 0.0, 1.0));
    }

    #[test]
    fn rounding_is_no_motion() {
        // At 0 the reference is a radian for angles, and the radius 1/turn for other coordinates.
        assert!(
            is_smooth(PHI, [0.0, 0.0, 9e-11, 0.0], 0.0, 1.0) && !is_smooth(PHI, [0.0, 0.0, 1.1e-10, 0.0], 0.0, 1.0)
        );
        assert!(is_smooth(X, [0.0, 0.0, 4e-11, 0.0], 2.0, 1.0) && !is_smooth(X, [0.0, 0.0, 6e-11, 0.0], 2.0, 1.0));
        assert!(
            is_smooth(X, [7.0, 0.0, 7.0 + 6e-10, 0.0], 0.0, 1.0)
                && !is_smooth(X, [7.0, 0.0, 7.0 + 8e-10, 0.0], 0.0, 1.0)
        );
    }

    #[test]
    fn a_group_may_come_half_as_near_to_its_limit_as_at_the_ends() {
        let of = |between: f64, first_group: usize| {
            certainty_between(&[1.0, -1.0], [&[0.3, -0.4], &[0.3, between], &[0.3, -0.6]], first_group)
        };
        assert!(of(-0.21, 0) > 0.0 && of(-0.19, 0) < 0.0 && of(0.5, 0) < 0.0);
        // What is unknown is not certain, unless the group does not count.
        assert!(of(f64::NAN, 0).is_nan() && of(f64::NAN, 1).is_nan() && of(f64::NAN, 2) > 0.0);
        assert!(certainty_between(&[f64::NAN], [&[0.3], &[0.3], &[0.3]], 0).is_nan());
    }

    /// Without an iteration only groups in closed form can be compared.
    #[test]
    fn a_plan_without_iterations_is_certain() {
        use crate::Mechanism;
        let model = crate::fixture::PlannedFourBar::model();
        let (zeros, ones) = ([0.0; 9], [1.0; 9]);
        let ends: [&[f64]; 4] = [&zeros, &zeros, &ones, &zeros];
        assert_eq!(1.0, certainty_of_rates::<f64>(model, false, (ends, &zeros), 1.0));
        assert!(certainty_of_rates::<f64>(model, true, (ends, &zeros), 1.0) < 0.0);
    }
}
