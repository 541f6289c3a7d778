//! Some rows of a mechanism as functions of some coordinates: what an iteration closes.

use crate::equations::Equations;
use crate::newton::{self, Outcome, Residual, Settings};
use crate::workspace::Subset;
use nalgebra::{DMatrix, DVector};

/// Rows to close and coordinates to move; the others are held.
struct Closure<'e, 'a> {
    equations: &'e mut Equations<'a>,
    rows: &'e [usize],
    columns: &'e [usize],
    sizes: Vec<f64>,
    q: Vec<f64>,
}

impl Residual for Closure<'_, '_> {
    fn evaluate(&mut self, part: &[f64]) -> bool {
        self.columns.iter().zip(part).for_each(|(&k, &x)| self.q[k] = x);
        self.equations.evaluate(Subset::POSITION, &self.q, None).is_ok()
    }

    fn residual(&self) -> DVector<f64> {
        let equations = &*self.equations;
        DVector::from_iterator(
            self.rows.len(),
            self.rows.iter().map(|&row| equations.phi[row] * equations.scale.rows[row]),
        )
    }

    fn jacobian(&self) -> DMatrix<f64> {
        let equations = &*self.equations;
        DMatrix::from_fn(self.rows.len(), self.columns.len(), |i, j| {
            equations.jacobian[(self.rows[i], self.columns[j])] * equations.scale.rows[self.rows[i]]
        })
    }

    fn columns(&self) -> &[f64] {
        &self.sizes
    }
}

/// Closes `rows` by moving the coordinates `columns` of `q`; the outcome's worst row is a row of the mechanism.
pub(crate) fn close(equations: &mut Equations<'_>, rows: &[usize], columns: &[usize], q: &mut [f64]) -> Outcome {
    let options = equations.options;
    let settings = Settings {
        max_iterations: options.max_iterations,
        tolerance: options.tolerance,
        trust_radius: options.trust_radius,
        rank_tolerance: 0.1 * options.rank_tolerance,
    };
    let sizes = columns.iter().map(|&k| equations.scale.columns[k]).collect();
    let mut part: Vec<f64> = columns.iter().map(|&k| q[k]).collect();
    let mut closure = Closure { equations, rows, columns, sizes, q: q.to_vec() };
    let mut outcome = newton::solve(&mut closure, &mut part, &settings);
    columns.iter().zip(part).for_each(|(&k, x)| q[k] = x);
    outcome.worst = rows.get(outcome.worst).copied().unwrap_or(0);
    outcome
}
