//! What a design asks of a mechanism, without the mechanism's type.

use super::condition::{Condition, Shortest};
use super::error::DesignError;
use super::objective::{DesignQuantity, Direction, Least, Objective, Residuals};
use super::variables::{Free, parameter_index};
use crate::model::Model;
use crate::planned::Sign;
use core::ops::RangeInclusive;

/// Free parameters, objectives and conditions of a mechanism with this model. It is compiled once, and not again for
/// every mechanism.
#[derive(Clone)]
pub(crate) struct Task {
    pub(crate) model: &'static Model,
    /// The parameters with which the search begins.
    pub(crate) parameters: Vec<f64>,
    pub(crate) free: Vec<Free>,
    pub(crate) objectives: Vec<Objective>,
    pub(crate) conditions: Vec<Condition>,
    /// Indices of modes; both signs are tried where none is prescribed.
    pub(crate) modes: Vec<(usize, Option<Sign>)>,
    pub(crate) guesses: Vec<(usize, f64)>,
}

impl Task {
    /// A task without requirements.
    pub(crate) fn new(model: &'static Model, parameters: Vec<f64>) -> Self {
        Self {
            model,
            parameters,
            free: Vec::new(),
            objectives: Vec::new(),
            conditions: Vec::new(),
            modes: Vec::new(),
            guesses: Vec::new(),
        }
    }

