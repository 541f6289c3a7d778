//! Velocity ratios of the coordinates to each driving row and each input.
//!
//! For a driving row d with right-hand side f, written left minus right,
//!
//! ```text
//! Φ_q k = e_d        k = ∂q/∂f        first-order ratio (velocity ratio)
//! Φ_q l = −(Φ_q k)_q k        l = ∂²q/∂f²        second-order ratio (acceleration coefficient)
//! ```
//!
//! −(Φ_q k)_q k is the even part of γ in q̇: ½ [γ(k) + γ(−k)] − γ(0). A distance is written with squares, |d|² − f² = 0;
//! its ratios are per change of f itself: Φ_q k = 2 f e_d and Φ_q l = −(Φ_q k)_q k + 2 e_d.
//!
//! For an input u, wherever it stands in Φ,
//!
//! ```text
//! Φ_q k = −Φ_u                                k = ∂q/∂u
//! Φ_q l = −(Φ_q k)_q k − 2 Φ_qu k − Φ_uu      l = ∂²q/∂u²
//! ```
//!
//! With rows of velocity level, a row's k is ∂q̇/∂f, an input's k is ∂q̇/∂u̇, and l u̇² is its share of q̈; q is no
//! function of u then. Φ_u is the part of Φ_t that is linear in u̇, Φ_t(u̇ = 1) − Φ_t(u̇ = 0); the right-hand side of l
//! is the part of γ that is even in q̇ and u̇ together, at q̇ = k, u̇ = 1.

use crate::analysis::rounding::{REGULAR_CONDITION, dominated_coordinate};
use crate::analysis::velocity::{factorize, inconsistency, scaled};
use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::model::Input;
use crate::model::{JointInfo, JointKind, Role};
use crate::signal::{Instant, Signal};
use crate::state::State;
use crate::text::numbers;
use crate::workspace::Subset;
use core::fmt;
use nalgebra::DVector;

/// The velocity ratio of q to one driving row, or to one input, with all others and time constant.
///
/// The numbers of an input contain its effect through u̇ and ü only. If a row of velocity level contains the *value* of
/// the input (a `speed` that it prescribes), q̇ depends on u itself; that is the ratio of the row.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VelocityRatio {
    /// The index of the driving row in Φ; none for an input.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub row: Option<usize>,
    /// The name of the row or of the input.
    pub name: &'static str,
    /// The row's joint; none for an input.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub joint: Option<&'static str>,
    /// k = ∂q/∂f (∂q̇/∂f for a row of velocity level), n numbers: Φ_q k = e_d, with f the row's right-hand side (Φ_q k = 2 f e_d
    /// for a distance); of an input ∂q/∂u.
    pub first: Vec<f64>,
    /// l = ∂²q/∂f², n numbers: Φ_q l = −(Φ_q k)_q k (plus 2 e_d for a distance); of an input ∂²q/∂u².
    pub second: Vec<f64>,
    /// Its own share of q̇: k ḟ, or k u̇.
    pub q_dot: Vec<f64>,
    /// Its own share of q̈, with all others constant: k f̈ + l ḟ², or k ü + l u̇². A row that mixes q with time, as
    /// `s.phi * t = 1` does, adds −2 k Φ_qt q̇ with the share of q̇ above.
    pub q_ddot: Vec<f64>,
}

/// Velocity ratios per driving row and per input, in order of declaration; indexed by the handles of inputs.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VelocityRatios {
    /// One entry per driving row.
    pub drivers: Vec<VelocityRatio>,
    /// One entry per input.
    pub inputs: Vec<VelocityRatio>,
}

impl core::ops::Index<Input> for VelocityRatios {
    type Output = VelocityRatio;

    fn index(&self, input: Input) -> &VelocityRatio {
        &self.inputs[input.0]
    }
}

