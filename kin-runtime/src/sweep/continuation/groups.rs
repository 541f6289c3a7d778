//! The branch value of every group of the plan, for configurations found by full Newton.
//!
//! Configurations found here satisfy the same conditions as solutions by the plan do in
//! [`planned::branch`](crate::planned::branch): each group stays on its own side of the configuration where its two
//! closures meet, and its distance from there is about the predicted one. One sign for the whole mechanism would not
//! suffice: if two groups change their branch in one step, the sign of the determinant of Φ_q stays the same.

use crate::equations::Equations;
use crate::planned::branch::{OUT_OF_REACH, certainty_of, first_dip, may_have_touched_limit, resolves};
use crate::planned::gradient_turns::stays_in_bends;
use crate::planned::inputs::write_inputs_within;
use crate::planned::interior::{MIN_INTERIOR_RATIO, even_fractions, on_cubic, time_within};
use crate::planned::parts::Span;
use crate::planned::predict::weight;
use crate::scalar::{Interval, Scalar};
use crate::signal::{Instant, Signal};

/// Size of a branch value below which rounding no longer allows a group to be assigned to either closure.
const MIN_BRANCH_VALUE: f64 = 1e-6;

/// Largest difference between a prediction and the configuration found, relative to the distance of the nearest other
/// solution.
const MAX_PREDICTION_ERROR: f64 = 0.5;

/// With redundant rows the motion may pass a limit of a group. `MAX_PASSING_DEVIATION` is the largest deviation of the
/// group's branch value from its prediction, relative to the larger of the two; `UNCHECKED_DEVIATION` is the size below
/// which the deviation is not checked.
const MAX_PASSING_DEVIATION: f64 = 0.5;
const UNCHECKED_DEVIATION: f64 = 1e-3;

/// The largest angle by which a displacement, or a rate, turns a body at q, in radians.
///
/// Where branch values and the turns of rows show how far the groups are from their limits, lengths do not count: a
/// solution may go to infinity, in steps as long as the way to it. Otherwise lengths count by the size of the
/// mechanism, except those that only rows of velocity level contain: a vehicle may go far, and the error of its
/// integration limits the steps.
pub(super) fn turn_of_bodies(equations: &Equations<'_>, q: &[f64], displacement: &[f64]) -> f64 {
    let plan = &equations.model.plan;
    if equations.given() > 0 || !plan.exists() || plan.has_redundant_rows() {
        if (0..equations.rows()).all(|row| equations.holonomic(row)) {
            return equations.scale.turn(displacement);
        }
        let mut counted = displacement.to_vec();
        for (k, (x, coordinate)) in counted.iter_mut().zip(equations.model.coordinates).enumerate() {
            let mut rows = equations.entries().filter(|((_, column), _)| *column == k).map(|((row, _), _)| row);
            if coordinate.kind.is_length() && !rows.any(|row| equations.holonomic(row)) {
                *x = 0.0;
            }
        }
        return equations.scale.turn(&counted);
    }
    let coordinates = equations.model.coordinates.iter().zip(q).zip(displacement);
    coordinates.fold(0.0, |most, ((coordinate, q), x)| f64::max(most, weight(coordinate.kind, *q) * x.abs()))
}

/// True if every group has stayed on its branch. The arguments are the branch values at the previous configuration, at
/// the prediction and at the configuration found.
///
/// A group whose branch value is NaN at all three has none, because the plan divides by a dimension that is 0; it is
/// ignored.
///
/// With redundant rows a group of the rows used by the plan may reach a limit that the mechanism as a whole passes.
/// Then only the deviation from the prediction is checked, and values below [`UNCHECKED_DEVIATION`] may have either
/// sign.
pub(super) fn stay([before, predicted, found]: [&[f64]; 3], turn: f64, is_redundant: bool) -> bool {
    before.iter().zip(predicted).zip(found).all(|((before, predicted), found)| {
        if [before, predicted, found].iter().all(|w| w.is_nan()) {
            return true;
        }
        if is_redundant {
            let size = found.abs().max(predicted.abs());
            return (found - predicted).abs() <= MAX_PASSING_DEVIATION * size || size <= UNCHECKED_DEVIATION;
        }
        let sign = before.signum();
        let nearest = f64::min(sign * found, sign * before);
        sign * found > MIN_BRANCH_VALUE
            && (nearest >= OUT_OF_REACH * turn || resolves(nearest, turn) >= 0.0)
            && certainty_of(sign * found, sign * predicted) >= 0.0
    })
}

