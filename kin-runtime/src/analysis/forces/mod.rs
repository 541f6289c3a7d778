//! Forces: solves Φ_qᵀ λ = r at a solved state, and computes efforts and reactions from λ.
//!
//! Along a plan the generated code computes λ in closed form. Otherwise λ is solved here from the scaled Φ_q: R Φ_q D
//! with rows and columns on the common scale, (R Φ_q D)ᵀ y = D r, λ = R y. This is so if coordinates are prescribed, if
//! special dimensions leave a degree of freedom open that the plan does not take into account, and if the closed forms
//! give no solution.

mod collected;
mod numbers;
mod sharing;

use crate::analysis::singular::diagnose;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::forces::{Effort, Forces, Load};
use crate::linear::Factorization;
use crate::mobility::mobility;
use crate::model::forces::TOTALS;
use crate::model::{ForceModel, Frame, LoadInfo, Model};
use crate::signal::{Instant, Signal};
use crate::state::State;
use crate::workspace::Subset;
pub(crate) use collected::collected;
use nalgebra::{DMatrix, DVector};
pub(crate) use numbers::{Numbers, Sharing};

/// Largest residual of the solution for λ, relative to r.
const LEFT_OVER: f64 = 1e-7;

/// A residual below this, relative to the largest entry of r, may be due to rounding in an entry that is 0.
const ROUNDING: f64 = 1e-10;

/// The forces at a state.
pub(crate) fn forces(equations: &mut Equations<'_>, state: &State, sharing: Sharing) -> Result<Forces, SolveError> {
    let model = equations.model;
    let Some(info) = model.forces else {
        return Err(SolveError::NoLoads { mechanism: model.name });
    };
    let numbers = numbers(equations, info, state, sharing)?;
    let inputs = inputs(equations, info, state, &numbers)?;
    Ok(Forces { inputs, ..collected(model, info, state, &numbers) })
}

/// The effort of every input: the sum of the efforts of all drivers and of all held coordinates, each times the derivative
/// of its rate by the rate of the input. The sum does not depend on how redundant rows share a load if the input can move
/// alone, because a mechanism that follows it moves as each of these rows demands.
fn inputs(
    equations: &Equations<'_>,
    info: &ForceModel,
    state: &State,
    numbers: &Numbers,
) -> Result<Vec<Effort>, SolveError> {
    let model = equations.model;
    let lambda = &numbers.values[TOTALS..TOTALS + model.rows.len()];
    let mut inputs: Vec<Signal> = state.inputs.iter().map(|input| Signal::constant(input.value)).collect();
    let [mut still, mut moving] = [(); 2].map(|()| vec![0.0; info.count]);
    let write = |inputs: &[Signal], values: &mut [f64]| {
        equations.system.forces(&Instant { t: state.t, inputs }, state, lambda, values)
    };
    if !model.inputs.is_empty() {
        write(&inputs, &mut still)?;
    }
    let mut efforts = Vec::with_capacity(model.inputs.len());
    for (k, (&name, input)) in model.inputs.iter().zip(&state.inputs).enumerate() {
        inputs[k].rate = 1.0;
        write(&inputs, &mut moving)?;
        inputs[k].rate = 0.0;
        let by_input = |place: usize| moving[place + 1] - still[place + 1];
        let terms: Vec<(usize, f64)> = info.efforts.iter().map(|info| (info.place, by_input(info.place))).collect();
        let effort = terms.iter().map(|&(place, by_input)| numbers.values[place] * by_input).sum();
        let determined = numbers.is_determined(&terms);
        let shown = determined || numbers.sharing == Sharing::LeastNorm;
        efforts.push(Effort { name, effort: shown.then_some(effort), rate: input.rate, determined });
    }
    Ok(efforts)
}

/// What loads exert on bodies at a state.
pub(crate) fn loads(equations: &Equations<'_>, state: &State) -> Result<Vec<Load>, SolveError> {
    let model = equations.model;
    let info = model.forces.ok_or(SolveError::NoLoads { mechanism: model.name })?;
    for (name, list) in [("q", &state.q), ("q_dot", &state.q_dot)] {
        equations.check(name, list)?;
    }
    let mut numbers = vec![0.0; info.loads.last().map_or(0, LoadInfo::end)];
    equations.system.loads(&state.instant(), state, &mut numbers)?;
    let load = |load: &LoadInfo| {
        let at = |k: usize| numbers[load.place + k];
        let force = load.is_force.then(|| [[at(0), at(1)], [at(2), at(3)]]);
        Load { name: load.name, on: load.on, force, couple: (!load.is_force).then(|| at(0)) }
    };
    Ok(info.loads.iter().map(load).collect())
}