/// The ratios of every driving row at a state; prescribed coordinates are driving rows too.
pub(crate) fn velocity_ratios(equations: &mut Equations<'_>, state: &State) -> Result<VelocityRatios, SolveError> {
    equations.check("q", &state.q)?;
    let factor = factorize(equations, &state.q, None)?;
    let nu = -equations.phi_t.clone();
    let at_rest = gamma(equations, &state.q, &vec![0.0; state.q.len()])?;
    let distances = distances(equations)?;
    let mut drivers = Vec::new();
    for row in equations.rows_where(|e, row| e.drives(row)) {
        let [first, second] = certain_responses(equations, &factor, &state.q, &|equations, factor, q| {
            let first = first_of_row(equations, factor, row)?;
            let bend = equations.along(None, |equations| gamma(equations, q, first.as_slice()))?;
            Ok([first, respond(equations, factor, &bend)?])
        })?;
        let distance = distance_of(&distances, row);
        let q_dot = nu[row] * &first;
        let mixed = mixed_part(equations, &state.q, q_dot.as_slice(), row)?;
        drivers.push(VelocityRatio {
            row: Some(row),
            name: equations.row_name(row),
            joint: Some(equations.joint_name(row)),
            q_ddot: ((at_rest[row] + mixed) * &first + nu[row] * nu[row] * &second).as_slice().to_vec(),
            q_dot: q_dot.as_slice().to_vec(),
            second: match distance {
                Some(f) => (4.0 * f * f * second + 2.0 * &first).as_slice().to_vec(),
                None => second.as_slice().to_vec(),
            },
            first: (distance.map_or(1.0, |f| 2.0 * f) * first).as_slice().to_vec(),
        });
    }
    let inputs = (0..equations.inputs.len()).map(|k| input_ratio(equations, &factor, &state.q, k));
    Ok(VelocityRatios { drivers, inputs: inputs.collect::<Result<_, _>>()? })
}

/// The numbers of a ratio as a response of Φ_q: k and l, those of a distance not yet per change of f itself.
type Responses<'r> = &'r dyn Fn(&mut Equations<'_>, &Factorization, &[f64]) -> Result<[DVector<f64>; 2], SolveError>;

/// The responses at q; an error if rounding errors dominate l there.
fn certain_responses(
    equations: &mut Equations<'_>,
    factor: &Factorization,
    q: &[f64],
    responses: Responses<'_>,
) -> Result<[DVector<f64>; 2], SolveError> {
    let found = responses(equations, factor, q)?;
    if factor.condition < REGULAR_CONDITION {
        return Ok(found);
    }
    let all =
        |q: Vec<f64>, [first, second]: &[DVector<f64>; 2]| vec![q, first.as_slice().into(), second.as_slice().into()];
    let mut responses_at = |equations: &mut Equations<'_>, beside: Vec<f64>| {
        let factor_beside = factorize(equations, &beside, Some(factor.rank))?;
        let found = responses(equations, &factor_beside, &beside)?;
        Ok(all(beside, &found))
    };
    let dominated = dominated_coordinate(equations, &all(q.to_vec(), &found), 2, factor, &mut responses_at);
    equations.evaluate(Subset::VELOCITY, q, None)?;
    match dominated {
        Some(k) => Err(SolveError::Rounded { t: equations.t, coordinate: equations.model.coordinates[k].name }),
        None => Ok(found),
    }
}

/// Φ_q k = e_d for a driving row d.
fn first_of_row(equations: &Equations<'_>, factor: &Factorization, row: usize) -> Result<DVector<f64>, SolveError> {
    let mut unit = DVector::zeros(equations.rows());
    unit[row] = 1.0;
    respond(equations, factor, &unit)
}

/// Φ_q k = −Φ_u for input k.
fn first_of_input(
    equations: &mut Equations<'_>,
    factor: &Factorization,
    q: &[f64],
    k: usize,
) -> Result<DVector<f64>, SolveError> {
    let phi_u = equations.along(Some(k), |equations| {
        equations.evaluate(Subset::TIME_DERIVATIVE, q, None)?;
        Ok(equations.phi_t.clone())
    })?;
    respond(equations, factor, &-phi_u)
}

/// ∂q/∂f for every driving row f in `rows` and every input in `inputs`; none for those that cannot move alone.
pub(crate) fn first_ratios(
    equations: &mut Equations<'_>,
    q: &[f64],
    rows: &[usize],
    inputs: &[usize],
) -> Result<[Vec<Option<Vec<f64>>>; 2], SolveError> {
    equations.check("q", q)?;
    let factor = factorize(equations, q, None)?;
    let distances = distances(equations)?;
    let of_row = |row: usize| {
        let first = first_of_row(equations, &factor, row).ok()?;
        Some((distance_of(&distances, row).map_or(1.0, |f| 2.0 * f) * first).as_slice().to_vec())
    };
    let of_rows = rows.iter().copied().map(of_row).collect();
    let of_inputs = inputs.iter().map(|&k| Some(first_of_input(equations, &factor, q, k).ok()?.as_slice().to_vec()));
    Ok([of_rows, of_inputs.collect()])
}

