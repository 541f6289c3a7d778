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
//! w is smooth. So a step has stayed on its branch where w at its end is where w before lets one expect it, well on the
//! same side of 0. A step for which that is not certain is too long; at a fold or at a crossing of branches no step is
//! short enough, and the motion ends.

use super::passed::CLOSE;
use crate::plan::Plan;
use crate::scalar::compare::Compare;

/// Deviation of w from its expectation, relative to the smaller of the two, up to which a step has stayed on its branch.
pub(super) const EXPECTED: f64 = 0.5;

/// Where a motion is on its branch; each list has a number for every sign of the plan.
#[derive(Clone, Copy)]
pub(crate) struct Branch<A> {
    /// ±1.
    pub(crate) signs: A,
    /// |w|.
    pub(crate) distances: A,
    /// Rates of |w| along the motion, where they are known.
    pub(crate) slopes: A,
}

/// Writes |w| of every group and says how certain it is that a step h has stayed on the branch: not at all for less than 0.
#[inline(always)]
pub(crate) fn certainty<V: Compare, A: AsRef<[V]>>(
    plan: &Plan,
    margins: &[V],
    branch: &Branch<A>,
    h: V,
    distances: &mut [V],
) -> V {
    let mut least = V::from_f64(1.0);
    let before = branch.distances.as_ref().iter().zip(branch.slopes.as_ref());
    for ((sign, now), (distance, slope)) in distances.iter_mut().take(plan.signs()).enumerate().zip(before) {
        let Some(margin) = plan.margin_of_sign(sign) else { continue };
        *now = margins[margin].abs().sqrt();
        least = least.least(certainty_of(*now, *distance + h * *slope));
    }
    least
}

/// How certain it is that |w| is where it was expected: not at all for less than 0.
#[inline(always)]
pub(crate) fn certainty_of<V: Compare>(now: V, expected: V) -> V {
    V::from_f64(EXPECTED) * now.least(expected) - (now - expected).abs()
}

/// Distances of the ends of a step below which a group may have come to its limit and back within the step.
pub(super) const fn may_dip(before: f64, after: f64) -> bool {
    before < CLOSE || after < CLOSE
}
