//! Whether the signs of a plan stand for all of its closures.
//!
//! A plan in closed form chooses more than signs. An angle φ that occurs as nφ has n directions, of which the plan takes the one
//! nearest to its start. And where others follow an angle in a ratio, as gears have it, each of its whole turns is another
//! closure. Where there are such choices, the plan gives others of them from other starts.

use super::Solver;
use super::assemblies::{is_angle, is_length};
use crate::mechanism::Mechanism;
use crate::plan::Plan;
use crate::planned::lists::{Margins, Modes};
use crate::workspace::{Array, Instant};
use std::f64::consts::{PI, TAU};

/// Other starts, relative to the guess. Where directions are a whole turn apart, the second start leads to another one; half a turn
/// apart, one of the two leads to one an odd number of these away; and a third of a turn or less, the first leads to another one
/// that is less than a whole turn away.
const STARTS: [f64; 2] = [PI + 0.3, 2.5 * PI];
/// Numbers that differ by less, relative to their size, are the same but for rounding.
const SAME: f64 = 1e-9;
/// Modes of which all combinations are tried until one closes.
const VARIED: usize = 10;

impl<M: Mechanism> Solver<'_, M> {
    /// Whether the closures are those of the signs of a plan in closed form, which are found without a search.
    #[cfg(feature = "cli")]
    pub(crate) fn closes_by_signs(&self, at: &Instant<'_>) -> bool {
        let guess = self.checked_guess().unwrap_or_default();
        let guess: Vec<f64> = guess.into_iter().map(|guess| guess.unwrap_or(0.0)).collect();
        guess.len() == M::COORDINATES && self.told_by_signs(at, &guess).is_some()
    }

    /// The angles whose whole turns are closures of their own, if every combination of signs is one closure as long as these
    /// angles are within half a turn of their guesses. None if there may be other closures, or if the plan has no closed form.
    pub(super) fn told_by_signs(&self, at: &Instant<'_>, guess: &[f64]) -> Option<Vec<usize>> {
        if !self.is_closed_form() {
            return None;
        }
        let parameters = self.mechanism.parameters::<f64>();
        let solved = |modes: &Modes<M>, shift: &dyn Fn(usize) -> f64, margins: &mut Margins<M>| {
            let start =
                M::Coordinates::<f64>::generate(|k| if is_length::<M>(k) { guess[k] } else { guess[k] + shift(k) });
            self.solved(&parameters, at, &start, modes, margins)
        };
        // The first combination that closes; where none does, there are no closures to be told apart.
        let closed = (0..1_u32 << M::model().plan.modes.len().min(VARIED)).find_map(|combination| {
            let (mut modes, mut margins) = (Modes::filled(1.0), Margins::filled(0.0));
            let signs = modes.as_mut().iter_mut().take(VARIED).enumerate();
            signs.for_each(|(k, sign)| *sign = if combination >> k & 1 == 0 { 1.0 } else { -1.0 });
            let q = solved(&modes, &|_| 0.0, &mut margins)?;
            let closes = margins.as_ref().iter().all(|margin| *margin > Plan::SMALLEST_MARGIN);
            (closes && q.as_ref().iter().all(|x| x.is_finite())).then_some((modes, q))
        });
        let Some((modes, here)) = closed else { return Some(Vec::new()) };
        let from = |shift: &dyn Fn(usize) -> f64| solved(&modes, shift, &mut Margins::filled(0.0));
        // False for NaN, too.
        let is_small = |k: usize, moved: f64| moved.abs() <= SAME * (1.0 + here.as_ref()[k].abs());
        let is_turned = |k: usize, moved: f64| is_small(k, moved - TAU * (moved / TAU).round());
        let is_same = |k: usize, moved: f64| is_small(k, moved) || is_angle::<M>(k) && is_turned(k, moved);
        let moved = |there: &M::Coordinates<f64>, k: usize| there.as_ref()[k] - here.as_ref()[k];
        let all = 0..guess.len();
        // Mostly all starts lead to the same closure.
        let mut choices = false;
        for shift in STARTS {
            let there = from(&|_| shift)?;
            choices |= !all.clone().all(|k| is_same(k, moved(&there, k)));
        }
        let mut bounded = Vec::new();
        for k in all.clone().filter(|&k| choices && !is_length::<M>(k)) {
            for shift in STARTS {
                let there = from(&|other| if other == k { shift } else { 0.0 })?;
                if !is_turned(k, moved(&there, k)) {
                    return None;
                }
                let follows = all.clone().any(|other| other != k && !is_same(other, moved(&there, other)));
                if follows && !bounded.contains(&k) {
                    bounded.push(k);
                }
            }
        }
        Some(bounded)
    }
}
