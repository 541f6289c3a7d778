//! Configurations so near to a singular one that rounding errors dominate the rates.
//!
//! Where the groups of a plan have branch values, these show how near their closures are to one another, see
//! [`ill_conditioned_group`]. Otherwise q is moved by what rounding errors of the rows may do to it, and the rates are
//! computed again: with Φ_q δq = ε r, where the entries of r are ±1 on the common scale, the change of q̈ is the error
//! to be expected.

use crate::analysis::acceleration::acceleration;
use crate::analysis::across::smooth_rates;
use crate::analysis::{by_plan, velocity};
use crate::equations::Equations;
use crate::equations::factorisation::Purpose;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::planned::ill_conditioned::{MAX_ACCELERATION_NOISE, QUOTIENT_ANGLE, ill_conditioned_group};
use crate::planned::rates::largest_angle;
use crate::planned::{Limit, PlanError, Step};
use crate::random::Random;
use crate::signal::{Instant, Signal};
use crate::workspace::Subset;
use nalgebra::DVector;

/// Condition number of the scaled Φ_q below which a configuration counts as far from every singular one.
pub(crate) const REGULAR_CONDITION: f64 = 1e3;

/// Number of trials with rounding errors of random signs, and the factor by which they are enlarged, so that the
/// changes of the rates exceed the rounding of these rates themselves.
const TRIALS: usize = 3;
const ENLARGED: f64 = 64.0;

/// Replaces the rates of a solution q, q̇, q̈ of the current instant, found by full Newton, where rounding dominates
/// them, by those of the smooth motion through q; an error where there is none. `factor` is the factorisation of Φ_q
/// there.
pub(crate) fn settle_rates(
    equations: &mut Equations<'_>,
    [q, q_dot, q_ddot]: [&mut Vec<f64>; 3],
    factor: &Factorization,
) -> Result<(), SolveError> {
    if factor.condition < REGULAR_CONDITION {
        return Ok(());
    }
    let solution = [&q[..], &q_dot[..], &q_ddot[..]];
    let mut groups = Vec::new();
    if by_plan::exists(equations) && !equations.model.plan.has_redundant_rows() {
        equations.write_branch_values(q, &mut groups);
    }
    let group = ill_conditioned(equations, &groups, solution, factor.condition);
    // Branch values are NaN where the plan divides by a dimension that is 0.
    let are_known = !groups.is_empty() && !groups.iter().any(|w| w.is_nan());
    let coordinate = if are_known { None } else { dominated_acceleration(equations, solution, factor)? };
    if group.is_none() && coordinate.is_none() {
        return Ok(());
    }
    if let Some(rates) = smooth_rates(equations, [q, q_dot], factor.condition) {
        [*q_dot, *q_ddot] = rates;
        return equations.evaluate(Subset::VELOCITY, q, None);
    }
    if let Some(group) = group {
        return Err(limit_of(equations, &groups, group, q));
    }
    let rounded = |k: usize| SolveError::Rounded { t: equations.t, coordinate: equations.model.coordinates[k].name };
    coordinate.map_or(Ok(()), |k| Err(rounded(k)))
}

/// The group of the plan that is so near to a crossing of branches that rounding dominates the rates; `groups` are the
/// branch values at q, `condition` is the condition number of Φ_q.
pub(crate) fn ill_conditioned(
    equations: &mut Equations<'_>,
    groups: &[f64],
    [q, q_dot, q_ddot]: [&[f64]; 3],
    condition: f64,
) -> Option<usize> {
    if groups.is_empty() || condition < REGULAR_CONDITION {
        return None;
    }
    // A divisor of the plan may be small although the branches of its groups are far apart.
    let distances = distances(equations, groups, q);
    let turns = equations.turns(&equations.instant(), q);
    let further = QUOTIENT_ANGLE / largest_angle(equations.model, &turns, q_dot);
    let ahead: Vec<f64> = q.iter().zip(q_dot).map(|(q, v)| q + further * v).collect();
    let slopes = |values_ahead: Vec<f64>, now: &[f64], width: f64| -> Vec<f64> {
        values_ahead.iter().zip(now).map(|(values_ahead, now)| (values_ahead - now) / width).collect()
    };
    let mut groups_ahead = Vec::new();
    equations.write_branch_values(&ahead, &mut groups_ahead);
    let rates = slopes(groups_ahead, groups, further);
    let mut approaches = vec![0.0; distances.len()];
    // Where nothing turns, nothing approaches anything.
    if further.is_finite() {
        let (t, inputs) = (equations.t, equations.inputs.clone());
        let later: Vec<Signal> = inputs.iter().map(|input| input.after(further)).collect();
        equations.set_checked_instant(&Instant { t: t + further, inputs: &later });
        let distances_ahead = self::distances(equations, groups, &ahead);
        equations.set_checked_instant(&Instant { t, inputs: &inputs });
        approaches = slopes(distances_ahead, &distances, t + further - t);
    }
    ill_conditioned_group(equations.model, [groups, &rates], [&distances, &approaches], [q_dot, q_ddot], &turns)
}

