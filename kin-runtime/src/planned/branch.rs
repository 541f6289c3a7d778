//! The branch of a configuration, and the check whether a step has stayed on it.
//!
//! A branch is identified by one sign per group: that of its closure, where the group closes in two ways, or that of
//! the determinant of the group's system, where it is solved by iteration or is a linear system that is singular for
//! some configurations ([`Plan::signs`]). The number w that has this sign is the *branch value* of the group. Its size
//! is the distance of the group from the configuration at which its sign changes, 0 where both closures meet and at most
//! 1, and is read from the margin without another evaluation:
//!
//! ```text
//! distance = √margin ≤ about |w|
//! ```
//!
//! (The two differ where a divisor of the group is small, for example where its outer pins coincide, and for iterations,
//! whose margin is the smaller of two measures.)
//!
//! Along a smooth motion w is smooth, and it changes no faster than bodies turn. A step has stayed on its branch if
//! every group is too far from its limit to have reached it within the step ([`OUT_OF_REACH`]), or if w at its end
//! agrees with the prediction, in a step so short that the error of the prediction is much smaller than w
//! ([`resolves`]). If neither holds, the step is too long. At a fold or at a crossing of branches no step is short
//! enough, and the motion ends.

use super::lists::{Distances, Modes};
use super::mode_changes::DIPPING_VALUE;
use crate::mechanism::Mechanism;
use crate::scalar::compare::Compare;

/// Largest deviation of w from its prediction, relative to the smaller of the two.
const EXPECTED: f64 = 0.5;

/// A group farther from its limit than this factor times `turn` cannot reach the limit in one step. `turn` is the
/// largest rotation of a body, in radians, by velocity or by acceleration alone; 4 stands for two bodies that turn
/// towards one another, by both terms.
pub(crate) const OUT_OF_REACH: f64 = 4.0;

/// Above this margin neither a single state nor a set of a batch that takes its step together with others needs the
/// checks of the scalar follower.
#[cfg(any(feature = "std", all(feature = "alloc", feature = "simd")))]
pub(crate) const FAR_FROM_LIMITS: f64 = 1e-2;

/// Estimate of the third-order term that the prediction omits: this factor times the cube of the turn.
const THIRD_ORDER: f64 = 10.0;

/// The branch of a motion: its modes, and the distances of its groups from their limits.
pub(crate) struct Branch<M: Mechanism> {
    pub(crate) modes: Modes<M>,
    pub(crate) distances: Distances<M>,
}

impl<M: Mechanism> Clone for Branch<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Branch<M> {}

/// A measure of the agreement of w with its prediction; negative where they disagree.
#[inline(always)]
pub(crate) fn certainty_of<V: Compare>(now: V, predicted: V) -> V {
    V::from_f64(EXPECTED) * now.least(predicted) - (now - predicted).abs()
}

/// The distance of the nearest group from its limit minus the error of a prediction over this turn; a step resolves its
/// branch where this is not negative.
#[inline(always)]
pub(crate) fn resolves<V: Compare>(nearest: V, turn: V) -> V {
    nearest - V::from_f64(THIRD_ORDER) * turn * turn * turn
}

/// The first group whose w does not have the sign of its mode, or does not agree with its prediction.
pub(super) fn first_uncertain(modes: &[f64], foretold: &[f64], found: &[f64]) -> Option<usize> {
    let on_branch = |group: usize| {
        let now = modes[group] * found[group];
        now > 0.0 && certainty_of(now, modes[group] * foretold[group]) >= 0.0
    };
    (0..modes.len()).find(|group| !on_branch(*group))
}

/// True if a group may have reached its limit and returned within a step. The arguments are its distances at both ends.
const fn may_dip(before: f64, after: f64) -> bool {
    before < DIPPING_VALUE || after < DIPPING_VALUE
}

/// [`may_dip`] for any group.
pub(crate) fn may_have_touched_limit(before: &[f64], after: &[f64]) -> bool {
    before.iter().zip(after).any(|(before, after)| may_dip(*before, *after))
}

/// Smallest w of a group within a step, with the sign that it has at the start, relative to the smaller |w| at both
/// ends.
const MIN_RATIO_WITHIN: f64 = 0.25;

/// The first group that comes much nearer to its limit within a step than at its ends, of those that may have reached
/// it. The arguments are w at both ends, and as predicted in the middle; between them w is the parabola through the
/// three, so that a w that touches 0 is found at any place of the step. Groups whose mode has changed do not count: with
/// redundant rows a motion may pass limits of the rows that the plan uses, and w changes its sign within the step.
pub(crate) fn first_dip(
    [before, after]: [&[f64]; 2],
    middle: &[f64],
    [modes, modes_before]: [&[f64]; 2],
) -> Option<usize> {
    let dips = |group: usize| {
        let middle_value = if before[group] < 0.0 { -middle[group] } else { middle[group] };
        let ends = [before[group].abs(), after[group].abs()];
        let stays = least_of_parabola(ends, middle_value) >= MIN_RATIO_WITHIN * ends[0].min(ends[1]);
        !stays
    };
    let near = |group: &usize| may_dip(before[*group].abs(), after[*group].abs());
    (0..modes.len()).filter(near).find(|&group| dips(group) && modes[group] == modes_before[group])
}

