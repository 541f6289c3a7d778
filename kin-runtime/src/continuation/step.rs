//! One step of the continuation: predict, correct, judge.

use super::branch::Orientation;
use crate::acceleration::acceleration;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::newton::rounding;
use crate::state::State;
use crate::velocity::{inconsistency, scaled};
use crate::workspace::Subset;
use nalgebra::DVector;

/// Most corrections of one step.
const CORRECTIONS: usize = 6;
/// Each correction must be smaller than the one before by this factor.
const CONTRACTION: f64 = 0.3;
/// Corrections that are always small enough, on the common scale: where the motion starts from rest.
const NEGLIGIBLE: f64 = 1e-4;
/// Motion so short that a jump of the velocity in it is the driver's own.
const INSTANTANEOUS: f64 = 1e-7;
/// Largest deviation of the velocity from its prediction, relative to the larger of the two.
const VELOCITY: f64 = 0.5;

/// A configuration on the branch.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) state: State,
    pub(crate) orientation: Orientation,
    pub(crate) rank: usize,
}

/// Why a step did not count.
#[derive(Clone, Debug)]
pub(crate) enum Fault {
    /// The rows do not close, or too slowly; the row that resists most.
    Open(usize),
    /// It closes, but not on this branch; the row that resisted most.
    Jump(usize),
    /// The step is too long for the accuracy asked for; by which factor it should be shorter.
    Coarse(f64),
    /// An evaluation failed.
    Error(SolveError),
}

impl From<SolveError> for Fault {
    fn from(error: SolveError) -> Self {
        Self::Error(error)
    }
}

/// The node at `t`, and by how much the next step may be longer.
///
/// With `last` the node is an instant that was asked for: closed to the end and with its rank revealed.
pub(crate) fn step(equations: &mut Equations<'_>, from: &Node, t: f64, last: bool) -> Result<(Node, f64), Fault> {
    let state = &from.state;
    let h = t - state.t;
    equations.set_time(t)?;
    let motion: Vec<f64> = state.q_dot.iter().zip(&state.q_ddot).map(|(v, a)| h * (v + 0.5 * h * a)).collect();
    let predicted: Vec<f64> = state.q.iter().zip(&motion).map(|(q, d)| q + d).collect();
    let allowed = equations.options.prediction_tolerance * equations.scale.size(&motion) + NEGLIGIBLE;
    let corrected = correct(equations, &predicted, allowed, if last { 1e-9 } else { 1e-6 })?;
    let (effort, worst) = (corrected.correction / allowed, corrected.worst);
    let node = settle(equations, from, corrected, t, last)?;
    if !expected(equations, state, h, &node.state.q_dot) {
        return Err(Fault::Jump(worst));
    }
    Ok((node, (0.3 / effort.max(1e-3)).cbrt().clamp(0.5, 4.0)))
}

/// The node at a position that was found for `t`, if it is on the branch of `from`.
pub(super) fn settle(
    equations: &mut Equations<'_>,
    from: &Node,
    position: Corrected,
    t: f64,
    last: bool,
) -> Result<Node, Fault> {
    let Corrected { q, iterations, worst, .. } = position;
    equations.evaluate(Subset { phi: true, ..Subset::VELOCITY }, &q, None)?;
    let holonomic = equations.rows_where(Equations::holonomic);
    let gap = holonomic.iter().map(|&row| (equations.phi[row] * equations.scale.rows[row]).abs()).fold(0.0, f64::max);
    let residual = holonomic.iter().map(|&row| equations.phi[row].abs()).fold(0.0, f64::max);
    if gap > closed(equations, &q) {
        return Err(Fault::Open(worst));
    }
    let rows: Vec<usize> = (0..equations.rows()).collect();
    let matrix = equations.scaled_rows(&rows);
    let tolerance = equations.options.rank_tolerance;
    let columns = &equations.scale.columns;
    let factor = if last {
        Factorization::revealing(&matrix, columns, tolerance)
    } else {
        Factorization::quick(&matrix, columns, tolerance)
    };
    if factor.rank != from.rank || !from.orientation.kept(equations) {
        return Err(Fault::Jump(worst));
    }
    let orientation = Orientation::here(equations, factor.rank).ok_or(Fault::Jump(worst))?;
    let right = -scaled(equations, &equations.phi_t);
    let q_dot = factor.solve(&right);
    if inconsistency(equations, &q_dot, &right).is_some() {
        return Err(Fault::Open(worst));
    }
    equations.check("q_dot", q_dot.as_slice())?;
    let q_ddot = acceleration(equations, &q, q_dot.as_slice(), &factor)?;
    let state = State {
        t,
        inputs: equations.inputs.clone(),
        degrees_of_freedom_left: q.len() - factor.rank,
        condition: factor.condition,
        q,
        q_dot: q_dot.as_slice().to_vec(),
        q_ddot,
        residual,
        iterations,
    };
    Ok(Node { state, orientation, rank: factor.rank })
}

