//! The modes that a partial guess determines: every group with guessed coordinates takes the closure that is nearer to
//! them, group by group in the order of the plan. If no coordinate of a group is guessed, those that follow from it
//! before the next group are compared, such as the position of a slider whose connecting rod closes the group. If none
//! of these is guessed either, or if both closures are equally near, the guess does not determine the mode, and the
//! general path is used.

use crate::model::{Component, CoordinateKind, Model};
use crate::plan::PlanStep;
use crate::planned::Sign;

/// If the squared distances of both closures from a guess differ by no more than this, the guess does not determine the
/// mode.
const UNDECIDED: f64 = 1e-9;

/// Writes q by the plan in given modes.
type Closed<'c> = dyn FnMut(&[f64], &mut [f64]) -> Option<()> + 'c;

/// A guess: NaN for coordinates without one, and the modes that the caller requested.
pub(super) struct Guess<'g> {
    pub(super) model: &'static Model,
    pub(super) q: &'g [f64],
    pub(super) modes: &'g [(String, Option<usize>, Sign)],
}

impl Guess<'_> {
    /// Writes the mode of every group, in the order of the plan. `room` is for what `closed` writes in both modes of a
    /// group. `None` where the guess does not determine it.
    ///
    /// What one group decides holds for all later ones, so that the next group compares the closures found by then with
    /// one more: k groups take k + 1 solutions of the plan.
    pub(super) fn write_modes(&self, modes: &mut [f64], room: [&mut [f64]; 2], closed: &mut Closed<'_>) -> Option<()> {
        let [mut plus, mut minus] = room;
        let plan = &self.model.plan;
        if !self.starts_iterations() || self.modes.iter().any(|(_, index, _)| index.is_none()) {
            return None;
        }
        let wanted = |index: usize| self.modes.iter().rev().find(|(_, place, _)| *place == Some(index));
        for (index, mode) in modes.iter_mut().enumerate() {
            *mode = wanted(index).map_or(1.0, |(.., sign)| sign.value());
        }
        let mut is_closed = false;
        for (index, mode) in plan.modes.iter().enumerate().filter(|(index, _)| wanted(*index).is_none()) {
            let steps = self.steps_of(mode.step)?;
            if !is_closed {
                closed(modes, plus)?;
                is_closed = true;
            }
            modes[index] = -1.0;
            closed(modes, minus)?;
            let farther: f64 = steps.iter().map(|step| self.farther(step.coordinates, plus, minus)).sum();
            // False for NaN, too.
            let is_decided = farther.abs() > UNDECIDED;
            if !is_decided {
                return None;
            }
            modes[index] = -farther.signum();
            if farther > 0.0 {
                core::mem::swap(&mut plus, &mut minus);
            }
        }
        Some(())
    }

    /// The steps whose guessed coordinates determine the closure of the group that is solved in this step.
    fn steps_of(&self, group: usize) -> Option<&'static [PlanStep]> {
        let (group, later_steps) = self.model.plan.steps.get(group..)?.split_at_checked(1)?;
        let is_guessed = |step: &PlanStep| step.coordinates.iter().any(|&(k, _)| self.is_guessed(k));
        if group.iter().any(is_guessed) {
            return Some(group);
        }
        let following = later_steps.iter().take_while(|step| step.is_linear()).count();
        later_steps.get(..following).filter(|steps| steps.iter().any(is_guessed))
    }

    fn is_guessed(&self, k: usize) -> bool {
        self.q.get(k).is_some_and(|guess| !guess.is_nan())
    }

    /// True if all unknowns of iterations are guessed.
    fn starts_iterations(&self) -> bool {
        self.model.plan.iterated_coordinates().all(|k| self.is_guessed(k))
    }

    /// By how much the guessed ones of these coordinates are farther from one closure than from the other: the
    /// difference of the squared distances, of lengths relative to their size.
    fn farther(&self, coordinates: &[(usize, usize)], plus: &[f64], minus: &[f64]) -> f64 {
        let mut sum = 0.0;
        for &(k, _) in coordinates {
            if !self.is_guessed(k) {
                continue;
            }
            let (guess, plus, minus) = (self.q[k], plus[k], minus[k]);
            let [square, other] = [plus, minus].map(|found| (guess - found) * (guess - found));
            sum += match self.model.coordinates[k].kind {
                CoordinateKind::Pose { component: Component::Phi, .. } => square - other,
                CoordinateKind::Pose { .. } => {
                    let size = guess * guess + plus * plus + minus * minus;
                    (square - other) / (size + f64::MIN_POSITIVE)
                }
                CoordinateKind::Scalar => (square - other) / (1.0 + guess * guess),
            };
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mechanism;
    use crate::fixture::PlannedFourBar;

    /// The mode that a guess of the coupler's and the rocker's angle determines, where these are ±0.5 and ±1 in the two
    /// modes.
    fn mode(guess: [f64; 2], modes: &[(String, Option<usize>, Sign)]) -> Option<f64> {
        let mut q = [f64::NAN; 9];
        (q[5], q[8]) = (guess[0], guess[1]);
        let (mut found, mut room) = ([0.0], [[0.0; 9]; 2]);
        let guess = Guess { model: PlannedFourBar::model(), q: &q, modes };
        let mut closed = |modes: &[f64], q: &mut [f64]| {
            (q[5], q[8]) = (0.5 * modes[0], modes[0]);
            Some(())
        };
        guess.write_modes(&mut found, room.each_mut().map(|q| &mut q[..]), &mut closed)?;
        Some(found[0])
    }

    #[test]
    fn a_guess_means_the_closure_that_is_nearer() {
        const NONE: f64 = f64::NAN;
        assert_eq!([Some(1.0), Some(-1.0)], [[0.1, NONE], [-0.1, NONE]].map(|guess| mode(guess, &[])));
        // All guessed coordinates of the group count: 0.3 from one closure and 0.7 from the other, and so on.
        assert_eq!([Some(1.0), Some(-1.0)], [[-0.2, 0.2], [0.2, -0.2]].map(|guess| mode(guess, &[])));
        // Nothing is guessed, or both closures are equally near.
        assert_eq!([None; 3], [[NONE, NONE], [0.0, 0.0], [0.4, -0.2]].map(|guess| mode(guess, &[])));
    }

    #[test]
    fn what_is_asked_for_prevails_and_the_last_one_counts() {
        let asked = |sign, place| ("ABD".to_owned(), place, sign);
        assert_eq!(Some(-1.0), mode([0.5, 1.0], &[asked(Sign::Minus, Some(0))]));
        assert_eq!(Some(1.0), mode([f64::NAN; 2], &[asked(Sign::Minus, Some(0)), asked(Sign::Plus, Some(0))]));
        assert_eq!(None, mode([0.5, 1.0], &[asked(Sign::Plus, None)]));
    }

    /// Without the closure in one of the modes nothing can be compared.
    #[test]
    fn a_guess_means_nothing_where_the_plan_does_not_close() {
        let guess = Guess { model: PlannedFourBar::model(), q: &[0.0; 9], modes: &[] };
        assert_eq!(None, guess.write_modes(&mut [0.0], [&mut [0.0; 9], &mut [0.0; 9]], &mut |_, _| None));
    }
}