/// The numbers of forces at a state.
pub(crate) fn numbers(
    equations: &mut Equations<'_>,
    info: &ForceModel,
    state: &State,
    sharing: Sharing,
) -> Result<Numbers, SolveError> {
    for (name, list) in [("q", &state.q), ("q_dot", &state.q_dot), ("q_ddot", &state.q_ddot)] {
        equations.check(name, list)?;
    }
    let numbers = match by_plan(equations, info, state)? {
        Some(values) => {
            let determined = vec![true; values.len()];
            Numbers { values, determined, changes: DMatrix::zeros(0, 0), given: Vec::new(), sharing, by_plan: true }
        }
        None => by_elimination(equations, info, state, sharing)?,
    };
    masses_are_not_negative(equations.model, info, |index| numbers.values[index])?;
    Ok(numbers)
}

/// An error for a negative mass or moment of inertia; `value` gives the numbers of forces.
pub(crate) fn masses_are_not_negative(
    model: &Model,
    info: &ForceModel,
    value: impl Fn(usize) -> f64,
) -> Result<(), SolveError> {
    for mass in info.masses {
        let Frame::Body(body) = mass.on else { continue };
        for (value, is_inertia) in [(value(mass.place), false), (value(mass.place + 1), true)] {
            if value < 0.0 {
                return Err(SolveError::NegativeMass { body: model.bodies[body].name, is_inertia, value });
            }
        }
    }
    Ok(())
}

/// The numbers by the closed forms; none without closed forms, and if they give no solution.
fn by_plan(equations: &mut Equations<'_>, info: &ForceModel, state: &State) -> Result<Option<Vec<f64>>, SolveError> {
    let rows = equations.model.rows.len();
    // The closed forms take neither prescribed coordinates into account nor degrees of freedom that special dimensions
    // leave open.
    if !info.solved || state.degrees_of_freedom_left > 0 || equations.rows() > rows {
        return Ok(None);
    }
    let mut values = vec![0.0; info.count];
    equations.system.forces(&state.instant(), state, &[], &mut values)?;
    let mut r = vec![0.0; equations.coordinates()];
    equations.system.generalized_forces(&state.instant(), state, &mut r)?;
    equations.evaluate(Subset::JACOBIAN, &state.q, None)?;
    let mut rest = r.clone();
    let lambda = &values[TOTALS..TOTALS + rows];
    for ((row, column), entry) in equations.entries() {
        rest[column] -= entry * lambda[row];
    }
    let coordinates = equations.model.coordinates;
    let largest = |list: &[f64], of_lengths: bool| {
        let entries_of_kind = list.iter().enumerate().filter(|(k, _)| coordinates[*k].kind.is_length() == of_lengths);
        entries_of_kind.fold(0.0, |largest: f64, (_, x)| if x.is_nan() { f64::INFINITY } else { largest.max(x.abs()) })
    };
    let closes = [true, false].into_iter().all(|kind| largest(&rest, kind) <= LEFT_OVER * largest(&r, kind));
    let finite = values.iter().all(|value| value.is_finite());
    Ok((closes && finite).then_some(values))
}

