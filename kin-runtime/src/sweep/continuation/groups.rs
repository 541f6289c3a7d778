//! The branch of every group of a plan, for configurations that full Newton has found.
//!
//! What [`planned::branch`](crate::planned::branch) asks of a solution by the plan is asked of every configuration here:
//! each group on its own side of where its branches meet, and as far from there as the prediction has it. One sign for
//! the whole mechanism would not do: two groups that change theirs in one step leave it as it was.

use crate::analysis::by_plan;
use crate::equations::Equations;
use crate::planned::blurred::{blurred_group, largest_angle};
use crate::planned::branch::{OUT_OF_REACH, certainty_of, resolves};

/// Nearer than this to where its branches meet a group is on neither of them: as near as rounding lets it be told.
const SMALLEST: f64 = 1e-6;

/// Condition numbers of the scaled Φ_q below which no configuration is near to a singular one.
const REGULAR: f64 = 1e3;

/// Deviation of a closure from its prediction, relative to the larger one, where redundant rows carry the motion past its
/// limit; and how near to it both may be.
const PASSING: f64 = 0.5;
const FLAT: f64 = 1e-3;

/// Writes what tells the branches of every group apart at q; nothing where there is no plan.
pub(super) fn write(equations: &Equations<'_>, q: &[f64], groups: &mut Vec<f64>) {
    groups.clear();
    if equations.given() > 0 {
        return;
    }
    groups.resize(equations.model.plan.signs(), 0.0);
    if equations.system.branches(&equations.instant(), q, groups).is_err() {
        groups.fill(f64::NAN);
    }
}

/// True where every group has stayed on its branch, from a configuration `before` over a prediction to what was found.
///
/// With redundant rows a group of the kept ones may have a limit that the mechanism passes: then the sign may change, as
/// the prediction has it.
pub(super) fn stay([before, predicted, found]: [&[f64]; 3], turn: f64, is_redundant: bool) -> bool {
    before.iter().zip(predicted).zip(found).all(|((before, predicted), found)| {
        if is_redundant {
            let size = found.abs().max(predicted.abs());
            return (found - predicted).abs() <= PASSING * size || size <= FLAT;
        }
        let sign = before.signum();
        let nearest = f64::min(sign * found, sign * before);
        sign * found > SMALLEST
            && (nearest >= OUT_OF_REACH * turn || resolves(nearest, turn) >= 0.0)
            && certainty_of(sign * found, sign * predicted) >= 0.0
    })
}

/// True where rates mean nothing, so near to a crossing of branches, given the condition number of Φ_q.
pub(super) fn are_blurred(
    equations: &mut Equations<'_>,
    groups: &[f64],
    [q, q_dot, q_ddot]: [&[f64]; 3],
    condition: f64,
) -> bool {
    if groups.is_empty() || condition < REGULAR {
        return false;
    }
    // What the plan divides by may be small where its closures are far apart.
    let margins = by_plan::margins(equations, groups, q);
    let plan = &equations.model.plan;
    let by_margin = |sign: usize| plan.margin_of_sign(sign).map_or(1.0, |place| margins[place].max(0.0).sqrt());
    let distances: Vec<f64> = groups.iter().enumerate().map(|(sign, w)| w.abs().min(by_margin(sign))).collect();
    let further = 1e-6 / largest_angle(equations.model, q_dot);
    let ahead: Vec<f64> = q.iter().zip(q_dot).map(|(q, v)| q + further * v).collect();
    let mut rates = Vec::new();
    write(equations, &ahead, &mut rates);
    rates.iter_mut().zip(groups).for_each(|(then, now)| *then = (*then - now) / further);
    blurred_group(equations.model, [groups, &rates], &distances, [q_dot, q_ddot]).is_some()
}

