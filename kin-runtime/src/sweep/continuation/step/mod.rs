//! One step of the continuation: predict, correct, check.

use super::groups;
use super::hidden_motion::hides_nothing;
use super::orientation::{Orientation, stays_regular};
use crate::analysis::acceleration::acceleration;
use crate::analysis::rounding::{dominated_acceleration, ill_conditioned};
use crate::analysis::velocity::{inconsistency, scaled};
use crate::equations::Equations;
use crate::equations::contact;
use crate::equations::factorisation::Purpose;
use crate::equations::scale::largest_product;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::nonlinear::newton::{largest, rounding};
use crate::planned::follower::NEGLIGIBLE_CORRECTION;
use crate::planned::parts::Span;
use crate::planned::step_length::growth;
use crate::state::State;
use crate::workspace::Subset;
use nalgebra::DVector;

/// Largest number of Newton corrections in one step.
const CORRECTIONS: usize = 6;
/// Largest ratio of the length of a correction to the length of the one before.
const CONTRACTION: f64 = 0.3;
/// Largest ratio of the next Newton step to the last one taken. Where it is larger, convergence is not quadratic: two
/// solutions are near one another, and the iteration may be on its way to either.
const CONVERGED: f64 = 0.1;
/// Length of a correction, on the common scale, below which it may be due to rounding.
const ROUNDING: f64 = 1e-9;
/// Length of a motion so short that a jump of the velocity in it is attributed to the driver.
const INSTANTANEOUS: f64 = 1e-7;
/// Largest deviation of the velocity from its prediction, relative to the larger of the two.
const VELOCITY: f64 = 0.5;

/// A configuration on the branch.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// The parameter of the course: the time, unless only inputs change along the course.
    pub(crate) s: f64,
    pub(crate) state: State,
    /// The data from which full Newton continues; `None` where the plan has solved this node.
    pub(crate) basis: Option<Basis>,
}

/// The factorisation of Φ_q at a configuration, and the branch of that configuration.
#[derive(Clone, Debug)]
pub(crate) struct Basis {
    pub(crate) orientation: Orientation,
    pub(crate) factor: Factorization,
    /// The branch values of all groups of the plan; empty where there is no plan.
    pub(crate) groups: Vec<f64>,
    /// The angles by which the gradients of rows that the plan iterates turn per unit of every coordinate; empty where
    /// there is no plan.
    pub(crate) turns: Vec<f64>,
}

/// The start of a step: a node, its parameter on the course, and the derivatives of q along the course.
#[derive(Clone, Copy)]
pub(crate) struct StepStart<'n> {
    pub(crate) node: &'n Node,
    pub(crate) basis: &'n Basis,
    pub(crate) s: f64,
    pub(crate) q_dot: &'n [f64],
    pub(crate) q_ddot: &'n [f64],
}

/// Why a step was rejected.
#[derive(Clone, Debug)]
pub(crate) enum Fault {
    /// Newton's iteration does not converge, or too slowly; the row with the largest residual.
    Open(usize),
    /// The solution is not on this branch; the row with the largest residual at the prediction.
    Jump(usize),
    /// The step is too long for the accuracy requested; the factor by which it should be shortened.
    Coarse(f64),
    /// Rounding errors dominate the rates; the row with the largest residual at the prediction.
    Rounded(usize),
    /// The error of integrated velocities dominates the rates; the row that it changes most.
    GlobalError(usize),
    /// An evaluation failed.
    Error(SolveError),
}

impl From<SolveError> for Fault {
    fn from(error: SolveError) -> Self {
        Self::Error(error)
    }
}

/// Buffers for the steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepBuffers {
    motion: Vec<f64>,
    pub(super) predicted: Vec<f64>,
    difference: Vec<f64>,
    /// The rows of position level.
    closing: Vec<usize>,
    /// The branch values of the groups at the prediction and at the solution found.
    groups: [Vec<f64>; 2],
    /// The estimated error of the last step, if it was integrated.
    pub(super) local_error: Option<Vec<f64>>,
}

impl StepBuffers {
    pub(crate) fn new(equations: &Equations<'_>) -> Self {
        Self { closing: equations.rows_where(Equations::holonomic), ..Self::default() }
    }
}

/// Writes the node at the parameter `s` of the course to `to`; returns the factor by which the next step may be longer.
///
/// With `last` the caller requested this instant: the node is converged fully and the rank of Φ_q is determined.
pub(crate) fn step(
    equations: &mut Equations<'_>,
    scratch: &mut StepBuffers,
    from: StepStart<'_>,
    to: &mut Node,
    s: f64,
    last: bool,
) -> Result<f64, Fault> {
    let h = s - from.s;
    equations.move_to(s)?;
    let StepBuffers { motion, predicted, .. } = &mut *scratch;
    fill(motion, from.q_dot.iter().zip(from.q_ddot).map(|(v, a)| h * (v + 0.5 * h * a)));
    fill(predicted, from.node.state.q.iter().zip(motion.iter()).map(|(q, d)| q + d));
    let allowed = equations.options.prediction_tolerance * equations.scale.size(motion) + NEGLIGIBLE_CORRECTION;
    let corrected = correct(equations, scratch, &mut to.state.q, allowed, if last { 1e-9 } else { 1e-6 })?;
    let (effort, worst) = (corrected.correction / allowed, corrected.worst);
    settle(equations, scratch, from, to, corrected, s, last)?;
    if !expected(equations, &mut scratch.difference, &from, h, &to.state.q_dot) {
        return Err(Fault::Jump(worst));
    }
    Ok(growth(effort))
}

