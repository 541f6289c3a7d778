//! Tolerances of parameters, and the deviations that they cause along a motion.

use super::engine::Engine;
use super::failure::{Failure, Ledger};
use super::names::{NameKind, find};
use super::number::Measured;
use super::setup::Setup;
use super::solved::analysis;
use super::values;
use crate::measure::Measure;
use crate::model::Model;
use crate::sensitivities::Deviation;
use crate::state::State;

/// A tolerance for every parameter, 0 where none is given.
pub(super) fn tolerances(texts: &[String], model: &Model) -> Result<Vec<f64>, Failure> {
    const OPTION: &str = "--tolerance";
    let mut all = vec![0.0; model.parameters.len()];
    let mut ledger = Ledger::default();
    let example = values::example_of(NameKind::Parameter, model, "0.001");
    for (name, value) in ledger.take(values::assignments(OPTION, &example, texts)).unwrap_or_default() {
        // If the name is no parameter, its unit is not known.
        let Some(index) = ledger.take(find(model, OPTION, NameKind::Parameter, &name)) else { continue };
        let option = format!("{OPTION} {name}");
        match ledger.take(values::number(&option, &value, Measured::parameter(model, &name))) {
            Some(value) if value >= 0.0 => all[index] = value,
            Some(_) => {
                ledger.fault(&option, format!("`{value}` is negative; a tolerance is a deviation to either side"))
            }
            None => {}
        }
    }
    ledger.close(Some(all))
}

/// Why a quantity has no derivative anywhere.
const NO_DERIVATIVE: &str = "has no derivatives by dimensions here: efforts of inputs and of given coordinates, \
                             velocity ratios, and quantities that are undetermined or not defined have none";

/// Derivatives of quantities at the states of a motion.
pub(super) struct Slopes {
    /// For every state and every quantity, a number per parameter; NaN where there is none.
    numbers: Vec<Vec<Vec<f64>>>,
}

impl Slopes {
    /// Derivatives with respect to all parameters. At a state that has none, such as a limit, they are NaN; if none of the
    /// states has any, that is an error.
    pub(super) fn along(
        engine: &dyn Engine,
        setup: &Setup,
        states: &[State],
        measures: &[Measure],
        degrees: bool,
    ) -> Result<Self, Failure> {
        let all: Vec<usize> = (0..engine.model().parameters.len()).collect();
        let mut refused = Vec::new();
        let at = |state: &State| {
            let found = engine.measure_sensitivities(setup, state, measures, &all);
            let mut found = found.unwrap_or_else(|error| {
                refused.push(error);
                vec![vec![f64::NAN; all.len()]; measures.len()]
            });
            if degrees {
                for (by, measure) in found.iter_mut().zip(measures) {
                    by.iter_mut().for_each(|by| *by *= measure.in_degrees());
                }
            }
            found
        };
        let numbers: Vec<_> = states.iter().map(at).collect();
        match refused.first() {
            Some(error) if refused.len() == states.len() => Err(analysis(engine, error)),
            _ => Ok(Self { numbers }),
        }
    }

    /// The quantities that have no derivative at any state.
    pub(super) fn missing<'m>(&self, measures: &'m [Measure]) -> Vec<&'m str> {
        let is_missing =
            |k: usize| self.numbers.iter().all(|at| !at[k].is_empty() && at[k].iter().all(|by| by.is_nan()));
        let missing = measures.iter().enumerate().filter(|(k, _)| !self.numbers.is_empty() && is_missing(*k));
        missing.map(|(_, measure)| measure.name()).collect()
    }

    /// The error for the first of the quantities that has no derivative at any state.
    pub(super) fn all_exist(&self, model: &Model, measures: &[Measure]) -> Result<(), Failure> {
        match self.missing(measures).first() {
            None => Ok(()),
            Some(name) => Err(Failure::Analysis(format!("{}: `{name}` {NO_DERIVATIVE}", model.name))),
        }
    }

    /// The derivatives of a quantity with respect to a parameter, state by state.
    pub(super) fn by(&self, quantity: usize, parameter: usize) -> impl Iterator<Item = f64> + '_ {
        self.numbers.iter().map(move |at| at[quantity][parameter])
    }

    /// The deviations of a quantity that tolerances cause, state by state. A parameter without a tolerance contributes
    /// none.
    pub(super) fn deviations(&self, quantity: usize, tolerances: &[f64]) -> Vec<Deviation> {
        let at = |at: &Vec<Vec<f64>>| {
            let given = at[quantity].iter().zip(tolerances).filter(|(_, tolerance)| **tolerance != 0.0);
            Deviation::of(given.map(|(by, tolerance)| by * tolerance))
        };
        self.numbers.iter().map(at).collect()
    }
}
