//! The end of a motion before the last instant, and the result of a group of lanes.

use crate::planned::Limit;
use crate::scalar::lanes::Lanes;

/// The instant at which the motion of a set of parameters ends, and the reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The first instant without a solution, an index of [`Sweeps::times`](super::Sweeps::times).
    pub instant: usize,
    /// The smallest margin there: 0 or less if a group is at its limit or beyond it; also 0 if the margin is not
    /// finite, and if a length that a joint prescribes is negative. It is positive if every group closes but another
    /// number is not finite.
    pub margin: f64,
    /// The first step of the plan that has no solution there, with its margin: a group that is at its limit or cannot
    /// close, an iteration that does not converge, or redundant rows that contradict the others. `None` if a length is
    /// negative, the motion jumps, an iteration leads away from its start, or a number is not finite for another reason.
    pub limit: Option<Limit>,
}

/// The result of a group of lanes: its score, and the early ends of its sets.
pub(super) type Outcome<S> = (S, [Option<End>; Lanes::COUNT]);
