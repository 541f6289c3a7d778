//! Verifies the conditions of a design along its whole motion, not only at the instants that a search evaluates.

use super::condition::Condition;
use super::error::DesignError;
use super::follow::{DescentBranch, DesignMotion};
use super::motion::{margin_slacks, range_slacks};
use super::problem::Problem;
use super::result::Slack;
use crate::error::SolveError;
use crate::measure::Needs;
use crate::nonlinear::peak::peak;
use crate::results::varied::{Number, Varied};

/// Number of steps along a period; the least slack is located between the neighbours of the least value.
const STEPS: usize = 360;

/// Slacks of one instant.
type Slacks<'s> = dyn Fn(&Varied, &mut Vec<Number>) + 's;

impl Problem<'_> {
    /// The slack of every condition; of a condition on a period the least.
    ///
    /// # Errors
    /// [`Broken`](DesignError::Broken) where the mechanism does not move through all of a period.
    pub(crate) fn verified(&self, variables: &[f64], branch: &DescentBranch) -> Result<Vec<Slack>, DesignError> {
        let motion = self.motion(variables, branch);
        let evaluated = self.evaluate(variables, branch, false).unwrap_or_default();
        let at_instants = |index: usize| {
            let slacks = evaluated.conditions.iter().zip(&evaluated.slacks).filter(|(other, _)| **other == index);
            slacks.map(|(_, slack)| slack.value).fold(f64::INFINITY, f64::min)
        };
        let slack = |(index, condition): (usize, &Condition)| {
            let (times, needs) = match condition {
                Condition::Sum { .. } => {
                    return Ok(Slack { condition: condition.name(), slack: at_instants(index), at: None });
                }
                Condition::Margins { times, .. } => (times, Needs::LEAST),
                Condition::Range { times, quantity, .. } => (times, quantity.needs()),
            };
            let write_slacks = |varied: &Varied, out: &mut Vec<Number>| match condition {
                Condition::Sum { .. } => {}
                Condition::Margins { least, .. } => margin_slacks(varied, *least, out),
                Condition::Range { quantity, low, high, .. } => {
                    range_slacks(self.task.model, varied, quantity, [*low, *high], out)
                }
            };
            let (slack, at) = least(&motion, times.last().copied().unwrap_or(0.0), needs, &write_slacks)
                .map_err(|why| DesignError::Broken { condition: condition.name(), why: Box::new(why) })?;
            Ok(Slack { condition: condition.name(), slack, at: Some(at) })
        };
        self.task.conditions.iter().enumerate().map(slack).collect()
    }
}

/// The least slack from 0 to the end of a period, and where it is.
fn least(
    motion: &DesignMotion<'_>,
    period: f64,
    needs: Needs,
    write_slacks: &Slacks<'_>,
) -> Result<(f64, f64), SolveError> {
    let slacks = |times: &[f64]| -> Result<Vec<Vec<f64>>, SolveError> {
        let (mut all, mut numbers) = (Vec::with_capacity(times.len()), Vec::new());
        motion.each(times, false, needs, &mut |_, _, varied| {
            numbers.clear();
            write_slacks(varied, &mut numbers);
            all.push(numbers.iter().map(|number| number.value()).collect());
        })?;
        Ok(all)
    };
    let grid: Vec<f64> = (0..=STEPS).map(|k| period * k as f64 / STEPS as f64).collect();
    let values = slacks(&grid)?;
    let mut best = (f64::INFINITY, 0.0);
    for row in 0..values.first().map_or(0, Vec::len) {
        let lowest = (0..values.len()).min_by(|a, b| values[*a][row].total_cmp(&values[*b][row])).unwrap_or(0);
        let [from, to] = [lowest.saturating_sub(1), (lowest + 1).min(STEPS)];
        // The motion is followed from its beginning, so that every sample is on the same branch.
        let sample = |places: &[f64]| {
            let times: Vec<f64> = grid[..from].iter().chain(places).copied().collect();
            Some(slacks(&times).ok()?[from..].iter().map(|slacks| -slacks[row]).collect())
        };
        let closer = peak(sample, [grid[from], grid[to]], period).map(|peak| (-peak.value, peak.at));
        for found in closer.into_iter().chain([(values[lowest][row], grid[lowest])]) {
            if found.0 < best.0 {
                best = found;
            }
        }
    }
    Ok(best)
}
