//! The evaluation of a design: its misses (differences from what is wanted), its slacks, and the derivatives of both.

use super::condition::Condition;
use super::follow::{DescentBranch, DesignMotion};
use super::objective::{DesignQuantity, Least, Objective, Requirement};
use super::problem::Problem;
use super::task::Task;
use super::variables::{VariableInstants, instants};
use crate::error::SolveError;
use crate::measure::Needs;
use crate::model::Model;
use crate::results::varied::{Number, Varied, WIDTH};
use crate::scalar::Scalar;

/// A number with its derivatives with respect to all variables.
#[derive(Clone, Debug)]
pub(crate) struct Differentiated {
    pub(crate) value: f64,
    pub(crate) by: Vec<f64>,
}

/// The misses of a design, and the slacks of its conditions.
#[derive(Clone, Debug, Default)]
pub(crate) struct Evaluated {
    pub(crate) misses: Vec<Differentiated>,
    /// The sum of the values that are to be least.
    pub(crate) least: f64,
    /// Positive where a condition holds; of the order of 1 far from its limit.
    pub(crate) slacks: Vec<Differentiated>,
    /// For every slack, its condition.
    pub(crate) conditions: Vec<usize>,
    /// The instants of every objective.
    pub(crate) times: Vec<Vec<f64>>,
}

impl Problem<'_> {
    /// All misses and slacks, with derivatives if `slopes`.
    ///
    /// # Errors
    /// Why the mechanism does not assemble all the way, or that the search has been stopped.
    pub(crate) fn evaluate(
        &self,
        variables: &[f64],
        branch: &DescentBranch,
        slopes: bool,
    ) -> Result<Evaluated, SolveError> {
        self.go_on()?;
        let motion = self.motion(variables, branch);
        let rows = MotionRows { motion: &motion, task: self.task, slopes, variables: variables.len() };
        rows.evaluated(variables, branch.forward)
    }
}

/// Misses and slacks of a mechanism that is followed.
struct MotionRows<'f> {
    motion: &'f DesignMotion<'f>,
    task: &'f Task,
    slopes: bool,
    variables: usize,
}

