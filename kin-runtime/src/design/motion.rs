//! A design evaluated: by how much its motion misses what is wanted, its slacks, and the derivatives of both.

use super::builder::Design;
use super::condition::Condition;
use super::objective::{Goal, Objective, Quantity};
use super::variables::{Instants, instants};
use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::motion::Motion;
use crate::planned::Sign;
use crate::sensitivity::{Number, Varied, Varying};
use crate::solver::Solver;
use crate::state::State;

/// A number with its derivatives by all variables.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) value: f64,
    pub(crate) by: Vec<f64>,
}

/// What a design misses, and what is left of its conditions.
#[derive(Clone, Debug, Default)]
pub(crate) struct Evaluated {
    pub(crate) misses: Vec<Row>,
    /// Positive where a condition holds; of the order of 1 far from its limit.
    pub(crate) slacks: Vec<Row>,
    /// For every slack, its condition.
    pub(crate) conditions: Vec<usize>,
    /// The instants of every objective.
    pub(crate) times: Vec<Vec<f64>>,
}

/// What is fixed in one descent: the signs of modes, and the directions of paths.
#[derive(Clone, Debug)]
pub(crate) struct Branch {
    pub(crate) modes: Vec<(usize, Sign)>,
    pub(crate) forward: bool,
}

impl<M: Mechanism> Design<M> {
    /// The sum of squares of what is wanted: errors are measured by it.
    pub(crate) fn wanted(&self) -> f64 {
        let goals = self.objectives.iter().flat_map(|objective| objective.goals.iter().flatten());
        goals.map(|goal| (goal.weight * goal.value).powi(2)).sum()
    }

    /// The largest of the values that are wanted.
    pub(crate) fn size(&self) -> f64 {
        let goals = self.objectives.iter().flat_map(|objective| objective.goals.iter().flatten());
        goals.map(|goal| (goal.weight * goal.value).abs()).fold(0.0, f64::max)
    }

    /// The mechanism with which the search begins.
    pub(crate) fn mechanism(&self) -> M {
        let mut mechanism = (self.make)();
        for (place, value) in self.parameters.iter().enumerate() {
            mechanism.set_parameter(place, *value);
        }
        mechanism
    }

    /// The mechanism with these variables.
    pub(crate) fn mechanism_at(&self, variables: &[f64]) -> M {
        let mut mechanism = self.mechanism();
        for (free, variable) in self.free.iter().zip(variables) {
            for &place in &free.places {
                mechanism.set_parameter(place, free.low + free.width() * variable);
            }
        }
        mechanism
    }

    /// All misses and slacks, with derivatives where they are wanted.
    ///
    /// # Errors
    /// Why the mechanism does not assemble all the way.
    pub(crate) fn evaluate(&self, variables: &[f64], branch: &Branch, slopes: bool) -> Result<Evaluated, SolveError> {
        let mechanism = self.mechanism_at(variables);
        let follow = Follow { design: self, mechanism: &mechanism, branch, slopes, variables: variables.len() };
        let mut evaluated = Evaluated::default();
        let mut first = self.free.len();
        let parameters = mechanism.parameters::<f64>();
        // Sums of parameters cost nothing: what they rule out is not followed.
        for (place, condition) in self.conditions.iter().enumerate() {
            if let Condition::Sum { terms, least, .. } = condition {
                evaluated.slacks.push(follow.sum(parameters.as_ref(), terms, *least));
                evaluated.conditions.push(place);
            }
        }
        if evaluated.slacks.iter().any(|slack| slack.value <= 0.0) {
            return Ok(evaluated);
        }
        for objective in &self.objectives {
            let instants = instants(objective, variables, first, branch.forward);
            if instants.moved_by.is_some() {
                evaluated.slacks.push(follow.rest(variables, first, objective.variables()));
                evaluated.conditions.push(usize::MAX);
                if evaluated.slacks.last().is_some_and(|slack| slack.value <= 0.0) {
                    return Ok(evaluated);
                }
            }
            first += objective.variables();
            follow.objective(objective, &instants, &mut evaluated.misses)?;
            evaluated.times.push(instants.times);
        }
        for (place, condition) in self.conditions.iter().enumerate() {
            let before = evaluated.slacks.len();
            match condition {
                Condition::Sum { .. } => {}
                Condition::Margins { times, least } => follow.margins(times, *least, &mut evaluated.slacks)?,
                Condition::Range { of, low, high, times, .. } => {
                    follow.range(times, *of, [*low, *high], &mut evaluated.slacks)?;
                }
            }
            evaluated.conditions.resize(evaluated.conditions.len() + evaluated.slacks.len() - before, place);
        }
        Ok(evaluated)
    }
}

/// A mechanism that is followed.
struct Follow<'d, M: Mechanism> {
    design: &'d Design<M>,
    mechanism: &'d M,
    branch: &'d Branch,
    slopes: bool,
    variables: usize,
}

/// A state, with what else is known there.
struct Seen {
    state: State,
    motion: Option<Motion>,
    /// What varies, for as many parameters at once as a number carries.
    by: Vec<Varied>,
}

impl Seen {
    /// The derivative of a number by a parameter among those that vary.
    fn by(&self, parameter: usize, of: impl Fn(&Varied) -> Option<Number>) -> f64 {
        let chunk = self.by.get(parameter / Number::LANES);
        chunk.and_then(of).map_or(0.0, |number| number.by()[parameter % Number::LANES])
    }
}