/// True if a step cannot have led to another solution, where branch values do not show that: with prescribed
/// coordinates, without a plan, or where the plan divides by 0. `distance` is the smaller reciprocal of the condition
/// of the scaled Φ_q at both ends, which is no larger than the angle between two solutions that meet where Φ_q is
/// singular; `correction` is the difference between the prediction and the configuration found.
///
/// The sign of a determinant alone does not suffice: it stays where two pairs of solutions meet at once.
pub(super) fn stay_apart(distance: f64, turn: f64, correction: f64) -> bool {
    distance >= OUT_OF_REACH * turn || resolves(distance, turn) >= 0.0 && correction <= MAX_PREDICTION_ERROR * distance
}

/// True if a group comes much nearer to its limit within a step than at its ends, at which the branch values are
/// `before` and `found`: it may have reached the limit and returned.
pub(super) fn dip_between(equations: &Equations<'_>, [before, found]: [&[f64]; 2], span: Span<'_>) -> bool {
    let distances = [before, found].map(|values| values.iter().map(|w| w.abs()).collect::<Vec<f64>>());
    if !may_have_touched_limit(&distances[0], &distances[1]) {
        return false;
    }
    let (mut q, mut middle) = (vec![0.0; equations.coordinates()], vec![0.0; before.len()]);
    let at = equations.instant();
    on_cubic(&mut q, span.ends, span.h, 0.5);
    let mut inputs = vec![Signal::constant(0.0); at.inputs.len()];
    write_inputs_within(&mut inputs, [span.inputs, at.inputs], 0.5, f64::from);
    let instant = Instant { t: time_within(at.t, span.h, 0.5), inputs: &inputs };
    if equations.system.branches(&instant, &q, &mut middle).is_err() {
        return true;
    }
    let modes: Vec<f64> = before.iter().map(|w| w.signum()).collect();
    first_dip([before, found], &middle, [&modes; 2]).is_some()
}

/// True if no group whose branch value must be looked at within a step comes much nearer to its limit there than at the
/// ends, at which the branch values are `before` and `found`.
pub(super) fn stay_between(equations: &Equations<'_>, [before, found]: [&[f64]; 2], span: Span<'_>) -> bool {
    let iterated = if equations.system.closed_rows_turn() { 0 } else { equations.model.plan.modes.len() };
    if before.len() <= iterated {
        return true;
    }
    let (mut q, mut groups) = (vec![0.0; equations.coordinates()], vec![0.0; before.len()]);
    let at = equations.instant();
    let ends = [span.inputs, at.inputs];
    let mut stays_at = |s: f64| {
        on_cubic(&mut q, span.ends, span.h, s);
        let mut inputs = vec![Signal::constant(0.0); at.inputs.len()];
        write_inputs_within(&mut inputs, ends, s, f64::from);
        let instant = Instant { t: time_within(at.t, span.h, s), inputs: &inputs };
        if equations.system.branches(&instant, &q, &mut groups).is_err() {
            return false;
        }
        let mut all = groups.iter().zip(before).zip(found).skip(iterated);
        all.all(|((w, before), found)| {
            let sign = before.signum();
            before.is_nan() || sign * w >= MIN_INTERIOR_RATIO * f64::min(sign * before, sign * found)
        })
    };
    let is_curved = equations.system.iterates_on_curves();
    if (!is_curved || equations.system.closed_rows_turn()) && !even_fractions().all(&mut stays_at) {
        return false;
    }
    if !is_curved {
        return true;
    }
    let buffers = [(); 2].map(|()| vec![Interval::ZERO; span.ends[0].len()]);
    let [mut box_of_part, mut turns] = buffers;
    let mut turns_over = |place: Interval, part: &[Interval], turns: &mut [Interval]| {
        let mut inputs = vec![Signal::constant(Interval::ZERO); at.inputs.len()];
        write_inputs_within(&mut inputs, ends, place, Interval::from_f64);
        let t = time_within(Interval::from_f64(at.t), span.h, place);
        equations.system.turns_over(&Instant { t, inputs: &inputs }, part, turns)
    };
    let rotation = equations.options.max_rotation_per_step;
    let buffers = [&mut box_of_part[..], &mut turns[..]];
    stays_in_bends(span, rotation, buffers, &mut turns_over, &mut |s| Ok(stays_at(s))).unwrap_or(false)
}