/// ∂o/∂f of every observable, for a driving row or an input with k = ∂q/∂f. The rate of an observable is linear in q̇
/// and u̇, so that it is the difference of its rates with k and at rest.
pub(crate) fn observed_ratio(
    equations: &mut Equations<'_>,
    q: &[f64],
    first: &[f64],
    input: Option<usize>,
) -> Result<Vec<f64>, SolveError> {
    let mut rates = |q_dot: &[f64], moving: Option<usize>| -> Result<Vec<f64>, SolveError> {
        let signal = |(k, u): (usize, &Signal)| Signal::new(u.value, if Some(k) == moving { 1.0 } else { 0.0 }, 0.0);
        let inputs: Vec<Signal> = equations.inputs.iter().enumerate().map(signal).collect();
        equations.system.observe(&Instant { t: equations.t, inputs: &inputs }, q, q_dot)?;
        let (parts, model) = (equations.system.observables(), equations.model);
        let rate = |row: usize| {
            let along = parts.gradient(&model.observable_pattern, row).map(|(k, entry)| entry * q_dot[k]);
            parts.phi_t[row] + along.sum::<f64>()
        };
        Ok((0..model.observables.len()).map(rate).collect())
    };
    let still = rates(&vec![0.0; q.len()], None)?;
    let moved = rates(first, input)?;
    Ok(moved.iter().zip(&still).map(|(moved, still)| moved - still).collect())
}

/// The ratios of input k.
fn input_ratio(
    equations: &mut Equations<'_>,
    factor: &Factorization,
    q: &[f64],
    k: usize,
) -> Result<VelocityRatio, SolveError> {
    let [first, second] = certain_responses(equations, factor, q, &|equations, factor, q| {
        let first = first_of_input(equations, factor, q, k)?;
        let bend = equations.along(Some(k), |equations| gamma(equations, q, first.as_slice()))?;
        Ok([first, respond(equations, factor, &bend)?])
    })?;
    let Signal { rate, acceleration, .. } = equations.inputs[k];
    Ok(VelocityRatio {
        row: None,
        joint: None,
        name: equations.model.inputs.get(k).copied().unwrap_or(""),
        q_dot: (rate * &first).as_slice().to_vec(),
        q_ddot: (acceleration * &first + rate * rate * &second).as_slice().to_vec(),
        first: first.as_slice().to_vec(),
        second: second.as_slice().to_vec(),
    })
}

/// Rows |d|² − f² with their f.
fn distances(equations: &Equations<'_>) -> Result<Vec<(usize, f64)>, SolveError> {
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let numbers = equations.system.geometry(&at)?;
    let value = |joint: &JointInfo| {
        let has = |role| joint.geometry.iter().find(|g| g.role == role);
        let index = has(Role::P).and(has(Role::Q)).and(has(Role::Value))?.offset;
        numbers.get(index).map(|&f| (joint.first_row, f))
    };
    let squared = |joint: &&JointInfo| matches!(joint.kind, JointKind::Distance | JointKind::Driver);
    Ok(equations.model.joints.iter().filter(squared).filter_map(value).collect())
}

/// The distance f of a row |d|² − f²; none for other rows.
fn distance_of(distances: &[(usize, f64)], row: usize) -> Option<f64> {
    distances.iter().find(|(distance_row, _)| *distance_row == row).map(|&(_, f)| f)
}

/// γ at q and q̇.
fn gamma(equations: &mut Equations<'_>, q: &[f64], q_dot: &[f64]) -> Result<DVector<f64>, SolveError> {
    equations.evaluate(Subset::GAMMA, q, Some(q_dot))?;
    Ok(equations.gamma.clone())
}

/// −2 Φ_qt q̇ of a row that mixes q with time or inputs: the part of γ that is odd in q̇; 0 where nothing moves.
fn mixed_part(equations: &mut Equations<'_>, q: &[f64], q_dot: &[f64], row: usize) -> Result<f64, SolveError> {
    let back: Vec<f64> = q_dot.iter().map(|rate| -rate).collect();
    Ok(0.5 * (gamma(equations, q, q_dot)?[row] - gamma(equations, q, &back)?[row]))
}

/// x with Φ_q x = right.
fn respond(
    equations: &Equations<'_>,
    factor: &Factorization,
    right: &DVector<f64>,
) -> Result<DVector<f64>, SolveError> {
    let right = scaled(equations, right);
    let x = factor.solve(&right);
    match inconsistency(equations, &x, &right, 0.0) {
        None => Ok(x),
        Some((row, residual)) => Err(SolveError::InconsistentVelocity {
            t: equations.t,
            residual,
            row_name: equations.row_name(row),
            joint: equations.joint_name(row),
            rank: factor.rank,
        }),
    }
}

/// `drive: k = (…), l = (…)`.
impl fmt::Display for VelocityRatio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: k = ", self.name)?;
        numbers(f, &self.first)?;
        f.write_str(", l = ")?;
        numbers(f, &self.second)
    }
}

/// A line per driving row and per input.
impl fmt::Display for VelocityRatios {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.drivers.iter().chain(&self.inputs).enumerate().try_for_each(|(k, ratio)| {
            f.write_str(if k > 0 { "\n" } else { "" })?;
            ratio.fmt(f)
        })
    }
}
