//! The solution of a plan, accurate in all coordinates.
//!
//! An iteration ends when its correction δ is so small that the next one, about δ², is below rounding
//! ([`LAST_CORRECTION`](crate::plan::LAST_CORRECTION)). With another closure at the distance w, √margin, the next one is about
//! δ²/w, and coordinates that follow from the unknown by a division with the margin w² have w times less accuracy again. Where
//! a margin is small the plan is therefore solved once more, from its own solution.
//!
//! The same holds where other angles follow from the unknown with a large factor k, however large the margin is: cranks on a
//! rod that is k times as long, whose angle is the unknown. The next correction is then about k δ², and the angles are off by
//! k² δ². The rates show the factor; where nothing moves, nothing shows it.

use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::plan::{Depth, Solved, StepKind};
use crate::scalar::Scalar;
use crate::signal::Instant;
use crate::workspace::Array;

/// The margin w² above which one solution is accurate: (3·10⁻⁹/w)² is then at most 10⁻¹⁴.
const MARGIN_OF_ONE_SOLUTION: f64 = 1e-3;

/// The ratio of the rate of an angle to those of the unknowns up to which one solution is accurate: (3·10⁻⁹ k)² is then at
/// most 10⁻¹³.
const FACTOR_OF_ONE_SOLUTION: f64 = 100.0;

/// Solves by the plan, and, if it iterates, once more where a margin is small, where an angle is much faster than the
/// unknowns, and at rest.
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
    let is_accurate = !M::model().plan.iterates()
        || margins.iter().fold(true, |far, margin| far & is_far(margin)) && follow_evenly(M::model(), q_dot);
    if is_accurate {
        return Ok(());
    }
    solve_again(mechanism, parameters, (at, modes), depth, Solved { q, q_dot, q_ddot, margins })
}

/// True if the unknowns of every iterated group move, and no other angle of the group moves much faster.
fn follow_evenly<T: Scalar>(model: &Model, q_dot: &[T]) -> bool {
    let is_length = |k: usize| model.coordinates[k].kind.is_length();
    for step in model.plan.steps {
        let StepKind::Newton(unknowns) = step.kind else { continue };
        let (unknowns_of_step, solved_later) = step.coordinates.split_at(unknowns.min(step.coordinates.len()));
        if unknowns_of_step.iter().any(|&(k, _)| is_length(k)) {
            continue;
        }
        let rates = unknowns_of_step.iter().fold(T::from_f64(0.0), |sum, &(k, _)| sum + q_dot[k].abs());
        // At rest this is no number, which is within no bound.
        let inverse = T::from_f64(1.0) / rates;
        let is_even = |rate: T| (rate * inverse).is_within(FACTOR_OF_ONE_SOLUTION);
        // Mostly nothing at all is much faster, which takes less time to see.
        let all_even = q_dot.iter().fold(true, |all, rate| all & is_even(*rate));
        if !all_even && !solved_later.iter().all(|&(k, _)| is_length(k) || is_even(q_dot[k])) {
            return false;
        }
    }
    true
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