/// Completes the node at the parameter `s` of the course, whose q has been found, if it is on the branch of `from`.
pub(super) fn settle(
    equations: &mut Equations<'_>,
    scratch: &mut StepBuffers,
    from: StepStart<'_>,
    to: &mut Node,
    corrected: Corrected,
    s: f64,
    last: bool,
) -> Result<(), Fault> {
    let Corrected { iterations, worst, last_step, correction } = corrected;
    let StepBuffers { closing, groups: [predicted_groups, groups], predicted, motion, .. } = scratch;
    let state = &mut to.state;
    equations.evaluate(Subset { phi: true, ..Subset::VELOCITY }, &state.q, None)?;
    let allowed = closed(equations, &state.q);
    let scaled_phi = |row: usize| (equations.phi[row] * equations.scale.rows[row]).abs();
    // A row may have become steeper than where the scale was chosen.
    let is_open = |&row: &usize| {
        let phi = scaled_phi(row);
        phi > allowed && (phi > allowed * equations.smallest_scaled(row) || !phi.is_finite())
    };
    if closing.iter().any(is_open) {
        return Err(Fault::Open(worst));
    }
    if let Some(row) = contact::turned_about(equations, &from.node.state.q, &state.q) {
        return Err(Fault::Jump(row));
    }
    let Basis { orientation, factor, groups: before, .. } = from.basis;
    let memory = to.basis.take();
    let (memory, mut oriented) =
        memory.map_or((None, orientation.clone()), |basis| (Some(basis.factor), basis.orientation));
    let found = equations.factorise(Purpose::Rank, memory);
    let rank = found.rank;
    if rank != factor.rank || !orientation.keep(equations, &found, &mut oriented) {
        return Err(Fault::Jump(worst));
    }
    if last_step > ROUNDING {
        let next = found.solve(&scaled(equations, &equations.phi));
        if equations.scale.size(next.as_slice()) > CONVERGED * last_step {
            return Err(Fault::Open(worst));
        }
    }
    equations.write_branch_values(predicted, predicted_groups);
    equations.write_branch_values(&state.q, groups);
    let is_redundant = equations.model.plan.has_redundant_rows();
    // The turn by velocity or by acceleration alone, since a motion that reverses ends near its start.
    let h = s - from.s;
    let farthest = |turn: &dyn Fn(&[f64]) -> f64| (h * turn(from.q_dot)).abs().max(0.5 * h * h * turn(from.q_ddot));
    let mut turn = farthest(&|rates| groups::turn_of_bodies(equations, &from.node.state.q, rates));
    if !equations.model.plan.iterates() {
        // Iterated groups are looked at within the step instead.
        let turns = &from.basis.turns;
        let of_rows = farthest(&|rates| largest_product(rates, turns));
        turn = turn.max(of_rows);
        fill(motion, state.q.iter().zip(&*predicted).map(|(a, b)| a - b));
        let is_near =
            largest_product(motion, turns) <= equations.options.prediction_tolerance * of_rows + NEGLIGIBLE_CORRECTION;
        if !is_near {
            return Err(Fault::Coarse(0.5));
        }
    }
    if !groups::stay([before, predicted_groups, groups], turn, is_redundant) {
        return Err(Fault::Jump(worst));
    }
    let are_known = !groups.is_empty() && !is_redundant && !groups.iter().any(|w| w.is_nan());
    let distance = 1.0 / factor.condition.max(found.condition);
    let stays = are_known || groups::stay_apart(distance, turn, correction) && stays_regular(equations, factor);
    if !stays {
        return Err(Fault::Coarse(0.5));
    }
    let right = -scaled(equations, &equations.phi_t);
    let q_dot = found.solve(&right);
    if inconsistency(equations, &q_dot, &right, 0.0).is_some() {
        return Err(Fault::Open(worst));
    }
    equations.check("q_dot", q_dot.as_slice())?;
    let ends = [&*from.node.state.q, from.q_dot, &*state.q, q_dot.as_slice()];
    let span = Span { ends, inputs: &from.node.state.inputs, h };
    let values: [&[f64]; 2] = [before, groups];
    if !is_redundant && (!groups::stay_between(equations, values, span) || groups::dip_between(equations, values, span))
    {
        return Err(Fault::Coarse(0.5));
    }
    fill(motion, from.q_dot.iter().zip(from.q_ddot).map(|(v, a)| h * (v + 0.5 * h * a)));
    let allowed = equations.options.prediction_tolerance * equations.scale.size(motion) + NEGLIGIBLE_CORRECTION;
    if !hides_nothing(equations, [from.s, s], ends, &found, allowed)? {
        return Err(Fault::Coarse(0.5));
    }
    fill(&mut state.q_dot, q_dot.iter().copied());
    // Near a singular configuration the contradiction of the rows is due to rounding.
    state.q_ddot = acceleration(equations, &state.q, &state.q_dot, &found).map_err(|error| match error {
        SolveError::InconsistentAcceleration { .. } if rank == state.q.len() => Fault::Jump(worst),
        error => Fault::Error(error),
    })?;
    let solution = [&state.q[..], &state.q_dot, &state.q_ddot];
    if last && !is_redundant && ill_conditioned(equations, groups, solution, found.condition).is_some() {
        return Err(Fault::Jump(worst));
    }
    if last && !are_known && dominated_acceleration(equations, solution, &found)?.is_some() {
        return Err(Fault::Rounded(worst));
    }
    if last && equations.check_slopes([&state.q, &state.q_dot, &state.q_ddot]).is_err() {
        return Err(Fault::Rounded(worst));
    }
    let turns = equations.turns(&equations.instant(), &state.q);
    to.s = s;
    state.t = equations.t;
    state.inputs.clone_from(&equations.inputs);
    state.degrees_of_freedom_left = state.q.len() - rank;
    state.condition = Some(found.condition);
    state.residual = closing.iter().map(|&row| equations.phi[row].abs()).fold(0.0, f64::max);
    state.iterations = iterations;
    to.basis = Some(Basis { orientation: oriented, factor: found, groups: groups.clone(), turns });
    Ok(())
}

