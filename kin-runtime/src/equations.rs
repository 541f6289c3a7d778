//! The equations of one analysis: the mechanism's rows, then one row per prescribed coordinate, at a current instant.

use crate::error::SolveError;
use crate::mechanism::LengthError;
use crate::model::{Level, Model};
use crate::options::Options;
use crate::scale::Scale;
use crate::system::System;
use crate::workspace::{Instant, Signal, Subset};
use nalgebra::{DMatrix, DVector};

/// A coordinate that the caller prescribes: the row q_k − value.
#[derive(Clone, Copy, Debug)]
struct Given {
    coordinate: usize,
    /// At the instant the analysis started from.
    start: Signal,
    /// At the current instant.
    now: Signal,
}

/// Inputs as functions of time.
pub(crate) type InputFunction<'a> = Option<&'a dyn Fn(f64, &mut [Signal])>;

/// Rows of the mechanism and of prescribed coordinates, with dense results in the rows' own units.
pub(crate) struct Equations<'a> {
    pub(crate) system: &'a mut dyn System,
    pub(crate) model: &'static Model,
    pub(crate) options: Options,
    pub(crate) scale: Scale,
    given: Vec<Given>,
    start_time: f64,
    input_function: InputFunction<'a>,
    /// Current time.
    pub(crate) t: f64,
    /// Inputs at the current time.
    pub(crate) inputs: Vec<Signal>,
    /// Φ.
    pub(crate) phi: DVector<f64>,
    /// Φ_q.
    pub(crate) jacobian: DMatrix<f64>,
    /// Φ_t.
    pub(crate) phi_t: DVector<f64>,
    /// γ.
    pub(crate) gamma: DVector<f64>,
    still: Vec<f64>,
}

impl<'a> Equations<'a> {
    /// The equations of `system` at `at`, with prescribed coordinates (place in q, signal at that instant).
    pub(crate) fn new(
        system: &'a mut dyn System,
        options: Options,
        given: &[(usize, Signal)],
        input_function: InputFunction<'a>,
        at: &Instant<'_>,
    ) -> Result<Self, SolveError> {
        let model = system.model();
        let n = model.coordinates.len();
        let rows = model.rows.len() + given.len();
        let mut jacobian = DMatrix::zeros(rows, n);
        for (k, &(coordinate, signal)) in given.iter().enumerate() {
            if coordinate >= n {
                return Err(SolveError::UnknownCoordinate { index: coordinate, coordinates: n });
            }
            let name = model.coordinates[coordinate].name;
            finite_signal("given", k, name, signal)?;
            jacobian[(model.rows.len() + k, coordinate)] = 1.0;
        }
        for (index, &value) in system.parameters().iter().enumerate() {
            let name = model.parameters.get(index).map_or("", |p| p.name);
            finite("parameters", index, name, value)?;
        }
        let mut equations = Self {
            system,
            model,
            options,
            scale: Scale::unit(rows, n),
            given: given.iter().map(|&(coordinate, start)| Given { coordinate, start, now: start }).collect(),
            start_time: at.t,
            input_function,
            t: at.t,
            inputs: Vec::new(),
            phi: DVector::zeros(rows),
            jacobian,
            phi_t: DVector::zeros(rows),
            gamma: DVector::zeros(rows),
            still: vec![0.0; n],
        };
        equations.set_instant(at)?;
        Ok(equations)
    }

    /// Number of coordinates n.
    pub(crate) fn coordinates(&self) -> usize {
        self.still.len()
    }

    /// Number of rows, prescribed coordinates included.
    pub(crate) fn rows(&self) -> usize {
        self.phi.len()
    }

    /// Number of prescribed coordinates; their rows are the last.
    pub(crate) fn given(&self) -> usize {
        self.given.len()
    }

    /// Name and value of the k-th prescribed coordinate.
    pub(crate) fn given_value(&self, k: usize) -> (&'static str, f64) {
        self.given.get(k).map_or(("", f64::NAN), |g| (self.model.coordinates[g.coordinate].name, g.now.value))
    }

