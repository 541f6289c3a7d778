//! Derivatives by linear solves, for mechanisms that no plan solves: one factorisation of Φ_q serves all of them.

use super::variation::Variation;
use crate::analysis::velocity::{factorize, scaled};
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::equations::system::Parts;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::model::Pattern;
use crate::results::varied::{Number, Varied, WIDTH};
use crate::scalar::Scalar;
use crate::state::State;
use crate::workspace::Subset;
use nalgebra::DVector;

/// If a parameter changes by its whole value, a change of a row below this share of its terms counts as rounding.
const ROUNDING: f64 = 1e-5;

/// A parameter below this, or below this share of a typical length if that is less than 1, is a small deviation from 0:
/// its own size says nothing about that of the terms that contain it.
const SMALLEST_SIZE: f64 = 1e-6;

/// Φ_q at a state, factorised.
pub(crate) struct Linear {
    factor: Factorization,
}

impl Linear {
    /// Factorises Φ_q at a state.
    pub(crate) fn at(equations: &mut Equations<'_>, state: &State) -> Result<Self, SolveError> {
        equations.scale = Scale::around(equations, &state.q);
        Ok(Self { factor: factorize(equations, &state.q, None)? })
    }

    /// q, q̇ and q̈ with their derivatives with respect to the parameters that vary.
    pub(crate) fn vary(
        &self,
        equations: &Equations<'_>,
        variation: &mut dyn Variation,
        state: &State,
        parameters: &[usize],
        varied: &mut Varied,
    ) -> Result<(), SolveError> {
        let model = equations.model;
        let pattern = &model.constraint_pattern;
        let held = |list: &[f64]| -> Vec<Number> { list.iter().copied().map(Number::from_f64).collect() };
        let Varied { q, q_dot, q_ddot, .. } = varied;
        (*q, *q_dot, *q_ddot) = (held(&state.q), held(&state.q_dot), held(&state.q_ddot));
        let rows = RowResiduals::new(variation.evaluate(Subset::PHI, q, q_dot)?.phi.to_vec());
        self.close(equations, &rows, parameters, q)?;
        // Φ_q q̇ + Φ_t.
        let parts = variation.evaluate(Subset::VELOCITY, q, q_dot)?;
        let rows = RowResiduals::new(parts.phi_t.to_vec()).with_product(&parts, pattern, q_dot);
        self.close(equations, &rows, parameters, q_dot)?;
        // Φ_q q̈ − γ.
        let parts = variation.evaluate(Subset::ALL, q, q_dot)?;
        let gamma = parts.gamma.iter().map(|gamma| -*gamma).collect();
        let rows = RowResiduals::new(gamma).with_product(&parts, pattern, q_ddot);
        self.close(equations, &rows, parameters, q_ddot)
    }

    /// Corrects the derivatives of `x` so that these rows are 0: Φ_q x_p = −row_p for every parameter.
    fn close(
        &self,
        equations: &Equations<'_>,
        rows: &RowResiduals,
        parameters: &[usize],
        x: &mut [Number],
    ) -> Result<(), SolveError> {
        let mut by = vec![[0.0; WIDTH]; x.len()];
        for (lane, &parameter) in parameters.iter().enumerate() {
            // Rows of prescribed coordinates come after those of the mechanism; they do not depend on parameters.
            let right = |row: usize| rows.values.get(row).map_or(0.0, |value| -value.by()[lane]);
            let right = scaled(equations, &DVector::from_fn(equations.rows(), |row, _| right(row)));
            let name = equations.model.parameters[parameter].name;
            let error = |row_name| SolveError::NoSensitivity { t: equations.t, parameter: name, row_name };
            if !right.iter().all(|b| b.is_finite()) {
                return Err(error(None));
            }
            let solution = self.factor.solve(&right);
            let missed = scaled(equations, &equations.times(solution.as_slice())) - &right;
            let value = equations.system.parameters()[parameter].abs();
            let smallest = SMALLEST_SIZE * equations.scale.length.min(1.0);
            let rounding = ROUNDING / if value > 0.0 { value.max(smallest) } else { 1.0 };
            let terms = rows.terms.iter().zip(&rows.sizes).map(|(terms, size)| terms[lane].max(rounding * size));
            let terms = terms.zip(&equations.scale.rows).map(|(term, scale)| term * scale);
            let size = terms.fold(right.amax().max(equations.scale.size(solution.as_slice())), f64::max);
            let (row, worst) = missed
                .iter()
                .map(|miss| miss.abs())
                .enumerate()
                .fold((0, 0.0), |worst, miss| if miss.1 > worst.1 { miss } else { worst });
            if worst > equations.options.consistency_tolerance * size {
                return Err(error(Some(equations.row_name(row))));
            }
            by.iter_mut().zip(&solution).for_each(|(by, x)| by[lane] = *x);
        }
        x.iter_mut().zip(by).for_each(|(x, by)| *x = Number::new(x.value(), by));
        Ok(())
    }
}

/// Residuals of rows, with the size of their largest term and its largest change with each parameter, from which
/// rounding errors are estimated.
struct RowResiduals {
    values: Vec<Number>,
    terms: Vec<[f64; WIDTH]>,
    sizes: Vec<f64>,
}

impl RowResiduals {
    fn new(values: Vec<Number>) -> Self {
        let terms = values.iter().map(|value| value.by().map(f64::abs)).collect();
        let sizes = values.iter().map(|value| value.value().abs()).collect();
        Self { values, terms, sizes }
    }

    /// With Φ_q x added.
    fn with_product(mut self, parts: &Parts<'_, Number>, pattern: &Pattern, x: &[Number]) -> Self {
        for (&(row, column), &entry) in pattern.entries.iter().zip(parts.phi_q) {
            let x = x[column];
            self.values[row] = self.values[row] + entry * x;
            self.sizes[row] = self.sizes[row].max((entry.value() * x.value()).abs());
            let changes = entry.by().into_iter().zip(x.by());
            for (term, (entry_by, x_by)) in self.terms[row].iter_mut().zip(changes) {
                *term = term.max((entry_by * x.value()).abs()).max((entry.value() * x_by).abs());
            }
        }
        self
    }
}
