//! What a partial guess means: for every group that closes in two ways the closure that is nearer to the guess.

use crate::model::{Component, CoordinateKind, Model};
use crate::plan::StepKind;
use crate::planned::Sign;

/// If the squared distances of both closures from a guess differ by less than this, the guess does not decide the mode.
const UNDECIDED: f64 = 1e-9;

/// Writes q as the plan closes it in given modes.
type Closed<'c> = dyn FnMut(&[f64], &mut [f64]) -> Option<()> + 'c;

/// A guess: NaN for coordinates without one, and the modes that the caller asked for.
pub(super) struct Guess<'g> {
    pub(super) model: &'static Model,
    pub(super) q: &'g [f64],
    pub(super) modes: &'g [(String, Option<usize>, Sign)],
}

impl Guess<'_> {
    /// Writes the modes that the guess means, one for every group in the order of the plan. `q` has room for
    /// what `closed` writes. `None` where the guess does not decide.
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
            if !coordinates.iter().any(|&(k, _)| self.has(k)) {
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

    fn has(&self, k: usize) -> bool {
        self.q.get(k).is_some_and(|guess| !guess.is_nan())
    }

    /// True if all unknowns of iterations are guessed.
    fn starts_iterations(&self) -> bool {
        self.model.plan.steps.iter().all(|step| match step.kind {
            StepKind::Newton(unknowns) => step.coordinates.iter().take(unknowns).all(|&(k, _)| self.has(k)),
            _ => true,
        })
    }

    /// The squared distance of a group's guessed coordinates from q; of lengths relative to their size.
    fn squared_distance(&self, coordinates: &[(usize, usize)], q: &[f64]) -> f64 {
        let mut sum = 0.0;
        for &(k, _) in coordinates {
            if !self.has(k) {
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