    /// Lets a parameter vary within bounds.
    pub(crate) fn free(&mut self, parameter: &str, bounds: RangeInclusive<f64>) -> Result<(), DesignError> {
        let (low, high) = bounds.into_inner();
        let index = parameter_index(self.model, parameter)?;
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(DesignError::Bounds { parameter: parameter.to_owned(), low, high });
        }
        self.is_new(index, parameter)?;
        self.free.push(Free { indices: vec![index], low, high });
        Ok(())
    }

    /// Keeps a parameter equal to one that is free.
    pub(crate) fn equal(&mut self, parameter: &str, to: &str) -> Result<(), DesignError> {
        let (index, leader) = (parameter_index(self.model, parameter)?, parameter_index(self.model, to)?);
        let Some(leader) = self.free.iter().position(|free| free.indices.contains(&leader)) else {
            return Err(DesignError::NotFree { parameter: to.to_owned() });
        };
        self.is_new(index, parameter)?;
        self.free[leader].indices.push(index);
        Ok(())
    }

    /// An error if a parameter has bounds or is kept equal already.
    fn is_new(&self, index: usize, parameter: &str) -> Result<(), DesignError> {
        match self.free.iter().any(|free| free.indices.contains(&index)) {
            true => Err(DesignError::Twice { parameter: parameter.to_owned() }),
            false => Ok(()),
        }
    }

    /// Prescribes the sign of a mode by its name, or that both are tried.
    pub(crate) fn mode(&mut self, mode: &str, sign: Option<Sign>) -> Result<(), DesignError> {
        let modes = self.model.plan.modes;
        let Some(index) = modes.iter().position(|info| info.name == mode) else {
            let modes = modes.iter().map(|info| info.name).collect();
            return Err(DesignError::UnknownMode { mode: mode.to_owned(), modes });
        };
        self.prescribe(index, sign);
        Ok(())
    }

    /// Prescribes the sign of the mode with this index, or that both are tried.
    pub(crate) fn prescribe(&mut self, index: usize, sign: Option<Sign>) {
        self.modes.retain(|(other, _)| *other != index);
        self.modes.push((index, sign));
    }

    /// A point at places at given instants.
    pub(crate) fn path_at(&mut self, point: &str, places: &[(f64, [f64; 2])]) -> Result<(), DesignError> {
        let axes = DesignQuantity::point(self.model, point)?;
        let wanted = places.iter().map(|(t, place)| (*t, place.to_vec()));
        self.objectives.push(Objective::timed(axes, vec![1.0; 2], wanted)?);
        Ok(())
    }

    /// A point at places in their order, at any instants of a period.
    pub(crate) fn path(
        &mut self,
        point: &str,
        places: &[[f64; 2]],
        period: f64,
        direction: Direction,
    ) -> Result<(), DesignError> {
        let axes = DesignQuantity::point(self.model, point)?;
        let places = places.iter().map(|place| place.to_vec()).collect();
        self.objectives.push(Objective::untimed(axes, places, period, direction)?);
        Ok(())
    }

    /// A quantity with values at given instants.
    pub(crate) fn function(&mut self, quantity: &str, values: &[(f64, f64)]) -> Result<(), DesignError> {
        let measured = DesignQuantity::named(self.model, quantity)?;
        let wanted = values.iter().map(|&(t, value)| (t, vec![value]));
        self.objectives.push(Objective::timed(vec![measured], vec![1.0], wanted)?);
        Ok(())
    }

    /// A body in poses at given instants.
    pub(crate) fn poses(&mut self, body: &str, poses: &[(f64, [f64; 3])], arm: f64) -> Result<(), DesignError> {
        let axes = DesignQuantity::pose(self.model, body)?;
        let wanted = poses.iter().map(|(t, pose)| (*t, pose.to_vec()));
        self.objectives.push(Objective::timed(axes, vec![1.0, 1.0, arm], wanted)?);
        Ok(())
    }

    /// Numbers that are to be 0.
    pub(crate) fn residuals(
        &mut self,
        quantities: &[&str],
        times: &[f64],
        residuals: Residuals,
    ) -> Result<(), DesignError> {
        let measured = self.quantities(quantities)?;
        self.objectives.push(Objective::zeros(measured, times, residuals)?);
        Ok(())
    }

    /// A number that is to be least.
    pub(crate) fn least(&mut self, quantities: &[&str], times: &[f64], least: Least) -> Result<(), DesignError> {
        let measured = self.quantities(quantities)?;
        self.objectives.push(Objective::least(measured, times, least)?);
        Ok(())
    }

    fn quantities(&self, names: &[&str]) -> Result<Vec<DesignQuantity>, DesignError> {
        names.iter().map(|name| DesignQuantity::named(self.model, name)).collect()
    }

    /// A sum of multiples of parameters that is no less than this.
    pub(crate) fn at_least(&mut self, terms: &[(&str, f64)], least: f64) -> Result<(), DesignError> {
        self.conditions.push(Condition::sum(self.model, terms, least)?);
        Ok(())
    }

    /// Grashof's condition.
    pub(crate) fn grashof(&mut self, lengths: [&str; 4], shortest: Shortest) -> Result<(), DesignError> {
        self.conditions.extend(Condition::grashof(self.model, lengths, shortest)?);
        Ok(())
    }

    /// Margins of the plan over a period.
    pub(crate) fn turns(&mut self, period: f64, instants: usize, least: f64) -> Result<(), DesignError> {
        self.conditions.push(Condition::turns(period, instants, least)?);
        Ok(())
    }

    /// A quantity within a range over a period.
    pub(crate) fn range(
        &mut self,
        quantity: &str,
        range: RangeInclusive<f64>,
        period: f64,
        instants: usize,
    ) -> Result<(), DesignError> {
        let measured = DesignQuantity::named(self.model, quantity)?;
        self.conditions.push(Condition::range(quantity.to_owned(), measured, range, period, instants)?);
        Ok(())
    }

    /// The transmission angles of a joint over a period.
    pub(crate) fn transmission(
        &mut self,
        joint: &str,
        least: f64,
        period: f64,
        instants: usize,
    ) -> Result<(), DesignError> {
        self.conditions.extend(Condition::transmission(self.model, joint, least, period, instants)?);
        Ok(())
    }

    /// The parameters of the mechanism with these variables.
    pub(crate) fn parameters_at(&self, variables: &[f64]) -> Vec<f64> {
        let mut parameters = self.parameters.clone();
        for (free, variable) in self.free.iter().zip(variables) {
            for &index in &free.indices {
                parameters[index] = free.low + free.width() * variable;
            }
        }
        parameters
    }

    /// The names and values of the parameters that vary.
    pub(crate) fn varied(&self, parameters: &[f64]) -> Vec<(&'static str, f64)> {
        let indices = self.free.iter().flat_map(|free| free.indices.iter().copied());
        indices.map(|index| (self.model.parameters[index].name, parameters[index])).collect()
    }
}