/// Replaces the contents of a buffer.
fn fill(buffer: &mut Vec<f64>, values: impl Iterator<Item = f64>) {
    buffer.clear();
    buffer.extend(values);
}

/// The result of the correction of a position.
pub(super) struct Corrected {
    iterations: usize,
    /// The row with the largest residual at the prediction.
    worst: usize,
    /// Distance from the prediction on the common scale.
    correction: f64,
    /// Length of the last Newton step on the common scale.
    last_step: f64,
}

/// Takes full Newton steps from the prediction in `scratch` until one is shorter than `last_step`, and writes q.
pub(super) fn correct(
    equations: &mut Equations<'_>,
    scratch: &mut StepBuffers,
    q: &mut Vec<f64>,
    allowed: f64,
    last_step: f64,
) -> Result<Corrected, Fault> {
    let StepBuffers { predicted, difference: travel, closing: rows, .. } = scratch;
    q.clone_from(predicted);
    let mut before = f64::INFINITY;
    let mut worst = 0;
    let all = rows.len() == equations.rows();
    let mut memory: Option<Factorization> = None;
    for iterations in 1..=CORRECTIONS {
        equations.evaluate(Subset::POSITION, q, None)?;
        let phi = DVector::from_iterator(rows.len(), rows.iter().map(|&r| equations.phi[r] * equations.scale.rows[r]));
        if iterations == 1 {
            worst = rows.get(largest(&phi).0).copied().unwrap_or(0);
        }
        let tolerance = 0.1 * equations.options.rank_tolerance;
        let sparse = if all { equations.factorise_sparse(Purpose::Solutions, memory.take()) } else { None };
        let factor = sparse
            .unwrap_or_else(|| Factorization::quick(&equations.scaled_rows(rows), &equations.scale.columns, tolerance));
        let step = factor.solve(&phi);
        memory = Some(factor);
        q.iter_mut().zip(step.iter()).for_each(|(q, s)| *q -= s);
        let length = equations.scale.size(step.as_slice());
        fill(travel, q.iter().zip(predicted.iter()).map(|(a, b)| a - b));
        let correction = equations.scale.size(travel);
        if !(length <= CONTRACTION * before && correction <= allowed) {
            // The negated comparison also rejects NaN. At the level of rounding the corrections no longer contract, so
            // short ones are accepted there. Longer ones contract slowly where two solutions come near one another.
            if !(length <= last_step.min(ROUNDING) && correction <= allowed) {
                return Err(Fault::Open(worst));
            }
        }
        if length <= last_step {
            return Ok(Corrected { iterations, worst, correction, last_step: length });
        }
        before = length;
    }
    Err(Fault::Open(worst))
}

/// Largest scaled residual that counts as zero at q.
fn closed(equations: &Equations<'_>, q: &[f64]) -> f64 {
    equations.options.tolerance.max(rounding(equations.scale.size(q)))
}

/// True if the velocity is near its prediction q̇ + h q̈.
fn expected(equations: &Equations<'_>, change: &mut Vec<f64>, from: &StepStart<'_>, h: f64, q_dot: &[f64]) -> bool {
    let scale = &equations.scale;
    fill(change, q_dot.iter().zip(from.q_dot).zip(from.q_ddot).map(|((new, old), a)| new - (old + h * a)));
    let (change, size) = (scale.size(change), scale.size(q_dot).max(scale.size(from.q_dot)));
    // A large acceleration does not widen the tolerance: near a singular configuration it may be large or dominated by
    // rounding.
    change <= VELOCITY * size || h.abs() * size <= INSTANTANEOUS
}

#[cfg(test)]
mod tests;