impl<M: Mechanism> Follow<'_, M> {
    fn solver(&self) -> Solver<'_, M> {
        let solver = Solver::new(self.mechanism);
        let solver = self.design.guesses.iter().fold(solver, |solver, &(place, value)| solver.with_guess(place, value));
        self.branch.modes.iter().fold(solver, |solver, &(place, sign)| solver.with_mode(place, sign))
    }

    /// The motion over these instants.
    fn seen(&self, times: &[f64], with_motion: bool) -> Result<Vec<Seen>, SolveError> {
        let solver = self.solver();
        let trajectory = solver.sweep(times).map_err(|error| error.source)?;
        let places: Vec<usize> = self.design.free.iter().flat_map(|free| free.places.iter().copied()).collect();
        let mut varying = Varying::new(self.mechanism);
        let see = |state: State| {
            let motion = with_motion.then(|| solver.motion(&state)).transpose()?;
            let mut by = Vec::new();
            if self.slopes {
                solver.vary(&mut varying, &state, &places, &mut |_, _, varied| {
                    by.push(varied.clone());
                    Ok(())
                })?;
            }
            Ok(Seen { state, motion, by })
        };
        trajectory.states.into_iter().map(see).collect()
    }

    /// A row by the free parameters, given its derivative by any parameter among those that vary.
    fn row(&self, value: f64, derivative: impl Fn(usize) -> f64) -> Row {
        let mut by = if self.slopes { vec![0.0; self.variables] } else { Vec::new() };
        let mut place = 0;
        for (free, by) in self.design.free.iter().zip(&mut by) {
            for _ in &free.places {
                *by += free.width() * derivative(place);
                place += 1;
            }
        }
        Row { value, by }
    }

    /// Σ factor · parameter − least, in the size of the parameters' bounds.
    fn sum(&self, parameters: &[f64], terms: &[(usize, f64)], least: f64) -> Row {
        let free = |place: usize| self.design.free.iter().find(|free| free.places.contains(&place));
        let size: f64 = terms.iter().filter_map(|(place, factor)| Some(factor.abs() * free(*place)?.width())).sum();
        let size = if size > 0.0 { size } else { 1.0 };
        let value = terms.iter().map(|(place, factor)| factor * parameters[*place]).sum::<f64>() - least;
        let places: Vec<usize> = self.design.free.iter().flat_map(|free| free.places.iter().copied()).collect();
        let factor = |k: usize| terms.iter().filter(|(place, _)| *place == places[k]).map(|(_, factor)| factor).sum();
        let mut row = self.row(value, factor);
        row.value /= size;
        row.by.iter_mut().for_each(|by| *by /= size);
        row
    }

    /// What gaps leave of a period.
    fn rest(&self, variables: &[f64], first: usize, count: usize) -> Row {
        let gaps = first + 1..first + count;
        let mut row = self.row(1.0 - variables[gaps.clone()].iter().sum::<f64>(), |_| 0.0);
        row.by.iter_mut().enumerate().filter(|(k, _)| gaps.contains(k)).for_each(|(_, by)| *by = -1.0);
        row
    }

    fn objective(&self, objective: &Objective, at: &Instants, misses: &mut Vec<Row>) -> Result<(), SolveError> {
        let with_motion = objective.goals.iter().flatten().any(|goal| goal.of.needs_motion());
        let seen = self.seen(&at.times, with_motion)?;
        for (place, (seen, goals)) in seen.iter().zip(&objective.goals).enumerate() {
            for Goal { of, value, weight } in goals {
                let (found, rate) = of.at(&seen.state, seen.motion.as_ref());
                let slope = |k: usize| weight * seen.by(k, |varied| of.varied(seen.state.model, varied));
                let mut row = self.row(weight * of.miss(found, *value), slope);
                if let (Some(chain), true) = (at.moved_by, self.slopes) {
                    chain.moving(place).for_each(|(variable, factor)| row.by[variable] += weight * rate * factor);
                }
                misses.push(row);
            }
        }
        Ok(())
    }

    fn margins(&self, times: &[f64], least: f64, slacks: &mut Vec<Row>) -> Result<(), SolveError> {
        // Margins come with derivatives.
        let with_slopes = Follow { slopes: true, ..*self };
        for seen in &with_slopes.seen(times, false)? {
            let Some(first) = seen.by.first() else { continue };
            for (place, margin) in first.margins.iter().enumerate() {
                let slope = |k: usize| seen.by(k, |varied| varied.margins.get(place).copied());
                slacks.push(self.row(margin.value() - least, slope));
            }
        }
        Ok(())
    }

    fn range(
        &self,
        times: &[f64],
        of: Quantity,
        [low, high]: [f64; 2],
        slacks: &mut Vec<Row>,
    ) -> Result<(), SolveError> {
        let size = if (high - low).is_finite() { high - low } else { 1.0 };
        for seen in &self.seen(times, of.needs_motion())? {
            let (value, _) = of.at(&seen.state, seen.motion.as_ref());
            let slope = |k: usize| seen.by(k, |varied| of.varied(seen.state.model, varied)) / size;
            if low.is_finite() {
                slacks.push(self.row((value - low) / size, slope));
            }
            if high.is_finite() {
                slacks.push(self.row((high - value) / size, |k| -slope(k)));
            }
        }
        Ok(())
    }
}
