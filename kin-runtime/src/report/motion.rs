//! The motion of bodies, points, defines and joints at a state, and the Jacobian of a point.
//!
//! An observable o(q, t) has ȯ = o_q q̇ + o_t and ö = o_q q̈ − γ_o, where γ_o = −(o_q q̇)_q q̇ − 2 o_qt q̇ − o_tt, with
//! the same signs as for constraints.

use crate::equations::{Equations, finite};
use crate::error::SolveError;
use crate::mechanism::LengthError;
use crate::model::Point;
use crate::motion::{BodyMotion, ConditionMotion, Motion, PointMotion, name};
use crate::signal::{Instant, Signal};
use crate::state::State;
use nalgebra::DMatrix;

/// The motion of bodies, points, defines, joints and conditions at a state.
pub(crate) fn motion(equations: &mut Equations<'_>, state: &State) -> Result<Motion, SolveError> {
    equations.check("q", &state.q)?;
    equations.check("q_dot", &state.q_dot)?;
    equations.check("q_ddot", &state.q_ddot)?;
    let model = equations.model;
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    equations.system.observe(&at, &state.q, &state.q_dot)?;
    let parts = equations.system.observables();
    let pattern = &model.observable_pattern;
    let rates: Vec<Signal> =
        (0..model.observables.len()).map(|k| parts.rates(pattern, k, &state.q_dot, &state.q_ddot)).collect();
    for (index, rate) in rates.iter().enumerate() {
        let numbers = [rate.value, rate.rate, rate.acceleration];
        if let Some(&number) = numbers.iter().find(|number| !number.is_finite()) {
            finite("observables", index, name(model, index), number).map_err(|error| error.at(state.t))?;
        }
    }
    let at = |k: usize| rates.get(k).copied().unwrap_or_default();
    let bodies = model.bodies.iter().map(|body| BodyMotion::from(body.observables.map(at)));
    let points = model.points.iter().map(|point| PointMotion::from(point.observables.map(at)));
    let joints = model.joints.iter().map(|joint| joint.quantities.iter().map(|q| at(q.observable)).collect());
    let conditions = model.conditions.iter().map(|condition| {
        let Signal { value, rate, acceleration } = at(condition.observable);
        ConditionMotion { value, rate, acceleration, satisfied: value > 0.0 }
    });
    Ok(Motion {
        model,
        bodies: bodies.collect(),
        points: points.collect(),
        defines: model.defines.iter().map(|define| at(define.observable)).collect(),
        joints: joints.collect(),
        conditions: conditions.collect(),
        forces: None,
    })
}

/// ∂r_P/∂q of a named point, 2×n.
pub(crate) fn point_jacobian(
    equations: &mut Equations<'_>,
    q: &[f64],
    point: Point,
) -> Result<DMatrix<f64>, SolveError> {
    equations.check("q", q)?;
    let model = equations.model;
    let Some(info) = model.points.get(point.0) else {
        return Err(SolveError::Length(LengthError {
            what: "points",
            expected: point.0 + 1,
            found: model.points.len(),
        }));
    };
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    equations.system.observe(&at, q, &vec![0.0; q.len()])?;
    let parts = equations.system.observables();
    let mut jacobian = DMatrix::zeros(2, q.len());
    for (component, &row) in info.observables.iter().enumerate() {
        for (column, entry) in parts.gradient(&model.observable_pattern, row) {
            finite("observables", row, info.name, entry).map_err(|error| error.at(at.t))?;
            jacobian[(component, column)] = entry;
        }
    }
    Ok(jacobian)
}
