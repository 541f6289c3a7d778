//! The motion of bodies and points, which every state contains.

use crate::equations::system::Parts;
use crate::equations::{Equations, finite};
use crate::error::SolveError;
use crate::model::Model;
use crate::motion::{BodyMotion, PointMotion, name};
use crate::signal::Signal;
use crate::state::State;
use crate::workspace::Instant;

/// Writes the motion of bodies whose poses are coordinates: those of the bodies come first in q, three of each.
pub(crate) fn write_coordinates(state: &mut State) {
    let State { model, q, q_dot, q_ddot, bodies, points, .. } = state;
    points.clear();
    bodies.clear();
    let [q, q_dot, q_ddot] = [q, q_dot, q_ddot].map(|numbers| numbers.as_chunks().0.iter());
    let poses = q.zip(q_dot).zip(q_ddot).take(model.bodies.len());
    bodies.extend(poses.map(|((&[x, y, phi], &[x_dot, y_dot, phi_dot]), &[x_ddot, y_ddot, phi_ddot])| BodyMotion {
        x,
        y,
        phi,
        x_dot,
        y_dot,
        phi_dot,
        x_ddot,
        y_ddot,
        phi_ddot,
    }));
}

/// Writes the motion of bodies and points, for the q, q̇ and q̈ of the state.
pub(crate) fn poses(equations: &mut Equations<'_>, state: &mut State) -> Result<(), SolveError> {
    if equations.poses_are_coordinates {
        write_coordinates(state);
        return Ok(());
    }
    let at = Instant { t: state.t, inputs: &state.inputs };
    equations.system.observe(&at, &state.q, &state.q_dot)?;
    write_poses(&equations.system.observables(), state)
}

/// Writes the motion of bodies and points by the observables, which were evaluated at the q and q̇ of the state.
pub(crate) fn write_poses(parts: &Parts<'_>, state: &mut State) -> Result<(), SolveError> {
    let model = state.model;
    let mut fault = None;
    write(model, state, |state, observable, coordinate| {
        let rates = coordinate.map_or_else(
            || parts.rates(&model.observable_pattern, observable, &state.q_dot, &state.q_ddot),
            |k| state.rates(k),
        );
        for value in [rates.value, rates.rate, rates.acceleration] {
            let error = finite("observables", observable, name(model, observable), value);
            fault = fault.take().or(error.map_err(|error| error.at(state.t)).err());
        }
        rates
    });
    fault.map_or(Ok(()), Err)
}

/// Writes bodies and points; `rates` gives the signal of an observable, or of the coordinate that it is.
fn write(model: &Model, state: &mut State, mut rates: impl FnMut(&State, usize, Option<usize>) -> Signal) {
    // The vectors are reused, so that a tracker allocates nothing here.
    let (mut bodies, mut points) = (core::mem::take(&mut state.bodies), core::mem::take(&mut state.points));
    bodies.clear();
    bodies.extend(model.bodies.iter().map(|body| {
        let [x, y, phi] = [0, 1, 2].map(|k| rates(state, body.observables[k], body.coordinates[k]));
        BodyMotion::from([x, y, phi])
    }));
    points.clear();
    points.extend(model.points.iter().map(|point| PointMotion::from(point.observables.map(|k| rates(state, k, None)))));
    state.bodies = bodies;
    state.points = points;
}
