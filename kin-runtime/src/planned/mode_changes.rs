//! Modes that may have changed because the motion has passed the limit of their group.
//!
//! The rows that a plan uses may have a limit that the mechanism passes because of its redundant rows, for example a
//! parallelogram with a third crank that lies flat. There the motion continues smoothly and the branch value changes
//! its sign. With the old sign the plan gives a configuration that contradicts the redundant rows; these also determine
//! which signs are right.

use crate::plan::{Plan, StepKind};

/// A group whose branch value at the prediction is smaller than this may have either sign. (The value is about the sine
/// of half an angle.)
const UNDECIDED_VALUE: f64 = 0.1;

/// A branch value this near to 0 may reach 0 and return within one step of the usual length.
pub(crate) const DIPPING_VALUE: f64 = 0.15;

/// Largest number of modes of which all combinations of signs are tried.
const MAX_COMBINED_MODES: usize = 6;

/// Alternative signs of modes, tried where the current ones contradict the redundant rows.
///
/// Only the redundant rows decide. Combinations with fewer changed signs are tried first, so that a mode on which
/// these rows do not depend keeps its sign, whatever its prediction is.
pub(crate) struct Passed<'c> {
    /// The current signs.
    signs: &'c [f64],
    /// Indices of the modes that may have changed their sign.
    near: [usize; MAX_COMBINED_MODES],
    count: usize,
}

impl<'c> Passed<'c> {
    /// Selects the groups whose branch values at the prediction are near 0 or beyond it. `signs` are the current signs;
    /// modes with a non-zero element in `requested` were requested by the caller and do not change (an empty list
    /// requests nothing).
    pub(crate) fn new(signs: &'c [f64], branch_values: &[f64], requested: &[f64]) -> Self {
        let (mut near, mut count) = ([0; MAX_COMBINED_MODES], 0);
        for (index, (sign, value)) in signs.iter().zip(branch_values).enumerate() {
            let free = requested.get(index).is_none_or(|requested| *requested == 0.0);
            if free && (value.abs() < UNDECIDED_VALUE || sign * value < 0.0) && count < MAX_COMBINED_MODES {
                near[count] = index;
                count += 1;
            }
        }
        Self { signs, near, count }
    }

    /// The attempts, as bit sets of the modes that change their sign; smaller sets come first.
    pub(crate) fn attempts(&self) -> impl Iterator<Item = u32> + use<> {
        let (count, all) = (self.count as u32, 1_u32 << self.count);
        (1..=count).flat_map(move |flips| (1..all).filter(move |attempt| attempt.count_ones() == flips))
    }

    /// Writes the signs of an attempt.
    pub(crate) fn signs(&self, attempt: u32, signs: &mut [f64]) {
        signs.copy_from_slice(self.signs);
        for (bit, &index) in self.near[..self.count].iter().enumerate() {
            if attempt >> bit & 1 == 1 {
                signs[index] = -signs[index];
            }
        }
    }
}

/// True where the margins show that a redundant row is not satisfied.
pub(crate) fn is_missed(plan: &Plan, margins: &[f64]) -> bool {
    let steps = plan.steps.iter().filter(|step| step.kind == StepKind::RedundantRows);
    steps.flat_map(|step| step.margins.0..step.margins.1).any(|index| margins[index] <= Plan::SMALLEST_MARGIN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PlanStep;

    #[test]
    fn every_combination_of_near_closures_is_tried_once_and_fewest_changes_first() {
        let (kept, closures) = ([1.0, -1.0, 1.0, 1.0, -1.0], [0.05, -0.04, -0.6, f64::NAN, 0.01]);
        let passed = Passed::new(&kept, &closures, &[0.0, 0.0, 0.0, 0.0, 1.0]);
        let all: Vec<[f64; 5]> = passed
            .attempts()
            .map(|attempt| {
                let mut signs = [0.0; 5];
                passed.signs(attempt, &mut signs);
                signs
            })
            .collect();
        let of = |a: f64, b: f64, c: f64| [a, b, c, 1.0, -1.0];
        let [one, two, three] = [
            [of(-1.0, -1.0, 1.0), of(1.0, 1.0, 1.0), of(1.0, -1.0, -1.0)],
            [of(-1.0, 1.0, 1.0), of(-1.0, -1.0, -1.0), of(1.0, 1.0, -1.0)],
            [of(-1.0, 1.0, -1.0); 3],
        ];
        assert_eq!(all, [one[0], one[1], one[2], two[0], two[1], two[2], three[0]]);
        // There are no attempts for closures far from their limits, or for requested modes.
        assert_eq!(Passed::new(&kept[..2], &[0.9, -0.2], &[]).attempts().count(), 0);
        assert_eq!(Passed::new(&kept, &closures, &[1.0; 5]).attempts().count(), 0);
    }

    #[test]
    fn closures_near_their_limit_or_beyond_it_may_have_changed() {
        for (kept, closure, may) in [
            (1.0, 0.099, true),
            (1.0, 0.101, false),
            (1.0, -0.7, true),
            (-1.0, -0.099, true),
            (-1.0, -0.101, false),
            (-1.0, 0.7, true),
        ] {
            assert_eq!(usize::from(may), Passed::new(&[kept], &[closure], &[]).attempts().count(), "{kept} {closure}");
        }
    }

    /// Of many closures only the first ones are tried, because every further one doubles the number of combinations.
    #[test]
    fn no_more_than_six_closures_are_combined() {
        for (count, attempts) in [(5, 31), (6, 63), (7, 63), (12, 63)] {
            let passed = Passed::new(&[1.0; 12][..count], &[0.0; 12][..count], &[]);
            assert_eq!(attempts, passed.attempts().count(), "{count}");
        }
    }

    #[test]
    fn only_margins_of_redundant_rows_say_that_these_are_missed() {
        const fn step(kind: StepKind, margins: (usize, usize)) -> PlanStep {
            PlanStep { kind, rows: &[], group: "", joints: &[], coordinates: &[], modes: (0, 0), margins, singular: "" }
        }
        const PLAN: Plan = Plan {
            steps: &[step(StepKind::Closure, (0, 2)), step(StepKind::RedundantRows, (2, 4))],
            modes: &[],
            orientations: &[],
            iterations: 0,
            margins: 4,
            absent: None,
        };
        let missed = |margins: [f64; 4]| is_missed(&PLAN, &margins);
        assert!(!missed([1.0; 4]) && !missed([-1.0, 0.0, 1.0, 1.0]) && !missed([1.0, 1.0, 1.01e-12, 1.0]));
        assert!(missed([1.0, 1.0, 1e-12, 1.0]) && missed([1.0, 1.0, 1.0, -2.0]) && missed([1.0, 1.0, 0.0, 0.0]));
    }
}
