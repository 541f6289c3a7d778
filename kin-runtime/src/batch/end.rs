//! Where a set of parameters cannot go on, and what becomes of a group of lanes.

use crate::planned::Limit;
use crate::scalar::lanes::Lanes;

/// Where a set cannot go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The first instant without an answer, a place in [`Sweeps::times`](super::Sweeps::times).
    pub instant: usize,
    /// The smallest margin there: 0 or less where a group is at its limit or beyond it; 0, too, where it is not a finite
    /// number, and where a length that a joint keeps is negative. Positive where every group closes and another number is not finite.
    pub margin: f64,
    /// The first step of the plan that has no answer there, with its margin: a group that is at its limit or cannot close,
    /// by its joints, an iteration that does not converge, redundant rows that contradict. None where a number is not finite
    /// for another reason.
    pub limit: Option<Limit>,
}

/// What becomes of a group of lanes: a score, and where its sets had to end.
pub(super) type Outcome<S> = (S, [Option<End>; Lanes::COUNT]);
