//! The variables of a search: free parameters, then the instants of paths without timing, all between 0 and 1.

use super::error::DesignError;
use super::objective::{Direction, Objective};
use crate::model::Model;

/// A free parameter, with those that are equal to it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Free {
    pub(crate) indices: Vec<usize>,
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl Free {
    pub(crate) const fn width(&self) -> f64 {
        self.high - self.low
    }

    /// A variable within the bounds or, as `near` goes from 0 to 1, within the part of them that is no more than twice
    /// as wide as `size`, around the number nearest to 0; `share` is the position in that part.
    pub(crate) fn drawn(&self, size: f64, near: f64, share: f64) -> f64 {
        let least = (2.0 * size / self.width()).clamp(1e-6, 1.0);
        let part = least.powf(near);
        let centre = (0.0_f64.clamp(self.low, self.high) - self.low) / self.width();
        let start = (centre - 0.5 * part).clamp(0.0, 1.0 - part);
        start + part * share
    }
}

/// The index of a parameter.
pub(crate) fn parameter_index(model: &'static Model, parameter: &str) -> Result<usize, DesignError> {
    let parameters = model.parameters;
    parameters.iter().position(|info| info.name == parameter).ok_or_else(|| DesignError::UnknownParameter {
        parameter: parameter.to_owned(),
        parameters: parameters.iter().map(|info| info.name).collect(),
    })
}

/// Instants with their derivatives: of which variables each is a sum, and by which factor.
pub(crate) struct VariableInstants {
    pub(crate) times: Vec<f64>,
    /// How the instants follow from variables; none where they are given.
    pub(crate) moved_by: Option<Chain>,
}

/// How the instants of a path follow from variables: the first from one of them, every other from the one before and a gap.
#[derive(Clone, Copy)]
pub(crate) struct Chain {
    /// The place of the first instant among the variables; the gaps follow.
    pub(crate) first: usize,
    pub(crate) period: f64,
    pub(crate) sign: f64,
}

impl Chain {
    /// The variables that move the instant at a place, with ∂t/∂variable.
    pub(crate) fn moving(self, index: usize) -> impl Iterator<Item = (usize, f64)> {
        let gaps = (1..=index).map(move |k| (self.first + k, self.sign * self.period));
        core::iter::once((self.first, FIRST * self.period)).chain(gaps)
    }
}

/// Number of periods within which the first instant may lie, with the first period in the middle, so that an instant in
/// that period is never at a bound.
pub(crate) const FIRST: f64 = 3.0;

/// The instants of an objective; `first` is the place of its own variables.
pub(crate) fn instants(objective: &Objective, variables: &[f64], first: usize, forward: bool) -> VariableInstants {
    let Some(free) = &objective.free else {
        return VariableInstants { times: objective.times.clone(), moved_by: None };
    };
    let is_forward = match free.direction {
        Direction::Forward => true,
        Direction::Backward => false,
        Direction::Either => forward,
    };
    let chain = Chain { first, period: free.period, sign: if is_forward { 1.0 } else { -1.0 } };
    let mut t = FIRST * free.period * (variables[first] - 1.0 / FIRST);
    let mut times = vec![t];
    for gap in &variables[first + 1..first + objective.instants()] {
        t += chain.sign * free.period * gap;
        times.push(t);
    }
    VariableInstants { times, moved_by: Some(chain) }
}
