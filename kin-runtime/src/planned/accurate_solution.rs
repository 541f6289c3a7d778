//! The solution of a plan, accurate in all coordinates.
//!
//! An iteration ends when its correction δ is so small that the next one, about δ², is below rounding
//! ([`LAST_CORRECTION`](crate::plan::LAST_CORRECTION)). With another closure at the distance w, √margin, the next one is about
//! δ²/w, and coordinates that follow from the unknown by a division with the margin w² have w times less accuracy again. Where
//! a margin is small the plan is therefore solved once more, from its own solution.

use crate::mechanism::{LengthError, Mechanism};
use crate::plan::{Depth, Solved};
use crate::scalar::Scalar;
use crate::signal::Instant;
use crate::workspace::Array;

/// The margin w² above which one solution is accurate: (3·10⁻⁹/w)² is then at most 10⁻¹⁴.
const MARGIN_OF_ONE_SOLUTION: f64 = 1e-3;

/// Solves by the plan, and, if it iterates, once more where a margin is small.
///
/// # Errors
/// [`LengthError`] for a list of the wrong length.
#[inline(always)]
pub(crate) fn solve_accurately<M: Mechanism, T: Scalar>(
    mechanism: &M,
    parameters: &[T],
    (at, modes): (&Instant<'_, T>, &[T]),
    start: &[T],
    depth: Depth,
    solved: Solved<'_, T>,
) -> Result<(), LengthError> {
    let Solved { q, q_dot, q_ddot, margins } = solved;
    let first = Solved { q: &mut *q, q_dot: &mut *q_dot, q_ddot: &mut *q_ddot, margins: &mut *margins };
    mechanism.solve_with(parameters, at, modes, start, depth, first)?;
    let is_far = |margin: &T| (*margin - T::from_f64(1.0)).is_within(1.0 - MARGIN_OF_ONE_SOLUTION);
    if !M::model().plan.iterates() || margins.iter().fold(true, |far, margin| far & is_far(margin)) {
        return Ok(());
    }
    solve_again(mechanism, parameters, (at, modes), depth, Solved { q, q_dot, q_ddot, margins })
}

/// Solves by the plan from the solution itself.
#[cold]
#[inline(never)]
fn solve_again<M: Mechanism, T: Scalar>(
    mechanism: &M,
    parameters: &[T],
    (at, modes): (&Instant<'_, T>, &[T]),
    depth: Depth,
    solved: Solved<'_, T>,
) -> Result<(), LengthError> {
    let mut start = M::Coordinates::<T>::filled(T::from_f64(0.0));
    start.as_mut().copy_from_slice(solved.q);
    mechanism.solve_with(parameters, at, modes, start.as_ref(), depth, solved)
}
