//! Derivatives of forces: Φ_qᵀ λ_p = r_p − (Φ_q)_pᵀ λ, and the numbers of forces evaluated with numbers that carry
//! derivatives.

use super::variation::Variation;
use crate::analysis::forces::{Numbers, Sharing, collected, numbers};
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::model::ForceModel;
use crate::model::forces::TOTALS;
use crate::results::varied::{Number, Varied, WIDTH};
use crate::scalar::Scalar;
use crate::sensitivities::Sensitivity;
use crate::state::State;
use crate::workspace::Subset;
use nalgebra::DVector;

/// Writes the derivatives of forces; `None` if there are no forces or they have no derivatives.
pub(crate) fn forces(
    equations: &mut Equations<'_>,
    variation: &mut dyn Variation,
    info: &ForceModel,
    state: &State,
    varied: &Varied,
    by: &mut [Sensitivity],
) {
    let Ok(at) = numbers(equations, info, state, Sharing::Undetermined) else { return };
    let model = equations.model;
    let Ok((values, given)) = varied_numbers(equations, variation, info, state, varied, &at) else { return };
    for (lane, by) in by.iter_mut().enumerate() {
        let numbers =
            Numbers { values: values.iter().map(|value| value.by()[lane]).collect(), given: Vec::new(), ..at.clone() };
        let mut forces = collected(model, info, state, &numbers);
        // Those of least norm also depend on how rows are scaled, which has no derivative.
        let determined = numbers.determined.iter().skip(TOTALS);
        let open = forces.multipliers.iter_mut().zip(determined).filter(|(_, determined)| !**determined);
        open.for_each(|(multiplier, _)| *multiplier = f64::NAN);
        for (&(name, effort, rate, determined), (effort_by, rate_by)) in at.given.iter().zip(&given) {
            let (effort_by, rate_by) = (effort_by.by()[lane], rate_by.by()[lane]);
            let known = determined.then_some(effort_by);
            forces.efforts.push(crate::forces::Effort { name, effort: known, rate: rate_by, determined });
            forces.driver_power += effort_by * rate + effort * rate_by;
        }
        let finite = numbers.values.iter().zip(&numbers.determined).all(|(value, known)| !known || value.is_finite());
        by.forces = finite.then_some(forces);
    }
}

/// Effort and rate of a prescribed coordinate.
type Given = (Number, Number);

/// The numbers of forces, and those of prescribed coordinates.
fn varied_numbers(
    equations: &mut Equations<'_>,
    variation: &mut dyn Variation,
    info: &ForceModel,
    state: &State,
    varied: &Varied,
    at: &Numbers,
) -> Result<(Vec<Number>, Vec<Given>), SolveError> {
    let zero = Number::from_f64(0.0);
    let mut values = vec![zero; info.count];
    if at.by_plan {
        variation.forces(varied, &[], &mut values)?;
        return Ok((values, Vec::new()));
    }
    let (declared, n) = (equations.model.rows.len(), equations.coordinates());
    let multipliers = at.values[TOTALS..TOTALS + declared].iter().copied();
    let lambda: Vec<f64> = multipliers.chain(at.given.iter().map(|(_, effort, ..)| -effort)).collect();
    let mut right = vec![zero; n];
    variation.generalized_forces(varied, &mut right)?;
    let parts = variation.evaluate(Subset::JACOBIAN, &varied.q, &varied.q_dot)?;
    for (&(row, column), &entry) in equations.model.constraint_pattern.entries.iter().zip(parts.phi_q) {
        right[column] = right[column] - entry * Number::from_f64(lambda[row]);
    }
    equations.scale = Scale::around(equations, &state.q);
    equations.evaluate(Subset::VELOCITY, &state.q, None)?;
    let all: Vec<usize> = (0..equations.rows()).collect();
    let scaled = equations.scaled(&all).transpose();
    let factor = Factorization::revealing(&scaled, &vec![1.0; all.len()], equations.options.rank_tolerance);
    let mut by = vec![[0.0; WIDTH]; all.len()];
    for lane in 0..WIDTH {
        let right = right.iter().zip(&equations.scale.columns).map(|(r, d)| r.by()[lane] * d);
        let y = factor.solve(&DVector::from_iterator(n, right));
        for ((by, y), scale) in by.iter_mut().zip(&y).zip(&equations.scale.rows) {
            by[lane] = y * scale;
        }
    }
    let lambda: Vec<Number> = lambda.into_iter().zip(by).map(|(lambda, by)| Number::new(lambda, by)).collect();
    variation.forces(varied, &lambda[..declared], &mut values)?;
    let given = (declared..all.len()).map(|row| {
        let rate = equations.given_coordinate(row - declared).map_or(zero, |k| varied.q_dot[k]);
        (-lambda[row], rate)
    });
    Ok((values, given.collect()))
}
