//! Comparison of closed forms with dual numbers, entry by entry.

use super::automatic::{Automatic, automatic};
use super::checked::Checked;
use super::configuration::Configuration;
use super::functions::FunctionChecks;
use super::result::CrossCheck;
use crate::error::SolveError;
use crate::model::Model;
use crate::signal::Instant;

/// The errors collected over configurations.
pub(super) struct Comparison {
    model: &'static Model,
    result: CrossCheck,
    functions: FunctionChecks,
}

impl Comparison {
    pub(super) fn new(model: &'static Model) -> Self {
        Self { model, result: CrossCheck::new(), functions: FunctionChecks::default() }
    }

    /// Compares everything at one configuration.
    pub(super) fn compare(
        &mut self,
        mechanism: &dyn Checked,
        parameters: &[f64],
        at: &Configuration,
    ) -> Result<(), SolveError> {
        let dual = automatic(mechanism, parameters, at)?;
        if dual.phi.iter().any(|p| !p.is_finite()) {
            self.result.skipped += 1;
            return Ok(());
        }
        let instant = Instant { t: at.t, inputs: &at.inputs };
        let [phi_q, phi_t, gamma] = mechanism.closed_forms(parameters, &instant, &at.q, &at.q_dot)?;
        self.entries(at, &dual, &phi_q, &phi_t, &gamma);
        self.functions(mechanism, parameters, at)
    }

    /// Compares the supplied functions at their arguments in one configuration.
    fn functions(&mut self, mechanism: &dyn Checked, parameters: &[f64], at: &Configuration) -> Result<(), SolveError> {
        let mut arguments = vec![0.0; self.model.arguments.len()];
        let instant = Instant { t: at.t, inputs: &at.inputs };
        mechanism.arguments(parameters, &instant, &at.q, &mut arguments)?;
        for (&function, &x) in self.model.arguments.iter().zip(&arguments) {
            let name = self.model.functions.get(function).copied().unwrap_or_default();
            self.functions.compare(name, &|x| mechanism.function(function, x), x);
        }
        Ok(())
    }

    /// Compares all entries of one configuration.
    fn entries(&mut self, at: &Configuration, dual: &Automatic, non_zeros: &[f64], phi_t: &[f64], gamma: &[f64]) {
        let (s, n) = (self.model.rows.len(), self.model.coordinates.len());
        let mut phi_q = vec![0.0; s * n];
        for (&(row, column), &value) in self.model.constraint_pattern.entries.iter().zip(non_zeros) {
            phi_q[row * n + column] += value;
        }
        self.result.configurations += 1;
        for (row, (closed, automatic)) in phi_q.chunks(n.max(1)).zip(dual.phi_q.chunks(n.max(1))).enumerate() {
            let size = largest(closed).max(largest(automatic));
            for (column, (&a, &b)) in closed.iter().zip(automatic).enumerate() {
                self.entry(at, "Φ_q", row, self.model.coordinates[column].name, [a, b], size);
            }
        }
        let speed = largest(&at.q_dot).powi(2).max(1.0);
        for (row, phi_q) in phi_q.chunks(n.max(1)).take(s).enumerate() {
            let curvature = largest(phi_q) * speed;
            self.entry(at, "Φ_t", row, "", [phi_t[row], dual.phi_t[row]], dual.phi_t[row].abs());
            self.entry(at, "γ", row, "", [gamma[row], dual.gamma[row]], dual.gamma[row].abs().max(curvature));
        }
    }

    /// Compares one entry.
    fn entry(
        &mut self,
        at: &Configuration,
        matrix: &'static str,
        row: usize,
        column_name: &'static str,
        [closed_form, automatic]: [f64; 2],
        size: f64,
    ) {
        let row_name = self.model.rows.get(row).map_or("", |r| r.name);
        let error = (closed_form - automatic).abs() / size.max(1.0);
        self.result.add([matrix, row_name, column_name], [closed_form, automatic], error, (at.t, &at.q, &at.q_dot));
    }

    /// The result; an error if nothing could be compared.
    pub(super) fn finish(mut self) -> Result<CrossCheck, SolveError> {
        if self.result.configurations == 0 {
            return Err(SolveError::NothingCompared { skipped: self.result.skipped });
        }
        self.result.worst.error = self.result.worst.error.max(0.0);
        self.result.functions = self.functions.finish();
        Ok(self.result)
    }
}

/// The largest finite absolute value.
fn largest(values: &[f64]) -> f64 {
    values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max)
}
