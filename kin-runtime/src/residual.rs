//! What is left of the equations at a solution: Φ, Φ_q q̇ + Φ_t and Φ_q q̈ − γ, row by row, against what counts as closed.
//!
//! Every row is judged by its own entries, so that no unit matters and nothing has to be known of other configurations:
//!
//! ```text
//! Rᵢ = Σⱼ |∂Φᵢ/∂qⱼ| cⱼ        cⱼ = 1 for angles and scalars, L for lengths
//! |Φᵢ| ≤ ε Rᵢ        |Φ_q q̇ + Φ_t|ᵢ ≤ δ Rᵢ maxⱼ |q̇ⱼ|/cⱼ        |Φ_q q̈ − γ|ᵢ ≤ δ Rᵢ maxⱼ |q̈ⱼ|/cⱼ
//! ```
//!
//! with L the largest arm that angles have in a row of lengths, and the right-hand sides in the place of the rates where
//! they are larger.

use crate::model::{Component, CoordinateKind, Level, Model};
use crate::newton::rounding;
use crate::system::Parts;

/// True for x and y of a body.
fn is_length(model: &Model, k: usize) -> bool {
    matches!(model.coordinates[k].kind, CoordinateKind::Pose { component: Component::X | Component::Y, .. })
}

/// What counts as closed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerances {
    /// ε.
    pub(crate) position: f64,
    /// δ.
    pub(crate) rates: f64,
}

/// Writes Rᵢ; gives L. `room` is for as many numbers as there are rows.
fn sizes(model: &Model, phi_q: &[f64], sizes: &mut [f64], room: &mut [f64]) -> f64 {
    let entries = model.constraint_pattern.entries;
    sizes.fill(0.0);
    room.fill(0.0);
    for (&(i, j), a) in entries.iter().zip(phi_q) {
        let of_kind = if is_length(model, j) { &mut *sizes } else { &mut *room };
        of_kind[i] += a.abs();
    }
    let arms = sizes.iter().zip(room.iter());
    let arm = arms.map(|(length, angle)| if *length > 0.0 { angle / length } else { 0.0 }).fold(0.0, f64::max);
    let unit = if arm > 0.0 && arm.is_finite() { arm } else { 1.0 };
    sizes.iter_mut().zip(room.iter()).for_each(|(size, angles)| *size = *size * unit + angles);
    unit
}

/// max |xⱼ|/cⱼ.
fn largest(model: &Model, x: &[f64], inverse: f64) -> f64 {
    let scaled = x.iter().enumerate().map(|(k, x)| if is_length(model, k) { inverse * x.abs() } else { x.abs() });
    scaled.fold(0.0, f64::max)
}

/// Largest |Φᵢ| where all rows of position level are closed; none where one is not. `rooms` are for a number of every row.
pub(crate) fn closed_position(
    model: &Model,
    parts: &Parts<'_>,
    q: &[f64],
    position: f64,
    rooms: [&mut [f64]; 2],
) -> Option<f64> {
    position_and_unit(model, parts, q, position, rooms).map(|(residual, _)| residual)
}

/// [`closed_position`], and L.
fn position_and_unit(
    model: &Model,
    parts: &Parts<'_>,
    q: &[f64],
    position: f64,
    [size, room]: [&mut [f64]; 2],
) -> Option<(f64, f64)> {
    let unit = sizes(model, parts.phi_q, size, room);
    let allowed = position.max(rounding(largest(model, q, 1.0 / unit)));
    let mut residual = 0.0;
    for ((row, phi), size) in model.rows.iter().zip(parts.phi).zip(&*size) {
        if row.level == Level::Position {
            if !(phi.abs() <= allowed * *size) {
                return None;
            }
            residual = f64::max(residual, phi.abs());
        }
    }
    Some((residual, unit))
}

/// The same where q̇ and q̈ must satisfy their equations, too.
pub(crate) fn closed(
    model: &Model,
    parts: &Parts<'_>,
    [q, q_dot, q_ddot]: [&[f64]; 3],
    tolerances: Tolerances,
    [size, velocity, acceleration]: [&mut [f64]; 3],
) -> Option<f64> {
    let (residual, unit) = position_and_unit(model, parts, q, tolerances.position, [&mut *size, &mut *velocity])?;
    let [fast, faster] = [q_dot, q_ddot].map(|rates| largest(model, rates, 1.0 / unit));
    velocity.copy_from_slice(parts.phi_t);
    acceleration.iter_mut().zip(parts.gamma).for_each(|(rest, gamma)| *rest = -gamma);
    for (&(i, j), a) in model.constraint_pattern.entries.iter().zip(parts.phi_q) {
        velocity[i] += a * q_dot[j];
        acceleration[i] += a * q_ddot[j];
    }
    let delta = tolerances.rates;
    let rows = size.iter().zip(parts.phi_t).zip(parts.gamma).zip(velocity.iter().zip(acceleration.iter()));
    let all = rows.fold(true, |all, (((size, phi_t), gamma), (v, a))| {
        let v_closed = v.abs() <= delta * f64::max(size * fast, phi_t.abs());
        let a_closed = a.abs() <= delta * f64::max(size * faster, gamma.abs());
        all & v_closed & a_closed
    });
    all.then_some(residual)
}