/// A corrected position.
pub(super) struct Corrected {
    q: Vec<f64>,
    iterations: usize,
    /// The row with the largest residual at the prediction.
    worst: usize,
    /// Distance from the prediction, on the common scale.
    correction: f64,
}

/// Full Newton steps from the prediction until one is below `last_step`.
pub(super) fn correct(
    equations: &mut Equations<'_>,
    predicted: &[f64],
    allowed: f64,
    last_step: f64,
) -> Result<Corrected, Fault> {
    let rows = equations.rows_where(Equations::holonomic);
    let mut q = predicted.to_vec();
    let mut before = f64::INFINITY;
    let mut worst = 0;
    for iterations in 1..=CORRECTIONS {
        equations.evaluate(Subset::POSITION, &q, None)?;
        let phi = DVector::from_iterator(rows.len(), rows.iter().map(|&r| equations.phi[r] * equations.scale.rows[r]));
        if iterations == 1 {
            worst = rows.get(phi.iamax_or_zero()).copied().unwrap_or(0);
        }
        let tolerance = 0.1 * equations.options.rank_tolerance;
        let factor = Factorization::quick(&equations.scaled_rows(&rows), &equations.scale.columns, tolerance);
        let step = factor.solve(&phi);
        q.iter_mut().zip(step.iter()).for_each(|(q, s)| *q -= s);
        let length = equations.scale.size(step.as_slice());
        let travel: Vec<f64> = q.iter().zip(predicted).map(|(a, b)| a - b).collect();
        let correction = equations.scale.size(&travel);
        if !(length <= CONTRACTION * before && correction <= allowed) {
            // Also when something is not a number. At the level of rounding nothing contracts any more.
            if !(length <= last_step && correction <= allowed) {
                return Err(Fault::Open(worst));
            }
        }
        if length <= last_step {
            return Ok(Corrected { q, iterations, worst, correction });
        }
        before = length;
    }
    Err(Fault::Open(worst))
}

/// Largest scaled residual that counts as closed at q.
fn closed(equations: &Equations<'_>, q: &[f64]) -> f64 {
    equations.options.tolerance.max(rounding(equations.scale.size(q)))
}

/// True if the velocity is about where q̇ + h q̈ expects it.
fn expected(equations: &Equations<'_>, from: &State, h: f64, q_dot: &[f64]) -> bool {
    let scale = &equations.scale;
    let change: Vec<f64> =
        q_dot.iter().zip(&from.q_dot).zip(&from.q_ddot).map(|((new, old), a)| new - (old + h * a)).collect();
    let size = scale.size(q_dot).max(scale.size(&from.q_dot)).max(h.abs() * scale.size(&from.q_ddot));
    scale.size(&change) <= VELOCITY * size || h.abs() * size <= INSTANTANEOUS
}

/// `iamax` that accepts an empty vector.
trait LargestEntry {
    fn iamax_or_zero(&self) -> usize;
}

impl LargestEntry for DVector<f64> {
    fn iamax_or_zero(&self) -> usize {
        if self.is_empty() { 0 } else { self.iamax() }
    }
}