/// The least value between two places of the parabola with these values at them and in the middle; NaN if one of them is.
fn least_of_parabola([before, after]: [f64; 2], middle: f64) -> f64 {
    let (slope, bend) = (0.5 * (after - before), 0.5 * (before + after) - middle);
    if slope.abs() < 2.0 * bend {
        middle - 0.25 * slope * slope / bend
    } else if middle.is_nan() {
        middle
    } else {
        before.min(after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_predicted_is_certain_up_to_half_of_the_smaller_one() {
        for (now, predicted) in [(0.2, 0.3), (0.3, 0.2), (0.4, 0.59), (0.59, 0.4), (-0.01, -0.01 + 1e-9)] {
            let is_near = f64::abs(now - predicted) <= 0.5 * f64::min(now, predicted);
            assert_eq!(is_near, certainty_of::<f64>(now, predicted) >= 0.0, "{now} {predicted}");
        }
        for (now, predicted) in [(0.2, 0.31), (0.31, 0.2), (0.2, -0.2), (-0.2, 0.2), (0.2, 0.01), (f64::NAN, 0.2)] {
            let is_certain = certainty_of::<f64>(now, predicted) >= 0.0;
            assert!(!is_certain, "{now} {predicted}");
        }
    }

    #[test]
    fn a_step_resolves_what_its_third_order_term_cannot_reach() {
        for turn in [0.01, 0.1, 0.3_f64] {
            let error = 10.0 * turn.powi(3);
            assert!(resolves(1.001 * error, turn) > 0.0 && resolves(0.999 * error, turn) < 0.0, "{turn}");
        }
        assert_eq!(0.2, resolves(0.2, 0.0));
    }

    #[test]
    fn a_group_that_is_close_at_either_end_may_have_been_at_its_limit() {
        assert!(may_dip(0.149, 0.9) && may_dip(0.9, 0.149) && may_dip(0.1, 0.1));
        assert!(!may_dip(0.151, 0.151));
        assert!(may_have_touched_limit(&[0.9, 0.1], &[0.9, 0.2]) && may_have_touched_limit(&[0.9, 0.9], &[0.1, 0.9]));
        assert!(!may_have_touched_limit(&[0.9, 0.2], &[0.2, 0.9]) && !may_have_touched_limit(&[], &[]));
    }

    #[test]
    fn the_first_group_off_its_branch_is_named() {
        let of = |found: [f64; 3]| first_uncertain(&[1.0, -1.0, 1.0], &[0.5, -0.5, 0.5], &found);
        assert_eq!(None, of([0.5, -0.4, 0.6]));
        // The wrong sign, too far from the prediction, undecided.
        assert_eq!([Some(0), Some(1), Some(2)], [[-0.5, 0.5, 0.5], [0.5, -0.2, 0.5], [0.5, -0.5, f64::NAN]].map(of));
    }

    #[test]
    fn the_least_of_a_parabola_is_at_its_vertex_or_at_an_end() {
        let of = |a: f64, b: f64, c: f64| [-1.0, 1.0, 0.0].map(|x: f64| a + x * (b + x * c));
        for (a, b, c, least) in [
            (0.3, 0.0, 0.2, 0.3),
            (0.3, 0.2, 0.4, 0.275),
            (0.3, -0.2, 0.4, 0.275),
            (0.3, 0.2, 0.09, 0.19),
            (0.3, -0.2, 0.09, 0.19),
            (0.5, 0.1, -0.2, 0.2),
        ] {
            let [before, after, middle] = of(a, b, c);
            assert!((least_of_parabola([before, after], middle) - least).abs() < 1e-15, "{a} {b} {c}");
        }
        assert!(least_of_parabola([0.1, 0.2], f64::NAN).is_nan());
    }

    /// Group 1 is close at its start and group 2 at its end, group 0 at neither.
    #[test]
    fn a_dip_within_a_step_counts_for_close_groups_that_keep_their_mode() {
        let ends = [&[0.5, -0.1, 0.4][..], &[0.5, -0.3, 0.12]];
        let of = |middle: [f64; 3], now: [f64; 3]| first_dip(ends, &middle, [&now, &[1.0, -1.0, 1.0]]);
        let kept = [1.0, -1.0, 1.0];
        assert_eq!(None, of([0.0, -0.041, 0.055], kept));
        assert_eq!([Some(1), Some(2)], [[0.5, -0.040, 0.055], [0.5, -0.2, 0.053]].map(|middle| of(middle, kept)));
        assert_eq!(Some(2), of([0.5, -0.2, f64::NAN], kept));
        // The other sign in the middle.
        assert_eq!(Some(1), of([0.5, 0.2, 0.2], kept));
        assert_eq!([None, Some(2)], [0.055, 0.053].map(|middle| of([0.5, 0.0, middle], [1.0, 1.0, 1.0])));
    }
}
