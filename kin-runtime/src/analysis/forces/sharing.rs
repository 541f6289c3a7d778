//! Forces that redundant rows leave undetermined, and the possible forces of least norm.
//!
//! If there are more rows than their rank, λ may change along every null vector of Φ_qᵀ, and a force that changes with
//! it is not determined by equilibrium alone. Of all possible λ, `Sharing::LeastNorm` takes the one with the least sum
//! of squares of: all forces in joints, times a length of the mechanism; all moments and couples; and the multipliers,
//! on the common scale, of rows that exert neither (drivers, equations of the user). So the result does not depend on
//! how a joint is written.

use super::numbers::ZERO_CHANGE;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::{Factorization, null_space};
use crate::model::forces::TOTALS;
use crate::model::{ForceModel, Model};
use crate::state::State;
use nalgebra::{DMatrix, DVector};

/// The multipliers of rows that share a load.
pub(super) struct Shared {
    /// Scaled multipliers of least forces.
    least: DVector<f64>,
    /// Null vectors of the transposed scaled Φ_q.
    null: DMatrix<f64>,
    determined: Vec<bool>,
    /// The changes of all numbers along the null vectors.
    changes: DMatrix<f64>,
    rows: Vec<f64>,
}

impl Shared {
    /// From one solution y of the scaled system.
    pub(super) fn new(
        equations: &Equations<'_>,
        info: &ForceModel,
        state: &State,
        scaled: &DMatrix<f64>,
        y: DVector<f64>,
        rank: usize,
    ) -> Result<Self, SolveError> {
        let tolerance = equations.options.rank_tolerance;
        let null = match rank < scaled.ncols() {
            true => null_space(scaled, tolerance),
            false => DMatrix::zeros(y.len(), 0),
        };
        let rows = equations.scale.rows.clone();
        let changes = DMatrix::zeros(info.count, null.ncols());
        let mut shared = Self { least: y, null, determined: vec![true; info.count], changes, rows };
        if shared.null.ncols() > 0 {
            shared.share(equations, info, state)?;
        }
        Ok(shared)
    }

    fn share(&mut self, equations: &Equations<'_>, info: &ForceModel, state: &State) -> Result<(), SolveError> {
        let declared = equations.model.rows.len();
        let numbers = |lambda: &[f64]| -> Result<DVector<f64>, SolveError> {
            let mut values = vec![0.0; info.count];
            equations.system.forces(&state.instant(), state, &lambda[..declared], &mut values)?;
            Ok(DVector::from_vec(values))
        };
        let (weights, counted) = weights(equations.model, info, &equations.scale);
        let numbers_now = numbers(&self.unscaled(&self.least))?;
        // Null vectors are scaled to the size of the multipliers, so that rounding of forces that do not change stays
        // relatively small.
        let size = if self.least.amax() > 0.0 { self.least.amax() } else { 1.0 };
        let (count, free) = (info.count, self.null.ncols());
        let mut changes = DMatrix::zeros(count, free);
        for (k, vector) in self.null.column_iter().enumerate() {
            let change = numbers(&self.unscaled(&(&self.least + vector * size)))? - &numbers_now;
            changes.set_column(k, &change.component_mul(&weights));
            self.changes.set_column(k, &change);
        }
        let largest = changes.amax();
        self.determined = changes.row_iter().map(|change| change.amax() <= ZERO_CHANGE * largest).collect();
        // Minimise Σ (numbers + changes z)² + Σ (y + null z)² over z, with the numbers of joints and the rows that
        // exert nothing.
        let other: Vec<usize> = (0..self.least.len()).filter(|&row| !exerts(equations.model, info, row)).collect();
        let forces: Vec<usize> = (0..count).filter(|&index| counted[index]).collect();
        let matrix = DMatrix::from_fn(forces.len() + other.len(), free, |i, j| match forces.get(i) {
            Some(&index) => changes[(index, j)],
            None => size * self.null[(other[i - forces.len()], j)],
        });
        let right = DVector::from_fn(matrix.nrows(), |i, _| match forces.get(i) {
            Some(&index) => -numbers_now[index] * weights[index],
            None => -self.least[other[i - forces.len()]],
        });
        let scale = matrix.amax().max(f64::MIN_POSITIVE);
        let z = Factorization::revealing(&(matrix / scale), &vec![1.0; free], equations.options.rank_tolerance)
            .solve(&(right / scale));
        self.least += &self.null * (z * size);
        Ok(())
    }

    /// The scaled multipliers of least forces.
    pub(super) fn multipliers(&self) -> DVector<f64> {
        self.least.clone()
    }

    /// λ from scaled multipliers.
    pub(super) fn unscaled(&self, y: &DVector<f64>) -> Vec<f64> {
        y.iter().zip(&self.rows).map(|(y, s)| y * s).collect()
    }

    /// Which of the numbers equilibrium determines.
    pub(super) fn determined(&self) -> Vec<bool> {
        self.determined.clone()
    }

    /// The changes of all numbers along the null vectors.
    pub(super) fn changes(self) -> DMatrix<f64> {
        self.changes
    }

    /// Whether equilibrium determines the multiplier of a row.
    pub(super) fn is_determined(&self, row: usize) -> bool {
        self.null.row(row).iter().all(|entry| entry.abs() <= ZERO_CHANGE)
    }
}

/// The factor that makes every number a moment, 0 for those that do not depend on λ and for sums of others; and whether it is a
/// force, a moment or a couple of a joint. Without these factors the unit of length would decide which change is small.
fn weights(model: &Model, info: &ForceModel, scale: &Scale) -> (DVector<f64>, Vec<bool>) {
    let (mut weights, mut counted) = (DVector::zeros(info.count), vec![false; info.count]);
    let of_row = |row: usize| 1.0 / scale.rows[row];
    for row in 0..model.rows.len() {
        weights[TOTALS + row] = of_row(row);
    }
    for effort in info.efforts {
        weights[effort.place] = match model.row_of_effort(effort.name) {
            Some(row) if model.joints[model.rows[row].joint].keeps_distance() => scale.length,
            Some(row) => of_row(row),
            // A held coordinate that moves.
            None if effort.name.ends_with(".phi") => 1.0,
            None => scale.length,
        };
    }
    for reaction in info.reactions {
        let mut index = reaction.place;
        let mut next = |count: usize, weight: f64, counts: bool| {
            weights.as_mut_slice()[index..index + count].fill(weight);
            counted[index..index + count].fill(counts);
            index += count;
        };
        if reaction.has_force {
            next(2, 0.0, false);
            next(2, scale.length, true);
        }
        next(usize::from(reaction.has_moment) + reaction.couples.len(), 1.0, true);
        let rows = (0..model.rows.len()).filter(|row| model.joints[model.rows[*row].joint].name == reaction.name);
        rows.take(reaction.generalized).for_each(|row| next(1, of_row(row), false));
        let one_sided = [reaction.has_normal, reaction.has_tangential, reaction.has_tension];
        next(one_sided.map(usize::from).iter().sum(), scale.length, false);
    }
    (weights, counted)
}

/// Whether the joint of a row exerts a force, a moment or couples.
fn exerts(model: &Model, info: &ForceModel, row: usize) -> bool {
    let Some(row) = model.rows.get(row) else { return false };
    let name = model.joints[row.joint].name;
    let reaction = info.reactions.iter().find(|reaction| reaction.name == name);
    reaction.is_some_and(|reaction| reaction.has_force || reaction.has_moment || !reaction.couples.is_empty())
}
