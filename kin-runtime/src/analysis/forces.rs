//! Forces: Φ_qᵀ λ = r at a solved state, and what λ means.
//!
//! Along a plan the closed forms hold λ themselves. Otherwise λ is solved here from the scaled Φ_q: R Φ_q D with rows and
//! columns on the common scale, (R Φ_q D)ᵀ y = D r, λ = R y. Where rows are more than their rank, y is that of least norm,
//! and what changes along a null vector of the transposed matrix is undetermined: equilibrium alone does not tell it.

use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::forces::{Effort, Forces, Reaction, SpringForce, Wrench};
use crate::linear::{Factorization, null_space};
use crate::mobility::mobility;
use crate::model::forces::TOTALS;
use crate::model::{ForceModel, Model};
use crate::state::State;
use crate::workspace::Subset;
use nalgebra::DVector;

/// What counts as a change along a null vector, beside the largest change.
const CHANGE: f64 = 1e-9;
/// What of r may be left over, beside r.
const LEFT_OVER: f64 = 1e-7;

/// The numbers of forces, and which of them equilibrium determines; efforts of prescribed coordinates.
pub(crate) struct Numbers {
    pub(crate) values: Vec<f64>,
    pub(crate) determined: Vec<bool>,
    /// Name, effort and rate.
    pub(crate) given: Vec<(&'static str, f64, f64)>,
}

/// The forces at a state.
pub(crate) fn forces(equations: &mut Equations<'_>, state: &State) -> Result<Forces, SolveError> {
    let model = equations.model;
    let Some(info) = model.forces else {
        return Err(SolveError::NoLoads { mechanism: model.name });
    };
    let numbers = numbers(equations, info, state)?;
    Ok(collected(model, info, state, &numbers))
}

/// The numbers of forces at a state.
pub(crate) fn numbers(equations: &mut Equations<'_>, info: &ForceModel, state: &State) -> Result<Numbers, SolveError> {
    for (what, list) in [("q", &state.q), ("q_dot", &state.q_dot), ("q_ddot", &state.q_ddot)] {
        equations.check(what, list)?;
    }
    let mut values = vec![0.0; info.count];
    // Closed forms along the plan know no degree of freedom that dimensions leave open.
    if info.solved && state.degrees_of_freedom_left > 0 {
        return Err(not_held(equations, state)?);
    }
    if info.solved {
        equations.system.forces(&state.instant(), state, &[], &mut values)?;
        finite(&values, state.t)?;
        let determined = vec![true; values.len()];
        return Ok(Numbers { values, determined, given: Vec::new() });
    }
    let declared = equations.model.rows.len();
    let n = equations.coordinates();
    let mut r = vec![0.0; n];
    equations.system.generalized_forces(&state.instant(), state, &mut r)?;
    equations.scale = Scale::around(equations, &state.q);
    equations.evaluate(Subset::VELOCITY, &state.q, None)?;
    let all: Vec<usize> = (0..equations.rows()).collect();
    let scaled = equations.scaled(&all).transpose();
    let right = DVector::from_iterator(n, r.iter().zip(&equations.scale.columns).map(|(r, d)| r * d));
    let tolerance = equations.options.rank_tolerance;
    let factor = Factorization::revealing(&scaled, &vec![1.0; all.len()], tolerance);
    let y = factor.solve(&right);
    let left_over = (&scaled * &y - &right).amax();
    if left_over > LEFT_OVER * right.amax().max(f64::MIN_POSITIVE) {
        return Err(not_held(equations, state)?);
    }
    let lambda = |y: &DVector<f64>| -> Vec<f64> { y.iter().zip(&equations.scale.rows).map(|(y, s)| y * s).collect() };
    let multipliers = lambda(&y);
    let rate_of = |row: usize| equations.given_coordinate(row - declared).map_or(0.0, |k| state.q_dot[k]);
    let given: Vec<(usize, f64, f64)> =
        (declared..all.len()).map(|row| (row, -multipliers[row], rate_of(row))).collect();
    equations.system.forces(&state.instant(), state, &multipliers[..declared], &mut values)?;
    finite(&values, state.t)?;
    let mut determined = vec![true; values.len()];
    let null = if factor.rank < all.len() { Some(null_space(&scaled, tolerance)) } else { None };
    let at_zero = {
        let mut at_zero = vec![0.0; info.count];
        equations.system.forces(&state.instant(), state, &vec![0.0; declared], &mut at_zero)?;
        at_zero
    };
    let mut moved = vec![0.0; info.count];
    for vector in null.iter().flat_map(|null| null.column_iter()) {
        let along = lambda(&vector.into_owned());
        equations.system.forces(&state.instant(), state, &along[..declared], &mut moved)?;
        let change = |k: usize| (moved[k] - at_zero[k]).abs();
        let largest = (0..moved.len()).map(change).fold(0.0, f64::max);
        for (k, determined) in determined.iter_mut().enumerate() {
            *determined &= change(k) <= CHANGE * largest;
        }
    }
    let given = given.into_iter().map(|(row, effort, rate)| (equations.row_name(row), effort, rate)).collect();
    Ok(Numbers { values, determined, given })
}

/// What is left open, as an error.
fn not_held(equations: &mut Equations<'_>, state: &State) -> Result<SolveError, SolveError> {
    let open = mobility(equations, &state.q)?;
    let could_be_given = open.could_be_given.iter().map(|&k| equations.model.coordinates[k].name).collect();
    Ok(SolveError::NotHeld { t: state.t, open: open.degrees_of_freedom_left, could_be_given })
}

fn finite(values: &[f64], t: f64) -> Result<(), SolveError> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(SolveError::NonFinite { what: "forces", index, name: "", t: Some(t) }),
    }
}