/// The numbers by a numeric solution for λ.
fn by_elimination(
    equations: &mut Equations<'_>,
    info: &ForceModel,
    state: &State,
    sharing: Sharing,
) -> Result<Numbers, SolveError> {
    let declared = equations.model.rows.len();
    let n = equations.coordinates();
    let mut r = vec![0.0; n];
    equations.system.generalized_forces(&state.instant(), state, &mut r)?;
    let name = |k: usize| equations.model.coordinates[k].name;
    if let Some(place) = r.iter().position(|r| !r.is_finite()) {
        return Err(not_finite(equations, state).unwrap_or(SolveError::NonFinite {
            what: "Q − M q̈",
            index: place,
            name: name(place),
            t: Some(state.t),
        }));
    }
    equations.scale = Scale::around(equations, &state.q);
    equations.evaluate(Subset::VELOCITY, &state.q, None)?;
    let all: Vec<usize> = (0..equations.rows()).collect();
    let scaled = equations.scaled(&all).transpose();
    let right = DVector::from_iterator(n, r.iter().zip(&equations.scale.columns).map(|(r, d)| r * d));
    let tolerance = equations.options.rank_tolerance;
    let factor = Factorization::revealing(&scaled, &vec![1.0; all.len()], tolerance);
    let mut y = factor.solve(&right);
    // Large forces elsewhere leave errors of their own size times rounding in small ones; one step of refinement removes
    // these.
    y += factor.solve(&(&right - &scaled * &y));
    if !balances(&scaled, &y, &right) {
        return Err(not_held(equations, state, &scaled)?);
    }
    let shared = sharing::Shared::new(equations, info, state, &scaled, y, factor.rank)?;
    let (y, determined) = (shared.multipliers(), shared.determined());
    let lambda = shared.unscaled(&y);
    let mut values = vec![0.0; info.count];
    equations.system.forces(&state.instant(), state, &lambda[..declared], &mut values)?;
    finite("forces", &values, state.t)?;
    let given = (declared..all.len()).map(|row| {
        let rate = equations.given_coordinate(row - declared).map_or(0.0, |k| state.q_dot[k]);
        (equations.row_name(row), -lambda[row], rate, shared.is_determined(row))
    });
    let given = given.collect();
    Ok(Numbers { values, determined, changes: shared.changes(), given, sharing, by_plan: false })
}

/// Whether y solves every equation: relative to its own terms, so that a small load that nothing holds shows beside large
/// ones elsewhere.
fn balances(matrix: &DMatrix<f64>, y: &DVector<f64>, right: &DVector<f64>) -> bool {
    let (rest, largest) = (matrix * y - right, right.amax());
    rest.iter().enumerate().all(|(row, rest)| {
        let terms = matrix.row(row).iter().zip(y).map(|(entry, y)| (entry * y).abs()).fold(right[row].abs(), f64::max);
        rest.abs() <= LEFT_OVER * largest && rest.abs() <= LEFT_OVER * terms + ROUNDING * largest
    })
}

/// The first load that is not a finite number.
fn not_finite(equations: &Equations<'_>, state: &State) -> Option<SolveError> {
    let all = loads(equations, state).ok()?;
    let bad = |load: &Load| {
        let numbers = load.force.into_iter().flatten().flatten().chain(load.couple);
        numbers.into_iter().any(|x| !x.is_finite())
    };
    let (index, load) = all.iter().enumerate().find(|(_, load)| bad(load))?;
    Some(SolveError::NonFinite { what: "loads", index, name: load.name, t: Some(state.t) })
}

/// The reason why no multipliers balance r: the configuration is singular, or degrees of freedom are open.
fn not_held(equations: &mut Equations<'_>, state: &State, scaled: &DMatrix<f64>) -> Result<SolveError, SolveError> {
    let columns = vec![1.0; scaled.nrows()];
    let factor = Factorization::absolute(&scaled.transpose(), &columns, equations.options.rank_tolerance);
    if let Some(error @ SolveError::Singular { .. }) = diagnose(equations, &state.q, &factor) {
        return Ok(unbounded(equations.model, error));
    }
    let open = mobility(equations, &state.q)?;
    let could_be_given = open.could_be_given.iter().map(|&k| equations.model.coordinates[k].name).collect();
    Ok(SolveError::NotHeld { t: state.t, open: open.degrees_of_freedom_left, could_be_given })
}

/// What a singular configuration means for forces: those of the joints whose rows depend on one another there grow
/// without bounds near it. Other errors are returned unchanged.
pub(crate) fn unbounded(model: &Model, error: SolveError) -> SolveError {
    let SolveError::Singular { t, rows, condition, limit, .. } = error else { return error };
    let mut joints: Vec<&'static str> = Vec::new();
    for row in rows {
        let info = model.rows.iter().find(|info| info.name == row);
        let joint = info.map_or(row, |info| model.joints[info.joint].name);
        if !joints.contains(&joint) {
            joints.push(joint);
        }
    }
    SolveError::UnboundedForces { t, joints, condition, limit }
}

fn finite(what: &'static str, values: &[f64], t: f64) -> Result<(), SolveError> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(SolveError::NonFinite { what, index, name: "", t: Some(t) }),
    }
}
