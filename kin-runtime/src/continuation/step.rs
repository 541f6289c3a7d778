//! One step of the continuation: predict, correct, judge.

use super::branch::Orientation;
use crate::acceleration::acceleration;
use crate::by_plan::{self, Answer};
use crate::contact;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::factorisation::Wanted;
use crate::linear::Factorization;
use crate::newton::rounding;
use crate::plan::Depth;
use crate::planned::Limit;
use crate::state::State;
use crate::trajectory::Fallback;
use crate::velocity::{consistent, inconsistency, scaled};
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
    /// Place on the course: time, unless the course is frozen.
    pub(crate) s: f64,
    pub(crate) state: State,
    pub(crate) orientation: Orientation,
    /// Φ_q here.
    pub(crate) factor: Factorization,
    /// The sign of every mode of the plan, 0 where it is not decided; empty where no plan is used.
    pub(crate) modes: Vec<f64>,
    /// Why full Newton had to find this node, where there is a plan.
    pub(crate) fallback: Option<Fallback>,
}

/// Where a step begins: a node, its place on the course, and its rates along it.
#[derive(Clone, Copy)]
pub(crate) struct Start<'n> {
    pub(crate) node: &'n Node,
    pub(crate) s: f64,
    pub(crate) q_dot: &'n [f64],
    pub(crate) q_ddot: &'n [f64],
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

/// Buffers of the steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    motion: Vec<f64>,
    pub(super) predicted: Vec<f64>,
    difference: Vec<f64>,
    rest: Vec<[f64; 2]>,
    /// Rows of position level.
    closing: Vec<usize>,
    /// What the plan says, where it is used.
    pub(super) answer: Option<Answer>,
}

impl Scratch {
    pub(crate) fn new(equations: &Equations<'_>) -> Self {
        let closing = equations.rows_where(Equations::holonomic);
        let planned = equations.options.use_plan && by_plan::exists(equations);
        let answer = planned.then(|| Answer::new(equations));
        Self { closing, answer, ..Self::default() }
    }
}

/// Writes the node at the place `s` to `to`; gives by how much the next step may be longer.
///
/// With `last` the node is an instant that was asked for: closed to the end and with its rank revealed.
pub(crate) fn step(
    equations: &mut Equations<'_>,
    scratch: &mut Scratch,
    from: Start<'_>,
    to: &mut Node,
    s: f64,
    last: bool,
) -> Result<f64, Fault> {
    let h = s - from.s;
    equations.move_to(s)?;
    let Scratch { motion, predicted, .. } = &mut *scratch;
    fill(motion, from.q_dot.iter().zip(from.q_ddot).map(|(v, a)| h * (v + 0.5 * h * a)));
    fill(predicted, from.node.state.q.iter().zip(motion.iter()).map(|(q, d)| q + d));
    let allowed = equations.options.prediction_tolerance * equations.scale.size(motion) + NEGLIGIBLE;
    let mut fallback = None;
    if scratch.answer.is_some() {
        match planned(equations, scratch, &from, &mut to.state.q, allowed) {
            Ok(corrected) => match finish(equations, scratch, from, to, corrected, (s, allowed, last)) {
                Ok(growth) => {
                    to.modes.clone_from(&from.node.modes);
                    to.fallback = None;
                    return Ok(growth);
                }
                Err(_) => fallback = Some(Fallback { t: equations.t, limit: None }),
            },
            Err(limit) => fallback = Some(Fallback { t: equations.t, limit }),
        }
    }
    let corrected = correct(equations, scratch, &mut to.state.q, allowed, if last { 1e-9 } else { 1e-6 })?;
    let growth = finish(equations, scratch, from, to, corrected, (s, allowed, last))?;
    if fallback.is_some() {
        by_plan::modes(equations, &to.state.q, &mut to.modes);
    }
    to.fallback = fallback;
    Ok(growth)
}

