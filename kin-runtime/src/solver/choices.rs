//! Whether the combinations of signs of a plan give all closures.
//!
//! A plan in closed form chooses not only by signs. An angle φ that occurs as nφ has n directions, of which the plan
//! takes the one nearest to its start. If other coordinates follow an angle in a ratio, as with gears, each whole turn
//! of the angle gives another closure. The plan finds these closures from other start values.

#[cfg(feature = "cli")]
use super::Solver;
use super::any_solver::AnySolver;
use super::assemblies::{is_angle, is_length};
#[cfg(feature = "cli")]
use crate::mechanism::Mechanism;
use crate::plan::{Depth, Plan, Solved};
use crate::proof::{MAX_COMBINATIONS, advance, decisive, zeros};
use crate::signal::Instant;
use std::f64::consts::{PI, TAU};

/// Shifts of the start, relative to the guess, that show whether there are other closures than those of the signs. If
/// the choices lie a whole turn apart, the second shift reaches another one; if half a turn, one of the two shifts
/// reaches one that differs by an odd number of half turns; if a third or less, the first shift reaches one that is
/// less than a whole turn away.
const START_SHIFTS: [f64; 2] = [PI + 0.3, 2.5 * PI];
/// Numbers that differ by less, relative to their size, are the same but for rounding.
const SAME_NUMBER: f64 = 1e-9;

#[cfg(feature = "cli")]
impl<M: Mechanism> Solver<'_, M> {
    /// Whether the closures are those of the signs of a plan in closed form, which are found without a search.
    pub(crate) fn closes_by_signs(&self, at: &Instant<'_>) -> bool {
        let solver = self as &dyn AnySolver;
        solver.start().is_ok_and(|guess| solver.angles_with_free_turns(at, &guess).is_some())
    }
}

impl dyn AnySolver + '_ {
    /// The angles of which each whole turn gives another closure. With these angles within half a turn of their
    /// guesses, every combination of signs gives exactly one closure. `None` if there may be other closures, or if the
    /// plan has no closed form.
    ///
    /// A combination that closes shows all choices. Where none does, every combination shows those before the group that
    /// does not close: with another choice this group may close.
    pub(super) fn angles_with_free_turns(&self, at: &Instant<'_>, guess: &[f64]) -> Option<Vec<usize>> {
        if !self.is_closed_form() {
            return None;
        }
        let plan = &self.model().plan;
        let mut signs = vec![1.0; plan.modes.len()];
        let mut all = Vec::new();
        for _ in 0..MAX_COMBINATIONS {
            let FreeTurns { angles, open } = self.free_turns(at, &signs, guess)?;
            add_new(&mut all, angles);
            match open {
                Some(margin) if advance(&mut signs, decisive(plan, margin)) => {}
                _ => break,
            }
        }
        Some(all)
    }

    /// The same for one combination of signs.
    pub(super) fn free_turns(&self, at: &Instant<'_>, signs: &[f64], guess: &[f64]) -> Option<FreeTurns> {
        let model = self.model();
        let (plan, n) = (&model.plan, guess.len());
        let mut room = zeros(5 * n + plan.margins);
        let (margins, lists) = room.split_at_mut(plan.margins);
        let mut lists = lists.chunks_exact_mut(n.max(1));
        let [Some(start), Some(q_dot), Some(q_ddot), Some(found), Some(shifted)] = [(); 5].map(|()| lists.next())
        else {
            return Some(FreeTurns { angles: Vec::new(), open: None });
        };
        // Writes q from a shifted guess; returns the first margin that is not positive.
        let mut solve = |shift: &dyn Fn(usize) -> f64, q: &mut [f64]| {
            for (k, (start, guess)) in start.iter_mut().zip(guess).enumerate() {
                *start = if is_length(model, k) { *guess } else { guess + shift(k) };
            }
            margins.fill(0.0);
            self.solve(at, signs, start, Depth::Position, Solved { q, q_dot, q_ddot, margins }).ok()?;
            // NaN is not positive either.
            let is_good = |margin: &f64| *margin > Plan::SMALLEST_MARGIN;
            Some(margins.iter().position(|margin| !is_good(margin)))
        };
        let open = solve(&|_| 0.0, found)?;
        // False for NaN, too.
        let is_small = |k: usize, moved: f64| moved.abs() <= SAME_NUMBER * (1.0 + found[k].abs());
        let is_turned = |k: usize, moved: f64| is_small(k, moved - TAU * (moved / TAU).round());
        let is_same = |k: usize, moved: f64| is_small(k, moved) || is_angle(model, k) && is_turned(k, moved);
        let moved = |shifted: &[f64], k: usize| shifted[k] - found[k];
        // Coordinates of groups that do not close may be NaN.
        let all = (0..n).filter(|&k| found[k].is_finite());
        // Usually all starts lead to the same closure.
        let mut choices = false;
        for shift in START_SHIFTS {
            solve(&|_| shift, shifted)?;
            choices |= !all.clone().all(|k| is_same(k, moved(shifted, k)));
        }
        let mut angles = Vec::new();
        for k in all.clone().filter(|&k| choices && !is_length(model, k)) {
            for shift in START_SHIFTS {
                solve(&|other| if other == k { shift } else { 0.0 }, shifted)?;
                if !is_turned(k, moved(shifted, k)) {
                    return None;
                }
                if all.clone().any(|other| other != k && !is_same(other, moved(shifted, other))) {
                    add_new(&mut angles, vec![k]);
                }
            }
        }
        Some(FreeTurns { angles, open })
    }
}

/// What the start values show of one combination of signs.
pub(super) struct FreeTurns {
    /// The angles of which each whole turn gives another closure.
    pub(super) angles: Vec<usize>,
    /// The first margin that is not positive.
    pub(super) open: Option<usize>,
}

/// Adds what a list does not contain yet.
pub(super) fn add_new(all: &mut Vec<usize>, more: Vec<usize>) {
    more.into_iter().for_each(|k| {
        if !all.contains(&k) {
            all.push(k);
        }
    });
}
