//! The modes that a partial guess determines: every group with guessed coordinates takes the closure that is nearer to
//! them, group by group in the order of the plan. If no coordinate of a group is guessed, or both closures are equally
//! near, the guess does not determine the mode, and the general path is used.

use crate::model::{Component, CoordinateKind, Model};
use crate::plan::StepKind;
use crate::planned::Sign;

/// If the squared distances of both closures from a guess differ by less than this, the guess does not determine the
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
    /// Writes the mode of every group, in the order of the plan. `q` has room for what `closed` writes. `None` where
    /// the guess does not determine it.
    pub(super) fn write_modes(&self, modes: &mut [f64], q: &mut [f64], closed: &mut Closed<'_>) -> Option<()> {
        let plan = &self.model.plan;
        if !self.starts_iterations() || self.modes.iter().any(|(_, place, _)| place.is_none()) {
            return None;
        }
        for (place, mode) in plan.modes.iter().enumerate() {
            if let Some((.., sign)) = self.modes.iter().rev().find(|(_, asked, _)| *asked == Some(place)) {
                modes[place] = sign.value();
                continue;
            }
            let coordinates = plan.steps.get(mode.step)?.coordinates;
            if !coordinates.iter().any(|&(k, _)| self.is_guessed(k)) {
                return None;
            }
            let mut distances = [0.0; 2];
            for (distance, sign) in distances.iter_mut().zip([1.0, -1.0]) {
                modes[place] = sign;
                closed(modes, q)?;
                *distance = self.squared_distance(coordinates, q);
            }
            let [plus, minus] = distances;
            // False for NaN, too.
            let is_decided = (plus - minus).abs() > UNDECIDED;
            if !is_decided {
                return None;
            }
            modes[place] = if plus < minus { 1.0 } else { -1.0 };
        }
        Some(())
    }

    fn is_guessed(&self, k: usize) -> bool {
        self.q.get(k).is_some_and(|guess| !guess.is_nan())
    }

    /// True if all unknowns of iterations are guessed.
    fn starts_iterations(&self) -> bool {
        self.model.plan.steps.iter().all(|step| match step.kind {
            StepKind::Newton(unknowns) => step.coordinates.iter().take(unknowns).all(|&(k, _)| self.is_guessed(k)),
            _ => true,
        })
    }

    /// The squared distance of a group's guessed coordinates from q; of lengths relative to their size.
    fn squared_distance(&self, coordinates: &[(usize, usize)], q: &[f64]) -> f64 {
        let mut sum = 0.0;
        for &(k, _) in coordinates {
            if !self.is_guessed(k) {
                continue;
            }
            let (guess, found) = (self.q[k], q[k]);
            let square = (guess - found) * (guess - found);
            sum += match self.model.coordinates[k].kind {
                CoordinateKind::Pose { component: Component::Phi, .. } => square,
                CoordinateKind::Pose { .. } => square / (guess * guess + found * found + f64::MIN_POSITIVE),
                CoordinateKind::Scalar => square / (1.0 + guess * guess),
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
        let (mut found, mut room) = ([0.0], [0.0; 9]);
        let guess = Guess { model: PlannedFourBar::model(), q: &q, modes };
        let mut closed = |modes: &[f64], q: &mut [f64]| {
            (q[5], q[8]) = (0.5 * modes[0], modes[0]);
            Some(())
        };
        guess.write_modes(&mut found, &mut room, &mut closed)?;
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
        assert_eq!(None, guess.write_modes(&mut [0.0], &mut [0.0; 9], &mut |_, _| None));
    }
}