/// Completes and judges a step whose q was found; gives by how much the next one may be longer.
fn finish(
    equations: &mut Equations<'_>,
    scratch: &mut Scratch,
    from: Start<'_>,
    to: &mut Node,
    corrected: Corrected,
    (s, allowed, last): (f64, f64, bool),
) -> Result<f64, Fault> {
    let effort = corrected.correction / allowed;
    let worst = corrected.worst;
    settle(equations, scratch, from, to, corrected, s, last)?;
    if !expected(equations, &mut scratch.difference, &from, s - from.s, &to.state.q_dot) {
        return Err(Fault::Jump(worst));
    }
    Ok(if effort <= 0.3 / 64.0 { 4.0 } else { (0.3 / effort).cbrt().clamp(0.5, 4.0) })
}

/// q by the plan from the prediction in `scratch`, in the modes of the node.
///
/// The prediction must be in the same modes: where it is not, the motion may pass a configuration in which two branches
/// cross, and a sign that is kept there would leave the branch.
///
/// # Errors
/// The group that is no good, where one is to blame.
fn planned(
    equations: &mut Equations<'_>,
    scratch: &mut Scratch,
    from: &Start<'_>,
    q: &mut Vec<f64>,
    allowed: f64,
) -> Result<Corrected, Option<Limit>> {
    let Scratch { predicted, difference: travel, answer, .. } = scratch;
    let answer = answer.as_mut().ok_or(None)?;
    let modes = &from.node.modes;
    if modes.contains(&0.0) {
        return Err(None);
    }
    let rated = !equations.is_frozen();
    answer.solve(equations, modes, predicted, if rated { Depth::Acceleration } else { Depth::Position })?;
    q.clone_from(&answer.q);
    fill(travel, q.iter().zip(predicted.iter()).map(|(a, b)| a - b));
    let correction = equations.scale.size(travel);
    if correction > allowed || !answer.is_in(equations, modes, predicted) {
        return Err(None);
    }
    Ok(Corrected { iterations: 1, worst: 0, correction, rated })
}

/// Completes the node at the place `s`, whose q was found, if it is on the branch of `from`.
pub(super) fn settle(
    equations: &mut Equations<'_>,
    scratch: &mut Scratch,
    from: Start<'_>,
    to: &mut Node,
    corrected: Corrected,
    s: f64,
    last: bool,
) -> Result<(), Fault> {
    let Corrected { iterations, worst, rated, .. } = corrected;
    let Scratch { closing, rest, answer, .. } = scratch;
    let state = &mut to.state;
    let rates = answer.as_ref().filter(|_| rated);
    match rates {
        Some(answer) => equations.evaluate(Subset::ALL, &state.q, Some(&answer.q_dot))?,
        None => equations.evaluate(Subset { phi: true, ..Subset::VELOCITY }, &state.q, None)?,
    }
    let gap = closing.iter().map(|&row| (equations.phi[row] * equations.scale.rows[row]).abs()).fold(0.0, f64::max);
    if gap > equations.options.tolerance && gap > closed(equations, &state.q) {
        return Err(Fault::Open(worst));
    }
    if let Some(row) = contact::turned_about(equations, &from.node.state.q, &state.q) {
        return Err(Fault::Jump(row));
    }
    let wanted = if last { Wanted::Rank } else { Wanted::Solutions };
    to.factor = equations.factorise(wanted, Some(to.factor.take()));
    let rank = to.factor.rank;
    if rank != from.node.factor.rank {
        return Err(Fault::Jump(worst));
    }
    if !from.node.orientation.keep(equations, &to.factor, &mut to.orientation) {
        return Err(Fault::Jump(worst));
    }
    if let Some(answer) = rates {
        if !consistent(equations, &answer.q_dot, &answer.q_ddot, rest) {
            return Err(Fault::Open(worst));
        }
        state.q_dot.clone_from(&answer.q_dot);
        state.q_ddot.clone_from(&answer.q_ddot);
    } else {
        let right = -scaled(equations, &equations.phi_t);
        let q_dot = to.factor.solve(&right);
        if inconsistency(equations, &q_dot, &right).is_some() {
            return Err(Fault::Open(worst));
        }
        equations.check("q_dot", q_dot.as_slice())?;
        fill(&mut state.q_dot, q_dot.iter().copied());
        state.q_ddot = acceleration(equations, &state.q, &state.q_dot, &to.factor)?;
    }
    to.s = s;
    state.t = equations.t;
    state.inputs.clone_from(&equations.inputs);
    state.degrees_of_freedom_left = state.q.len() - rank;
    state.condition = to.factor.condition;
    state.residual = closing.iter().map(|&row| equations.phi[row].abs()).fold(0.0, f64::max);
    state.iterations = iterations;
    Ok(())
}

