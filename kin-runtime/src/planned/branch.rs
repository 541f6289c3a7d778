//! On which branch a configuration is, and whether a step has stayed on it.
//!
//! A branch is told by signs, one per group: that of its closure, where the group closes in two ways, and that of the
//! determinant of its own small system, where it is solved by iteration ([`Plan::signs`]). With
//!
//! ```text
//! |w| = √margin
//! ```
//!
//! every group has a distance from where its sign changes: 0 where both closures meet, at most 1. Along a smooth motion
//! w is smooth, and it changes no faster than bodies turn. A step has stayed on its branch where every group is too far
//! from its limit to have come there ([`OUT_OF_REACH`]), or where w at its end is what the prediction has, in a step so
//! short that the error of the prediction is much smaller than w ([`resolves`]). A step for which neither is so is too
//! long; at a fold or at a crossing of branches no step is short enough, and the motion ends.

use super::passed::CLOSE;
use crate::plan::Plan;
use crate::scalar::compare::Compare;

/// Deviation of w from its prediction, relative to the smaller of the two, up to which a step has stayed on its branch.
const EXPECTED: f64 = 0.5;

/// Distances, in turns of the fastest body by velocity or acceleration alone, over which no group comes to its limit in a
/// step: two bodies that turn towards one another, by both.
pub(crate) const OUT_OF_REACH: f64 = 4.0;

/// The third-order term that the prediction leaves out, in the cube of the turn.
const THIRD_ORDER: f64 = 10.0;

/// Where a motion is on its branch; each list has a number for every sign of the plan.
#[derive(Clone, Copy)]
pub(crate) struct Branch<A> {
    /// ±1.
    pub(crate) signs: A,
    /// |w|.
    pub(crate) distances: A,
}

/// Writes |w| of every group; gives the smallest.
#[inline(always)]
pub(crate) fn distances<V: Compare>(plan: &Plan, margins: &[V], distances: &mut [V]) -> V {
    let mut least = V::from_f64(1.0);
    for (sign, distance) in distances.iter_mut().take(plan.signs()).enumerate() {
        let Some(margin) = plan.margin_of_sign(sign) else { continue };
        *distance = margins[margin].abs().sqrt();
        least = least.least(*distance);
    }
    least
}

/// How certain it is that w is what was predicted: not at all for less than 0.
#[inline(always)]
pub(crate) fn certainty_of<V: Compare>(now: V, predicted: V) -> V {
    V::from_f64(EXPECTED) * now.least(predicted) - (now - predicted).abs()
}

/// By how much the distance of the nearest group exceeds the error of a prediction that turns by so much: a step resolves
/// its branch where this is not negative.
#[inline(always)]
pub(crate) fn resolves<V: Compare>(nearest: V, turn: V) -> V {
    nearest - V::from_f64(THIRD_ORDER) * turn * turn * turn
}

/// Distances of the ends of a step below which a group may have come to its limit and back within the step.
pub(super) const fn may_dip(before: f64, after: f64) -> bool {
    before < CLOSE || after < CLOSE
}