/// How near the nearest group is to where its branches meet.
pub(super) fn nearest(groups: &[f64]) -> f64 {
    groups.iter().fold(1.0, |least, w| f64::min(least, w.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One group from `before` over `predicted` to `found`, whichever its sign, and with redundant rows or without.
    fn stays([before, predicted, found]: [f64; 3], turn: f64, is_redundant: bool) -> bool {
        let answers = [1.0, -1.0].map(|sign| {
            // A second group, far from all limits, has no say.
            let of = |w: f64| [sign * w, -50.0];
            stay([&of(before), &of(predicted), &of(found)], turn, is_redundant)
        });
        assert_eq!(answers[0], answers[1]);
        answers[0]
    }

    #[test]
    fn a_group_stays_on_its_side_and_where_it_was_predicted() {
        let of = |before, predicted, found| stays([before, predicted, found], 0.01, false);
        assert!(of(0.5, 0.5, 0.5));
        assert!(!of(0.5, 0.5, -0.5) && !of(0.5, -0.5, -0.5) && !of(-0.5, 0.5, 0.5) && !of(0.5, -0.5, 0.5));
        // As near as half of the smaller one.
        assert!(of(0.5, 0.3, 0.2) && of(0.5, 0.2, 0.3) && !of(0.5, 0.31, 0.2) && !of(0.5, 0.2, 0.31));
        // Every group counts, whatever the others do.
        assert!(!stay([&[0.5, 0.5], &[0.5, 0.5], &[0.5, -0.5]], 0.01, false));
        assert!(!stay([&[0.5], &[0.5], &[f64::NAN]], 0.01, false) && !stay([&[0.5], &[f64::NAN], &[0.5]], 0.01, false));
    }

    #[test]
    fn rounding_does_not_tell_on_which_side_a_group_is() {
        assert!(stays([0.5, 1.01e-6, 1.01e-6], 0.0, false) && !stays([0.5, 0.99e-6, 0.99e-6], 0.0, false));
    }

    /// Either it is so far away that nothing comes there in four times the turn, or the step is short enough to resolve it.
    #[test]
    fn a_step_that_turns_too_far_for_its_groups_does_not_count() {
        // 10 turn³ is less than 4 turn in all steps that there are.
        for (turn, least) in [(0.1, 0.01), (0.3, 0.27)] {
            for (factor, counts) in [(1.01, true), (0.99, false)] {
                let near: f64 = factor * least;
                assert_eq!(counts, stays([near, near, near], turn, false), "{turn} {factor}");
                // At either end.
                assert_eq!(counts, stays([0.9, 1.2 * near, near], turn, false), "{turn} {factor}");
                assert_eq!(counts, stays([near, 1.2 * near, 1.4 * near], turn, false), "{turn} {factor}");
            }
        }
        // Where a step turns farther than that the cube grows beyond it.
        assert!(stays([0.9; 3], 0.22, false) && stays([4.1; 3], 1.0, false) && !stays([3.9; 3], 1.0, false));
    }

    /// Redundant rows carry a motion past limits of the others: the sign may change, as the prediction has it.
    #[test]
    fn with_redundant_rows_a_group_changes_its_sign_where_it_was_predicted() {
        let of = |before, predicted, found| stays([before, predicted, found], 0.01, true);
        assert!(of(0.1, -0.1, -0.1) && of(0.1, 0.1, 0.1) && !of(0.1, 0.1, -0.1) && !of(0.1, -0.1, 0.1));
        // As near as half of the larger one.
        assert!(of(0.1, 0.2, 0.101) && of(0.1, 0.101, 0.2) && !of(0.1, 0.2, 0.099) && !of(0.1, 0.099, 0.2));
        // Flat it has no sign that could be wrong.
        assert!(of(0.1, 0.99e-3, -0.99e-3) && of(0.1, -0.99e-3, 0.99e-3));
        assert!(!of(0.1, 1.01e-3, -0.5e-3) && !of(0.1, 0.5e-3, -1.01e-3));
        assert!(!of(0.1, f64::NAN, 0.1) && !of(0.1, 0.1, f64::NAN));
    }

    #[test]
    fn the_nearest_group_is_the_one_with_the_smallest_number() {
        assert_eq!([0.2, 0.2, 1.0, 1.0], [nearest(&[0.5, -0.2]), nearest(&[0.2, 0.9]), nearest(&[]), nearest(&[-7.0])]);
    }
}