/// The distance of every group from its limit at the current instant in the modes of `groups`: √margin of a solution
/// from q, or the branch value where that is smaller.
fn distances(equations: &mut Equations<'_>, groups: &[f64], q: &[f64]) -> Vec<f64> {
    // A divisor of the plan may be small although the branches of its groups are far apart.
    let margins = by_plan::margins(equations, groups, q);
    let plan = &equations.model.plan;
    let by_margin = |group: usize| plan.margin_of_group(group).map_or(1.0, |margin| margins[margin].max(0.0).sqrt());
    let distance = |(group, w): (usize, &f64)| if w.is_nan() { 1.0 } else { w.abs().min(by_margin(group)) };
    groups.iter().enumerate().map(distance).collect()
}

/// The error of a group beside its limit, with the location of the limit where the plan finds it; `groups` are the
/// branch values at q.
fn limit_of(equations: &mut Equations<'_>, groups: &[f64], group: usize, q: &[f64]) -> SolveError {
    let (t, inputs) = (equations.t, equations.inputs.clone());
    let located = equations.system.follow_from(&Instant { t, inputs: &inputs }, q).err();
    if let Some(error @ PlanError::Limit { .. }) = located {
        return SolveError::Plan(error);
    }
    let model = equations.model;
    let margins = by_plan::margins(equations, groups, q);
    let step =
        model.plan.margin_of_group(group).and_then(|margin| Step::of_margin(model, margin).zip(margins.get(margin)));
    match step {
        Some((step, margin)) => SolveError::Plan(PlanError::Limit { t, limit: Limit::new(step, *margin) }),
        None => SolveError::Rounded { t, coordinate: model.coordinates.first().map_or("", |first| first.name) },
    }
}

/// The coordinate whose acceleration rounding dominates, if there is one. `factor` is the factorisation of Φ_q at q,
/// where it is evaluated again afterwards.
pub(crate) fn dominated_acceleration(
    equations: &mut Equations<'_>,
    solution: [&[f64]; 3],
    factor: &Factorization,
) -> Result<Option<usize>, SolveError> {
    if factor.condition < REGULAR_CONDITION {
        return Ok(None);
    }
    let mut derivatives_at = |equations: &mut Equations<'_>, beside: Vec<f64>| {
        equations.evaluate(Subset::VELOCITY, &beside, None)?;
        let factor_beside = equations.factorise(Purpose::Solutions, None);
        let q_dot = velocity::solve(equations, &factor_beside)?.as_slice().to_vec();
        let q_ddot = acceleration(equations, &beside, &q_dot, &factor_beside)?;
        Ok(vec![beside, q_dot, q_ddot])
    };
    let found = dominated_coordinate(equations, &solution.map(<[f64]>::to_vec), 2, factor, &mut derivatives_at);
    equations.evaluate(Subset::VELOCITY, solution[0], None)?;
    Ok(found)
}

/// q and its derivatives at a configuration q of the current instant.
type DerivativesAt<'a> = &'a mut dyn FnMut(&mut Equations<'_>, Vec<f64>) -> Result<Vec<Vec<f64>>, SolveError>;

/// The coordinate whose derivative of an order from `first` on changes most with the rounding of the rows, if that is
/// more than [`MAX_ACCELERATION_NOISE`] of the largest derivative of this order, or of the rate that all of them show
/// to this power, on the common scale. `all` are q and its derivatives, `factor` is the factorisation of Φ_q there, and
/// `derivatives_at` computes them at another configuration.
pub(crate) fn dominated_coordinate(
    equations: &mut Equations<'_>,
    all: &[Vec<f64>],
    first: usize,
    factor: &Factorization,
    derivatives_at: DerivativesAt<'_>,
) -> Option<usize> {
    let q = all.first()?;
    // The rate of a motion with these derivatives: ρ with |q⁽ʲ⁾| ≤ ρʲ.
    let rate = all
        .iter()
        .enumerate()
        .skip(1)
        .fold(0.0, |rate: f64, (j, derivative)| rate.max(equations.scale.size(derivative).powf(1.0 / j as f64)));
    let mut random = Random::new(0x0002_0d1e);
    for _ in 0..TRIALS {
        let rows = (0..equations.rows()).map(|_| ENLARGED * f64::EPSILON * random.symmetric().signum());
        let moved = factor.solve(&DVector::from_iterator(equations.rows(), rows));
        let beside = q.iter().zip(moved.iter()).map(|(q, moved)| q + moved).collect();
        // Where there are no rates beside q, those at q are not known either.
        let derivatives_beside = derivatives_at(equations, beside).unwrap_or_default();
        for (order, at_q) in all.iter().enumerate().skip(first) {
            let at_beside = derivatives_beside.get(order).map_or(&[][..], Vec::as_slice);
            let change = |k: usize| {
                let change =
                    at_beside.get(k).map_or(f64::NAN, |value_beside| (value_beside - at_q[k]) / ENLARGED).abs();
                if change.is_nan() { f64::INFINITY } else { change }
            };
            let changes: Vec<f64> = (0..at_q.len()).map(change).collect();
            let allowed = MAX_ACCELERATION_NOISE * equations.scale.size(at_q).max(rate.powf(order as f64));
            // A size that is NaN allows nothing.
            let is_clear = equations.scale.size(&changes) <= allowed;
            if !is_clear {
                let scaled = |k: usize| changes[k] / equations.scale.columns[k];
                return (0..q.len()).max_by(|a, b| scaled(*a).total_cmp(&scaled(*b)));
            }
        }
    }
    None
}