/// Replaces what a buffer holds.
fn fill(buffer: &mut Vec<f64>, values: impl Iterator<Item = f64>) {
    buffer.clear();
    buffer.extend(values);
}

/// A corrected position.
pub(super) struct Corrected {
    iterations: usize,
    /// The row with the largest residual at the prediction.
    worst: usize,
    /// Distance from the prediction, on the common scale.
    correction: f64,
    /// Whether the plan gave rates too.
    rated: bool,
}

/// Full Newton steps from the prediction in `scratch` until one is below `last_step`; q is written.
pub(super) fn correct(
    equations: &mut Equations<'_>,
    scratch: &mut Scratch,
    q: &mut Vec<f64>,
    allowed: f64,
    last_step: f64,
) -> Result<Corrected, Fault> {
    let Scratch { predicted, difference: travel, closing: rows, .. } = scratch;
    q.clone_from(predicted);
    let mut before = f64::INFINITY;
    let mut worst = 0;
    let all = rows.len() == equations.rows();
    let mut memory: Option<Factorization> = None;
    for iterations in 1..=CORRECTIONS {
        equations.evaluate(Subset::POSITION, q, None)?;
        let phi = DVector::from_iterator(rows.len(), rows.iter().map(|&r| equations.phi[r] * equations.scale.rows[r]));
        if iterations == 1 {
            worst = rows.get(phi.iamax_or_zero()).copied().unwrap_or(0);
        }
        let tolerance = 0.1 * equations.options.rank_tolerance;
        let sparse = if all { equations.factorise_sparse(Wanted::Solutions, memory.take()) } else { None };
        let factor = sparse
            .unwrap_or_else(|| Factorization::quick(&equations.scaled_rows(rows), &equations.scale.columns, tolerance));
        let step = factor.solve(&phi);
        memory = Some(factor);
        q.iter_mut().zip(step.iter()).for_each(|(q, s)| *q -= s);
        let length = equations.scale.size(step.as_slice());
        fill(travel, q.iter().zip(predicted.iter()).map(|(a, b)| a - b));
        let correction = equations.scale.size(travel);
        if !(length <= CONTRACTION * before && correction <= allowed) {
            // Also when something is not a number. At the level of rounding nothing contracts any more.
            if !(length <= last_step && correction <= allowed) {
                return Err(Fault::Open(worst));
            }
        }
        if length <= last_step {
            return Ok(Corrected { iterations, worst, correction, rated: false });
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
fn expected(equations: &Equations<'_>, change: &mut Vec<f64>, from: &Start<'_>, h: f64, q_dot: &[f64]) -> bool {
    let scale = &equations.scale;
    fill(change, q_dot.iter().zip(from.q_dot).zip(from.q_ddot).map(|((new, old), a)| new - (old + h * a)));
    let (change, size) = (scale.size(change), scale.size(q_dot));
    let whole = || size.max(scale.size(from.q_dot)).max(h.abs() * scale.size(from.q_ddot));
    change <= VELOCITY * size || change <= VELOCITY * whole() || h.abs() * whole() <= INSTANTANEOUS
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
