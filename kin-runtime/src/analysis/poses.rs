//! The motion of bodies and points, which every state contains.

use crate::equations::system::Parts;
use crate::equations::{Equations, finite};
use crate::error::SolveError;
use crate::model::Model;
use crate::motion::{BodyMotion, PointMotion, name};
use crate::signal::{Instant, Signal};
use crate::state::State;

/// The motion of bodies whose poses are coordinates, from q, q̇ and q̈: these coordinates come first in q, three of each
/// body.
#[inline]
pub(crate) fn coordinate_motions(model: &Model, solution: [&[f64]; 3]) -> impl Iterator<Item = BodyMotion> {
    let [q, q_dot, q_ddot] = solution.map(|numbers| numbers.as_chunks().0.iter());
    let poses = q.zip(q_dot).zip(q_ddot).take(model.bodies.len());
    poses.map(|((&[x, y, phi], &[x_dot, y_dot, phi_dot]), &[x_ddot, y_ddot, phi_ddot])| BodyMotion {
        x,
        y,
        phi,
        x_dot,
        y_dot,
        phi_dot,
        x_ddot,
        y_ddot,
        phi_ddot,
    })
}

/// Writes the motion of bodies and points, for the q, q̇ and q̈ of the state.
pub(crate) fn poses(equations: &mut Equations<'_>, state: &mut State) -> Result<(), SolveError> {
    if equations.poses_are_coordinates {
        let State { model, q, q_dot, q_ddot, bodies, points, .. } = state;
        points.clear();
        bodies.clear();
        bodies.extend(coordinate_motions(model, [q, q_dot, q_ddot]));
        return Ok(());
    }
    let at = Instant { t: state.t, inputs: &state.inputs };
    equations.system.observe(&at, &state.q, &state.q_dot)?;
    write_poses(&equations.system.observables(), state)
}

/// Writes the motion of bodies and points by the observables, which were evaluated at the q and q̇ of the state.
pub(crate) fn write_poses(parts: &Parts<'_>, state: &mut State) -> Result<(), SolveError> {
    let model = state.model;
    // The sum of all numbers is finite if they are, unless it overflows; then each is looked at.
    let mut sum = 0.0;
    // The vectors are reused, so that a tracker allocates nothing here.
    let (mut bodies, mut points) = (core::mem::take(&mut state.bodies), core::mem::take(&mut state.points));
    let mut read = |observable: usize, coordinate: Option<usize>| {
        let read = signal(parts, state, observable, coordinate);
        sum += read.value + read.rate + read.acceleration;
        read
    };
    bodies.clear();
    bodies.extend(model.bodies.iter().map(|body| {
        let [x, y, phi] = body.observables;
        let [of_x, of_y, of_phi] = body.coordinates;
        BodyMotion::from([read(x, of_x), read(y, of_y), read(phi, of_phi)])
    }));
    points.clear();
    points.extend(model.points.iter().map(|point| {
        let [x, y] = point.observables;
        PointMotion::from([read(x, None), read(y, None)])
    }));
    (state.bodies, state.points) = (bodies, points);
    if sum.is_finite() { Ok(()) } else { first_fault(parts, state) }
}

/// The signal of an observable, or of the coordinate that it is.
#[inline(always)]
fn signal(parts: &Parts<'_>, state: &State, observable: usize, coordinate: Option<usize>) -> Signal {
    match coordinate {
        Some(k) => state.rates(k),
        None => parts.rates(&state.model.observable_pattern, observable, &state.q_dot, &state.q_ddot),
    }
}

/// The error for the first number of bodies and points that is not finite.
#[cold]
fn first_fault(parts: &Parts<'_>, state: &State) -> Result<(), SolveError> {
    let model = state.model;
    let of_bodies = model.bodies.iter().flat_map(|body| body.observables.into_iter().zip(body.coordinates));
    let of_points = model.points.iter().flat_map(|point| point.observables.map(|k| (k, None)));
    let mut all = of_bodies.chain(of_points);
    let found: Result<(), SolveError> = all.try_for_each(|(observable, coordinate)| {
        let Signal { value, rate, acceleration } = signal(parts, state, observable, coordinate);
        let mut numbers = [value, rate, acceleration].into_iter();
        numbers.try_for_each(|number| finite("observables", observable, name(model, observable), number))
    });
    found.map_err(|error| error.at(state.t))
}