/// The numbers by what they are.
pub(crate) fn collected(model: &'static Model, info: &ForceModel, state: &State, numbers: &Numbers) -> Forces {
    let Numbers { values, determined, given } = numbers;
    let wrench = |place: usize| Wrench { force: [values[place], values[place + 1]], moment: values[place + 2] };
    let known = |place: usize| determined[place].then(|| values[place]);
    let effort = |info: &crate::model::EffortInfo| Effort {
        name: info.name,
        effort: known(info.place),
        rate: values[info.place + 1],
    };
    let of_given = given.iter().map(|&(name, effort, rate)| Effort { name, effort: Some(effort), rate });
    let rows = model.rows.len();
    let powers_of_given: f64 = given.iter().map(|(_, effort, rate)| effort * rate).sum();
    Forces {
        t: state.t,
        model,
        efforts: info.efforts.iter().map(effort).chain(of_given).collect(),
        reactions: info.reactions.iter().map(|reaction| reaction_of(reaction, values, determined)).collect(),
        springs: info
            .springs
            .iter()
            .map(|spring| SpringForce {
                name: spring.name,
                turns: spring.turns,
                length: values[spring.place],
                rate: values[spring.place + 1],
                force: values[spring.place + 2],
                energy: values[spring.place + 3],
                damper_power: values[spring.place + 4],
            })
            .collect(),
        shaking: wrench(0),
        inertia: wrench(3),
        kinetic: values[6],
        gravity: values[7],
        elastic: values[8],
        driver_power: values[9] + powers_of_given,
        applied_power: values[10],
        damper_power: values[11],
        energy_rate: values[12],
        multipliers: values[TOTALS..TOTALS + rows].to_vec(),
    }
}

fn reaction_of(info: &crate::model::ReactionInfo, values: &[f64], determined: &[bool]) -> Reaction {
    let mut place = info.place;
    let mut next = |count: usize| {
        place += count;
        place - count
    };
    let (point, force) = if info.has_force { (Some(next(2)), Some(next(2))) } else { (None, None) };
    let moment = info.has_moment.then(|| next(1));
    let couples: Vec<usize> = info.couples.iter().map(|_| next(1)).collect();
    let generalized: Vec<usize> = (0..info.generalized).map(|_| next(1)).collect();
    let known = |places: &[usize]| places.iter().all(|&place| determined[place]);
    let pair = |place: usize| [values[place], values[place + 1]];
    let all: Vec<usize> = (info.place..place).collect();
    let couples_known = known(&couples);
    let generalized_known = known(&generalized);
    Reaction {
        name: info.name,
        on: info.on,
        point: point.map(pair),
        force: force.filter(|&place| known(&[place, place + 1])).map(pair),
        moment: moment.filter(|&place| known(&[place])).map(|place| values[place]),
        couples: match couples_known {
            true => info.couples.iter().zip(couples).map(|(frame, place)| (*frame, values[place])).collect(),
            false => Vec::new(),
        },
        generalized: if generalized_known {
            generalized.iter().map(|&place| values[place]).collect()
        } else {
            Vec::new()
        },
        determined: known(&all),
    }
}
