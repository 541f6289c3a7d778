//! Cranks that are driven at constant speed, and how long their turns take.

use super::engine::Engine;
use super::setup::Setup;
use super::solved::driven_state;
use std::f64::consts::TAU;

/// The default end of a motion that begins at `from`: after one turn of the slowest crank that is driven at constant
/// speed, or after one unit of time.
pub(super) fn natural_end(engine: &dyn Engine, setup: &Setup, from: f64) -> f64 {
    from + turn(engine, setup, from).unwrap_or(1.0)
}

/// How long a turn of this driver takes, if it drives an angle at constant speed.
#[cfg(feature = "design")]
pub(super) fn turn_of(engine: &dyn Engine, setup: &Setup, driver: &str) -> Option<f64> {
    slowest(engine, setup, 0.0, &|name| name == driver).map(|speed| TAU / speed)
}

/// How long the slowest of the cranks that are driven at constant speed takes for a turn.
pub(super) fn turn(engine: &dyn Engine, setup: &Setup, from: f64) -> Option<f64> {
    speed(engine, setup, from).map(|speed| TAU / speed)
}

/// The speed of the slowest of the cranks that are driven at constant speed.
pub(super) fn speed(engine: &dyn Engine, setup: &Setup, from: f64) -> Option<f64> {
    slowest(engine, setup, from, &|_| true)
}

/// The speed of the slowest of the cranks that these drivers drive at constant speed.
fn slowest(engine: &dyn Engine, setup: &Setup, from: f64, counts: &dyn Fn(&str) -> bool) -> Option<f64> {
    let model = engine.model();
    let (state, _) = driven_state(engine, setup, from, true).ok()?;
    let angle = |column: usize| model.coordinates.get(column).is_some_and(|coordinate| !coordinate.kind.is_length());
    let driven =
        model.rows.iter().enumerate().filter(|(_, row)| row.driving || row.rheonomic).filter_map(|(index, row)| {
            model.joints.get(row.joint).filter(|joint| counts(joint.name))?;
            let mut entries = model.constraint_pattern.entries.iter().filter(|(row, _)| *row == index);
            match (entries.next(), entries.next()) {
                (Some(&(_, column)), None) if angle(column) => Some(column),
                _ => None,
            }
        });
    let speeds = driven.filter_map(|column| {
        let (speed, acceleration) = (state.q_dot.get(column)?.abs(), state.q_ddot.get(column)?.abs());
        (speed > 0.0 && acceleration <= 1e-9 * speed * speed).then_some(speed)
    });
    let slowest = speeds.fold(f64::INFINITY, f64::min);
    slowest.is_finite().then_some(slowest)
}