impl MotionRows<'_> {
    fn evaluated(&self, variables: &[f64], forward: bool) -> Result<Evaluated, SolveError> {
        let Task { free, objectives, conditions, .. } = self.task;
        let mut evaluated = Evaluated::default();
        let mut first = free.len();
        // Sums of parameters are evaluated first, at little cost: a design that violates one is not followed.
        for (index, condition) in conditions.iter().enumerate() {
            if let Condition::Sum { terms, least, .. } = condition {
                evaluated.slacks.push(self.sum(terms, *least));
                evaluated.conditions.push(index);
            }
        }
        if evaluated.slacks.iter().any(|slack| slack.value <= 0.0) {
            return Ok(evaluated);
        }
        for objective in objectives {
            let instants = instants(objective, variables, first, forward);
            if instants.moved_by.is_some() {
                evaluated.slacks.push(self.rest(variables, first, objective.variables()));
                evaluated.conditions.push(usize::MAX);
                if evaluated.slacks.last().is_some_and(|slack| slack.value <= 0.0) {
                    return Ok(evaluated);
                }
            }
            first += objective.variables();
            match &objective.wanted {
                Requirement::Least(of) => evaluated.least += self.least(objective, &instants, of)?,
                _ => self.objective(objective, &instants, &mut evaluated.misses)?,
            }
            evaluated.times.push(instants.times);
        }
        for (index, condition) in conditions.iter().enumerate() {
            let before = evaluated.slacks.len();
            match condition {
                Condition::Sum { .. } => {}
                Condition::Margins { times, least } => self.margins(times, *least, &mut evaluated.slacks)?,
                Condition::Range { quantity, low, high, times, .. } => {
                    self.range(times, quantity, [*low, *high], &mut evaluated.slacks)?;
                }
            }
            evaluated.conditions.resize(evaluated.conditions.len() + evaluated.slacks.len() - before, index);
        }
        Ok(evaluated)
    }

    /// A row without derivatives.
    fn row(&self, value: f64) -> Differentiated {
        Differentiated { value, by: if self.slopes { vec![0.0; self.variables] } else { Vec::new() } }
    }

    /// Adds the derivatives with respect to the parameters that vary, from the index `first` on.
    fn add(&self, row: &mut Differentiated, first: usize, number: Number) {
        if self.slopes {
            for (by, &(variable, width)) in number.by().iter().zip(&self.motion.moved_by[first..]) {
                row.by[variable] += width * by;
            }
        }
    }

    /// Σ factor · parameter − least, relative to the widths of the parameters' bounds.
    fn sum(&self, terms: &[(usize, f64)], least: f64) -> Differentiated {
        let free = |index: usize| self.task.free.iter().position(|free| free.indices.contains(&index));
        let width = |index: usize| free(index).map_or(0.0, |free| self.task.free[free].width());
        let size: f64 = terms.iter().map(|(index, factor)| factor.abs() * width(*index)).sum();
        let size = if size > 0.0 { size } else { 1.0 };
        let value = terms.iter().map(|(index, factor)| factor * self.motion.parameters[*index]).sum::<f64>() - least;
        let mut row = self.row(value / size);
        for (index, factor) in terms {
            if let (Some(variable), true) = (free(*index), self.slopes) {
                row.by[variable] += factor * width(*index) / size;
            }
        }
        row
    }

    /// The part of a period that the gaps leave.
    fn rest(&self, variables: &[f64], first: usize, count: usize) -> Differentiated {
        let gaps = first + 1..first + count;
        let mut row = self.row(1.0 - variables[gaps.clone()].iter().sum::<f64>());
        row.by.iter_mut().enumerate().filter(|(k, _)| gaps.contains(k)).for_each(|(_, by)| *by = -1.0);
        row
    }

    fn objective(
        &self,
        objective: &Objective,
        at: &VariableInstants,
        misses: &mut Vec<Differentiated>,
    ) -> Result<(), SolveError> {
        match &objective.wanted {
            Requirement::Values(values, weights) => self.values(objective, at, (values, weights), misses),
            Requirement::Zeros(residuals) => {
                let chunks = if self.slopes { self.motion.moved_by.len().div_ceil(WIDTH) } else { 1 };
                let mut seen = vec![vec![Vec::new(); at.times.len()]; chunks];
                self.motion.each(&at.times, self.slopes, objective.needs(), &mut |instant, first, varied| {
                    let numbers = objective.quantities.iter().map(|quantity| quantity.varied(self.task.model, varied));
                    seen[first / WIDTH][instant] = numbers.map(|number| number.unwrap_or(UNKNOWN)).collect();
                })?;
                let begin = misses.len();
                for (chunk, seen) in seen.iter().enumerate() {
                    for (index, number) in residuals(seen).into_iter().enumerate() {
                        if chunk == 0 {
                            misses.push(self.row(number.value()));
                        }
                        if let Some(row) = misses.get_mut(begin + index) {
                            self.add(row, chunk * WIDTH, number);
                        }
                    }
                }
                Ok(())
            }
            Requirement::Least(_) => Ok(()),
        }
    }

    /// A number that is to be least.
    fn least(&self, objective: &Objective, at: &VariableInstants, function: &Least) -> Result<f64, SolveError> {
        let mut seen = vec![Vec::new(); at.times.len()];
        self.motion.each(&at.times, false, objective.needs(), &mut |instant, _, varied| {
            let values = objective.quantities.iter().map(|quantity| quantity.varied(self.task.model, varied));
            seen[instant] = values.map(|number| number.map_or(f64::NAN, Number::value)).collect();
        })?;
        Ok(function(&seen))
    }

    /// Quantities that are to have values.
    fn values(
        &self,
        objective: &Objective,
        at: &VariableInstants,
        (values, weights): (&[Vec<f64>], &[f64]),
        misses: &mut Vec<Differentiated>,
    ) -> Result<(), SolveError> {
        let (begin, count) = (misses.len(), objective.quantities.len());
        self.motion.each(&at.times, self.slopes, objective.needs(), &mut |instant, first, varied| {
            for (index, quantity) in objective.quantities.iter().enumerate() {
                let number = quantity.varied(self.task.model, varied).unwrap_or(UNKNOWN);
                let weight = weights[index];
                if first == 0 {
                    let mut row = self.row(weight * quantity.miss(number.value(), values[instant][index]));
                    if let (Some(chain), true) = (at.moved_by, self.slopes) {
                        let rate = weight * quantity.rate(self.task.model, varied);
                        chain.moving(instant).for_each(|(variable, factor)| row.by[variable] += rate * factor);
                    }
                    misses.push(row);
                }
                self.add(&mut misses[begin + instant * count + index], first, number * Number::from_f64(weight));
            }
        })
    }

    /// Slacks at instants: those that `write_slacks` writes from the numbers there.
    fn slacks(
        &self,
        times: &[f64],
        needs: Needs,
        slacks: &mut Vec<Differentiated>,
        write_slacks: &dyn Fn(&Varied, &mut Vec<Number>),
    ) -> Result<(), SolveError> {
        let (mut begin, mut numbers) = (slacks.len(), Vec::new());
        self.motion.each(times, self.slopes, needs, &mut |_, first, varied| {
            numbers.clear();
            write_slacks(varied, &mut numbers);
            if first == 0 {
                begin = slacks.len();
                slacks.extend(numbers.iter().map(|number| self.row(number.value())));
            }
            for (row, number) in slacks[begin..].iter_mut().zip(&numbers) {
                self.add(row, first, *number);
            }
        })
    }

    fn margins(&self, times: &[f64], least: f64, slacks: &mut Vec<Differentiated>) -> Result<(), SolveError> {
        self.slacks(times, Needs::LEAST, slacks, &|varied, out| margin_slacks(varied, least, out))
    }

    fn range(
        &self,
        times: &[f64],
        quantity: &DesignQuantity,
        ends: [f64; 2],
        slacks: &mut Vec<Differentiated>,
    ) -> Result<(), SolveError> {
        self.slacks(times, quantity.needs(), slacks, &|varied, out| {
            range_slacks(self.task.model, varied, quantity, ends, out)
        })
    }
}

/// By how much margins are above the least.
pub(crate) fn margin_slacks(varied: &Varied, least: f64, out: &mut Vec<Number>) {
    out.extend(varied.margins.iter().map(|margin| *margin - Number::from_f64(least)));
}

/// How far a quantity is from the ends of a range, relative to its width.
pub(crate) fn range_slacks(
    model: &Model,
    varied: &Varied,
    quantity: &DesignQuantity,
    [low, high]: [f64; 2],
    out: &mut Vec<Number>,
) {
    let number = Number::from_f64;
    let size = number(if (high - low).is_finite() { high - low } else { 1.0 });
    let value = quantity.varied(model, varied).unwrap_or(UNKNOWN);
    if low.is_finite() {
        out.push((value - number(low)) / size);
    }
    if high.is_finite() {
        out.push((number(high) - value) / size);
    }
}

/// The number of a quantity without a value.
const UNKNOWN: Number = Number::new(f64::NAN, [f64::NAN; WIDTH]);