/// The smallest size of a branch value, at most 1.
pub(super) fn nearest(groups: &[f64]) -> f64 {
    groups.iter().fold(1.0, |least, w| f64::min(least, w.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a group stays on its branch from `before` over `predicted` to `found`, for either sign, with redundant
    /// rows or without.
    fn stays([before, predicted, found]: [f64; 3], turn: f64, is_redundant: bool) -> bool {
        let answers = [1.0, -1.0].map(|sign| {
            // A second group, far from all limits, must not change the result.
            let of = |w: f64| [sign * w, -50.0];
            stay([&of(before), &of(predicted), &of(found)], turn, is_redundant)
        });
        assert_eq!(answers[0], answers[1]);
        answers[0]
    }

    #[test]
    fn a_group_stays_on_its_side_and_where_it_was_predicted() {
        let of = |before, predicted, found| stays([before, predicted, found], 0.01, false);
        assert!(of(0.5, 0.5, 0.5));
        assert!(!of(0.5, 0.5, -0.5) && !of(0.5, -0.5, -0.5) && !of(-0.5, 0.5, 0.5) && !of(0.5, -0.5, 0.5));
        // The smallest accepted ratio of the found and the predicted value is one half.
        assert!(of(0.5, 0.3, 0.2) && of(0.5, 0.2, 0.3) && !of(0.5, 0.31, 0.2) && !of(0.5, 0.2, 0.31));
        // One group that leaves its branch suffices for a refusal.
        assert!(!stay([&[0.5, 0.5], &[0.5, 0.5], &[0.5, -0.5]], 0.01, false));
        let nan = f64::NAN;
        assert!(!stay([&[0.5], &[0.5], &[nan]], 0.01, false) && !stay([&[0.5], &[nan], &[0.5]], 0.01, false));
        assert!(!stay([&[nan], &[0.5], &[0.5]], 0.01, false) && !stay([&[nan], &[nan], &[0.5]], 0.01, false));
        // A group without branch values does not hide that another one changes its branch.
        assert!(stay([&[nan]; 3], 0.01, false) && stay([&[nan]; 3], 0.01, true));
        assert!(!stay([&[nan, 0.5], &[nan, 0.5], &[nan, -0.5]], 0.01, false));
    }

    #[test]
    fn rounding_does_not_tell_on_which_side_a_group_is() {
        assert!(stays([0.5, 1.01e-6, 1.01e-6], 0.0, false) && !stays([0.5, 0.99e-6, 0.99e-6], 0.0, false));
    }

    /// Either the group is more than four times the turn of the step away from its limit, or the step is short enough
    /// to resolve the limit.
    #[test]
    fn a_step_that_turns_too_far_for_its_groups_does_not_count() {
        // For these turns, 10 turn³ is less than 4 turn.
        for (turn, least) in [(0.1, 0.01), (0.3, 0.27)] {
            for (factor, counts) in [(1.01, true), (0.99, false)] {
                let near: f64 = factor * least;
                assert_eq!(counts, stays([near, near, near], turn, false), "{turn} {factor}");
                // The distance counts at both ends of the step.
                assert_eq!(counts, stays([0.9, 1.2 * near, near], turn, false), "{turn} {factor}");
                assert_eq!(counts, stays([near, 1.2 * near, 1.4 * near], turn, false), "{turn} {factor}");
            }
        }
        // For larger turns 10 turn³ exceeds 4 turn.
        assert!(stays([0.9; 3], 0.22, false) && stays([4.1; 3], 1.0, false) && !stays([3.9; 3], 1.0, false));
    }

    /// With redundant rows the motion may pass limits of a group: its sign may change where the prediction changes
    /// sign.
    #[test]
    fn with_redundant_rows_a_group_changes_its_sign_where_it_was_predicted() {
        let of = |before, predicted, found| stays([before, predicted, found], 0.01, true);
        assert!(of(0.1, -0.1, -0.1) && of(0.1, 0.1, 0.1) && !of(0.1, 0.1, -0.1) && !of(0.1, -0.1, 0.1));
        // The deviation may be half of the larger value.
        assert!(of(0.1, 0.2, 0.101) && of(0.1, 0.101, 0.2) && !of(0.1, 0.2, 0.099) && !of(0.1, 0.099, 0.2));
        // Values below `UNCHECKED_DEVIATION` may have either sign.
        assert!(of(0.1, 0.99e-3, -0.99e-3) && of(0.1, -0.99e-3, 0.99e-3));
        assert!(!of(0.1, 1.01e-3, -0.5e-3) && !of(0.1, 0.5e-3, -1.01e-3));
        assert!(!of(0.1, f64::NAN, 0.1) && !of(0.1, 0.1, f64::NAN));
    }

    #[test]
    fn the_nearest_group_is_the_one_with_the_smallest_number() {
        assert_eq!([0.2, 0.2, 1.0, 1.0], [nearest(&[0.5, -0.2]), nearest(&[0.2, 0.9]), nearest(&[]), nearest(&[-7.0])]);
    }
}