    /// Name of a row.
    pub(crate) fn row_name(&self, row: usize) -> &'static str {
        match self.model.rows.get(row) {
            Some(info) => info.name,
            None => self.given_value(row - self.model.rows.len()).0,
        }
    }

    /// Joint of a row.
    pub(crate) fn joint_name(&self, row: usize) -> &'static str {
        self.model.rows.get(row).map_or("given", |info| self.model.joints.get(info.joint).map_or("", |j| j.name))
    }

    /// True for driving rows; prescribed coordinates drive.
    pub(crate) fn drives(&self, row: usize) -> bool {
        self.model.rows.get(row).is_none_or(|info| info.driving)
    }

    /// True for rows of position level.
    pub(crate) fn holonomic(&self, row: usize) -> bool {
        self.model.rows.get(row).is_none_or(|info| info.level == Level::Position)
    }

    /// The rows that satisfy a condition.
    pub(crate) fn rows_where(&self, condition: impl Fn(&Self, usize) -> bool) -> Vec<usize> {
        (0..self.rows()).filter(|&row| condition(self, row)).collect()
    }

    /// Moves to another instant; prescribed coordinates stay as they are.
    fn set_instant(&mut self, at: &Instant<'_>) -> Result<(), SolveError> {
        finite("t", 0, "t", at.t)?;
        length("inputs", self.model.inputs.len(), at.inputs.len())?;
        for (index, &signal) in at.inputs.iter().enumerate() {
            finite_signal("inputs", index, self.model.inputs[index], signal)?;
        }
        self.t = at.t;
        self.inputs.clear();
        self.inputs.extend_from_slice(at.inputs);
        Ok(())
    }

    /// Moves to another time: inputs follow their functions, prescribed coordinates go on with constant acceleration.
    pub(crate) fn set_time(&mut self, t: f64) -> Result<(), SolveError> {
        finite("t", 0, "t", t)?;
        self.t = t;
        let elapsed = t - self.start_time;
        for given in &mut self.given {
            given.now = given.start.after(elapsed);
        }
        let mut inputs = core::mem::take(&mut self.inputs);
        if let Some(function) = self.input_function {
            function(t, &mut inputs);
        }
        let checked = inputs
            .iter()
            .enumerate()
            .try_for_each(|(index, &signal)| finite_signal("inputs", index, self.model.inputs[index], signal));
        self.inputs = inputs;
        checked
    }

    /// Checks length and numbers of q or q̇.
    pub(crate) fn check(&self, what: &'static str, q: &[f64]) -> Result<(), SolveError> {
        length(what, self.coordinates(), q.len())?;
        for (index, &value) in q.iter().enumerate() {
            finite(what, index, self.model.coordinates[index].name, value)?;
        }
        Ok(())
    }

    /// Evaluates a subset at q and q̇ (`None` where γ is not asked for).
    pub(crate) fn evaluate(&mut self, subset: Subset, q: &[f64], q_dot: Option<&[f64]>) -> Result<(), SolveError> {
        let at = Instant { t: self.t, inputs: &self.inputs };
        self.system.evaluate(subset, &at, q, q_dot.unwrap_or(&self.still))?;
        let parts = self.system.constraints();
        let own = self.model.rows.len();
        if subset.phi {
            copy("Φ", self.model, parts.phi, &mut self.phi)?;
        }
        if subset.phi_t {
            copy("Φ_t", self.model, parts.phi_t, &mut self.phi_t)?;
        }
        if subset.gamma {
            copy("γ", self.model, parts.gamma, &mut self.gamma)?;
        }
        if subset.phi_q {
            let entries = self.model.constraint_pattern.entries;
            for (&(row, column), &value) in entries.iter().zip(parts.phi_q) {
                finite("Φ_q", row, self.model.rows.get(row).map_or("", |r| r.name), value)?;
                self.jacobian[(row, column)] = value;
            }
        }
        for (k, given) in self.given.iter().enumerate() {
            self.phi[own + k] = q[given.coordinate] - given.now.value;
            self.phi_t[own + k] = -given.now.rate;
            self.gamma[own + k] = given.now.acceleration;
        }
        Ok(())
    }

    /// Some rows of Φ_q, each on the common scale, columns in their own units.
    pub(crate) fn scaled_rows(&self, rows: &[usize]) -> DMatrix<f64> {
        DMatrix::from_fn(rows.len(), self.coordinates(), |i, j| self.jacobian[(rows[i], j)] * self.scale.rows[rows[i]])
    }

    /// Some rows of Φ_q, rows and columns on the common scale.
    pub(crate) fn scaled(&self, rows: &[usize]) -> DMatrix<f64> {
        let mut matrix = self.scaled_rows(rows);
        for (mut column, &scale) in matrix.column_iter_mut().zip(&self.scale.columns) {
            column *= scale;
        }
        matrix
    }
}

/// An error unless `value` is finite.
pub(crate) fn finite(what: &'static str, index: usize, name: &'static str, value: f64) -> Result<(), SolveError> {
    if value.is_finite() { Ok(()) } else { Err(SolveError::NonFinite { what, index, name }) }
}

/// An error unless all three numbers are finite.
fn finite_signal(what: &'static str, index: usize, name: &'static str, signal: Signal) -> Result<(), SolveError> {
    [signal.value, signal.rate, signal.acceleration].into_iter().try_for_each(|v| finite(what, index, name, v))
}

/// An error unless the lengths agree.
pub(crate) fn length(what: &'static str, expected: usize, found: usize) -> Result<(), SolveError> {
    if expected == found { Ok(()) } else { Err(SolveError::Length(LengthError { what, expected, found })) }
}

/// Copies the mechanism's rows and checks them.
fn copy(what: &'static str, model: &'static Model, from: &[f64], to: &mut DVector<f64>) -> Result<(), SolveError> {
    for (index, (&value, place)) in from.iter().zip(to.iter_mut()).enumerate() {
        finite(what, index, model.rows.get(index).map_or("", |r| r.name), value)?;
        *place = value;
    }
    Ok(())
}
