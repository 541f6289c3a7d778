//! Cranks that are driven at constant speed, and how long their turns take.

use super::engine::Engine;
use super::setup::Setup;
use super::solved::driven_state;
use crate::measure::Dimension;
use crate::model::{CoordinateInfo, Model};
use crate::present::units::ResultUnits;
use crate::signal::Instant;
use kin_core::units::parse;
use std::f64::consts::TAU;

/// The relative changes of a speed, also those within a turn, that count as none.
const STEADY_CHANGE: f64 = 1e-9;

/// Where else the speed of a crank is compared, in turns after the first instant.
const SHARES: [f64; 3] = [0.137, 0.618, 2.71];

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

/// The speed of the slowest of the cranks that are driven at constant speed, in radians per unit of time.
pub(super) fn speed(engine: &dyn Engine, setup: &Setup, from: f64) -> Option<f64> {
    slowest(engine, setup, from, &|_| true)
}

/// The speed of the slowest of the cranks that these drivers drive at constant speed, in radians per unit of time.
fn slowest(engine: &dyn Engine, setup: &Setup, from: f64, counts: &dyn Fn(&str) -> bool) -> Option<f64> {
    let (model, setup) = (engine.model(), &*setup.beginning_at(from));
    // The mechanism may close at other times only. Rows with a constant factor determine the rates of their cranks alone.
    let rates = match driven_state(engine, setup, from, true) {
        Ok((state, _)) => Ok([state.q_dot, state.q_ddot]),
        Err(_) => Err(engine.time_derivatives(&Instant { t: from, inputs: &setup.inputs }).ok()?),
    };
    // One instant may be one at which a speed is largest, as that of sin t at t = 0.
    let phi_t =
        |row: usize, t: f64| Some(*engine.time_derivatives(&Instant { t, inputs: &setup.inputs }).ok()?[0].get(row)?);
    let is_as_fast = |row: usize, t: f64| match (phi_t(row, from), phi_t(row, t)) {
        (Some(before), Some(then)) => (then - before).abs() <= STEADY_CHANGE * before.abs(),
        _ => false,
    };
    let pattern = &model.constraint_pattern;
    let speed = |row: usize| {
        model.joints.get(model.rows[row].joint).filter(|joint| counts(joint.name))?;
        let mut entries = pattern.entries.iter().enumerate().filter(|(_, (entry_row, _))| *entry_row == row);
        let (Some((entry, &(_, column))), None) = (entries.next(), entries.next()) else { return None };
        let unit = angle_unit(model, model.coordinates.get(column)?)?;
        let [speed, acceleration] = match &rates {
            Ok([q_dot, q_ddot]) => [*q_dot.get(column)?, *q_ddot.get(column)?],
            Err([phi_t, gamma]) => {
                let (_, factor) = pattern.constants.iter().find(|(index, _)| *index == entry)?;
                [-phi_t.get(row)? / factor, gamma.get(row)? / factor]
            }
        };
        let (speed, acceleration) = (unit * speed.abs(), unit * acceleration.abs());
        let is_steady = speed > 0.0 && acceleration <= STEADY_CHANGE * speed * speed;
        (is_steady && SHARES.iter().all(|share| is_as_fast(row, from + share * TAU / speed))).then_some(speed)
    };
    let driving = model.rows.iter().enumerate().filter(|(_, row)| row.driving || row.rheonomic);
    let slowest = driving.filter_map(|(row, _)| speed(row)).fold(f64::INFINITY, f64::min);
    slowest.is_finite().then_some(slowest)
}

/// The unit of a coordinate in radians: that of an angle, and of a scalar coordinate whose unit is one of angles or not
/// known; `None` for other coordinates, which do not turn.
pub(super) fn angle_unit(model: &Model, coordinate: &CoordinateInfo) -> Option<f64> {
    match ResultUnits::of(model).dimension(coordinate.name) {
        Dimension::Length => None,
        Dimension::In(unit) => parse(unit).ok().filter(|unit| unit.is_number())?.scale,
        Dimension::Angle | Dimension::Unknown => Some(1.0),
    }
}
