//! Closures that a motion may have carried past their limit.
//!
//! Where the rows that a plan goes by have a limit at which the redundant ones let the mechanism pass (a parallelogram
//! that lies flat, with a third crank), the motion goes on smoothly and the closure changes its sign. The sign that was
//! kept gives a configuration then which the watched rows contradict; they also tell which other signs are right.

use crate::plan::{Plan, StepKind};

/// Closures of a prediction that are nearer to 0 than this are of either sign; it is the sine of half an angle or so.
const NEAR: f64 = 0.1;

/// How many of them are tried in all combinations.
const MOST: usize = 4;

/// Signs of modes that may be right where the ones that were kept are not.
pub(crate) struct Passed<'c> {
    /// Those that were kept, and the closures of the prediction.
    kept: &'c [f64],
    closures: &'c [f64],
    near: [usize; MOST],
    count: usize,
}

impl<'c> Passed<'c> {
    /// From the signs that were `kept` and the `closures` of the prediction.
    pub(crate) fn new(kept: &'c [f64], closures: &'c [f64]) -> Self {
        let (mut near, mut count) = ([0; MOST], 0);
        for (place, closure) in closures.iter().enumerate() {
            if closure.abs() < NEAR && count < MOST {
                near[count] = place;
                count += 1;
            }
        }
        Self { kept, closures, near, count }
    }

    /// How many attempts there are.
    pub(crate) const fn attempts(&self) -> usize {
        1 << self.count
    }

    /// Writes the signs of an attempt, those of the prediction first; false where they are the ones that were kept.
    pub(crate) fn signs(&self, attempt: usize, signs: &mut [f64]) -> bool {
        for ((sign, kept), closure) in signs.iter_mut().zip(self.kept).zip(self.closures) {
            *sign = if kept * closure < 0.0 { -kept } else { *kept };
        }
        for (bit, &place) in self.near[..self.count].iter().enumerate() {
            if attempt >> bit & 1 == 1 {
                signs[place] = -signs[place];
            }
        }
        signs.iter().zip(self.kept).any(|(sign, kept)| sign != kept)
    }
}

/// True where the margins say that a watched row is not satisfied.
pub(crate) fn is_missed(plan: &Plan, margin: impl Fn(usize) -> f64) -> bool {
    let watched = plan.steps.iter().filter(|step| matches!(step.kind, StepKind::Watched(_)));
    watched.flat_map(|step| step.margins.0..step.margins.1).any(|place| margin(place) <= Plan::SMALLEST_MARGIN)
}

#[cfg(test)]
mod tests {
    use super::Passed;

    #[test]
    fn every_combination_of_near_closures_is_tried_once_and_the_predicted_one_first() {
        let (kept, closures) = ([1.0, -1.0, 1.0, 1.0], [0.05, -0.04, -0.6, f64::NAN]);
        let passed = Passed::new(&kept, &closures);
        let all: Vec<[f64; 4]> = (0..passed.attempts())
            .map(|attempt| {
                let mut signs = [0.0; 4];
                assert!(passed.signs(attempt, &mut signs));
                signs
            })
            .collect();
        let of = |a: f64, b: f64| [a, b, -1.0, 1.0];
        assert_eq!(all, [of(1.0, -1.0), of(-1.0, -1.0), of(1.0, 1.0), of(-1.0, 1.0)]);
        // Far from limits there is nothing to try.
        let far = Passed::new(&kept[..2], &[0.9, -0.2]);
        assert_eq!((far.attempts(), far.signs(0, &mut [0.0; 2])), (1, false));
    }
}
