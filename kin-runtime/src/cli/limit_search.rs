//! The search for the limit at which a motion ends.

use super::engine::Engine;
use super::failure::Failure;
use super::setup::Setup;
use super::solved::misfit;
use super::turns::{angle_unit, turn};
use crate::error::{Refusal, SolveError};
use crate::model::CoordinateInfo;
use crate::planned::Limit;
use crate::present::number::rounded;
use crate::state::State;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

/// A limit is searched within so many turns of a crank, one after the other, unless the mechanism is back after the first.
const SEARCH_TURNS: [f64; 3] = [1.0, 10.0, 100.0];

/// If no crank turns at constant speed, a limit is searched within these durations, one after the other.
const SEARCH_DURATIONS: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

/// A limit at which a motion ends.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    /// Its time.
    pub(super) t: f64,
    /// The configuration there, if it was found.
    pub(super) q: Option<Vec<f64>>,
    /// `dead centre of A, B, D`, for a legend.
    #[cfg_attr(not(feature = "plot"), allow(dead_code, reason = "legends are those of diagrams"))]
    pub(super) name: String,
    /// The full description.
    pub(super) text: String,
}

/// The result of a search for a limit.
pub(super) enum Sought {
    Found(Stop),
    /// There is none up to this time.
    None(f64),
}

/// The limit that a motion from `start` reaches in a direction of time, or how far it was followed without reaching
/// one.
pub(super) fn limit(engine: &dyn Engine, setup: &Setup, start: f64, direction: f64) -> Result<Sought, Failure> {
    let turn = turn(engine, setup, start);
    let speed = turn.map(|turn| TAU / turn);
    let ranges = turn.map_or(SEARCH_DURATIONS.to_vec(), |turn| SEARCH_TURNS.map(|turns| turns * turn).to_vec());
    let mut followed = None;
    for far in &ranges {
        let times = [start, start + direction * far];
        let go_on = |_: crate::observer::Reached<'_>| ControlFlow::Continue(());
        let (mut first, mut is_back) = (None, false);
        let mut visit = |state: &State| {
            is_back = first.as_ref().zip(speed).is_some_and(|(first, speed)| is_same_motion(first, state, speed));
            first.get_or_insert_with(|| state.clone());
            ControlFlow::Continue(())
        };
        let (trajectory, error) = engine.sweep_each(setup, &times, false, &go_on, &mut visit);
        match error {
            None => {
                followed = Some(start + direction * far);
                // What comes next is what has been.
                if is_back {
                    break;
                }
            }
            // Numbers that grow too large farther away, as exp(−t) does towards the past, are no limit.
            Some(SolveError::NonFinite { .. }) if followed.is_some() => break,
            Some(error @ (SolveError::StepRefused { t, .. } | SolveError::Singular { t, .. }))
                if is_limit(&error) && trajectory.reached > 0 =>
            {
                let found = error.limit();
                let (q, t) = (trajectory.q_at_limit, found.and_then(Limit::at).unwrap_or(t));
                let name = found.map_or_else(|| "limit".to_owned(), short);
                let text = found.map_or_else(|| error.to_string(), ToString::to_string);
                return Ok(Sought::Found(Stop { t, q, name, text }));
            }
            Some(SolveError::StepRefused { t, reason: reason @ Refusal::TooManySteps, .. }) => {
                let (t, option) = (rounded(t), if direction < 0.0 { "--from" } else { "--to" });
                return Err(Failure::Analysis(format!(
                    "{}: no limit is met up to t = {t}, where the search for one ends: {reason}\n  \
                     write a time in place of the limit: {option} {t}",
                    engine.model().name
                )));
            }
            Some(error) => return Err(misfit(engine, setup, start, &error)),
        }
    }
    Ok(Sought::None(followed.unwrap_or(start)))
}

/// Whether the mechanism can go no further where a motion ends with this error. A motion that needs too many internal
/// steps goes on.
pub(super) const fn is_limit(error: &SolveError) -> bool {
    match error {
        SolveError::StepRefused { reason, .. } => !matches!(reason, Refusal::TooManySteps),
        SolveError::Singular { .. } => true,
        _ => false,
    }
}

/// `dead centre of A, B, D`.
fn short(limit: &Limit) -> String {
    let joints: Vec<&str> = limit.joints().collect();
    let kind = limit.kind().map_or_else(|| "limit".to_owned(), |kind| kind.to_string());
    if joints.is_empty() { kind } else { format!("{kind} of {}", joints.join(", ")) }
}

/// How far numbers of the same configuration and of the same rates may be apart, relative to the largest of them.
const SAME_MOTION: f64 = 1e-6;

/// Whether the configuration and the rates are the same, up to whole turns, with a crank of this angular speed. A feed so
/// small that a hundred turns change the mechanism by less than 1e-4 of its size counts as none.
fn is_same_motion(first: &State, later: &State, speed: f64) -> bool {
    let (model, coordinates) = (first.model, first.model.coordinates);
    let lengths = || first.q.iter().zip(coordinates).filter(|(_, c)| c.kind.is_length()).map(|(x, _)| x);
    let size = largest(lengths());
    let is_same_place = |(k, coordinate): (usize, &CoordinateInfo)| {
        let (a, b, rate) = (first.q[k], later.q[k], first.q_dot[k]);
        match angle_unit(model, coordinate) {
            _ if coordinate.kind.is_length() => (a - b).abs() <= SAME_MOTION * size,
            // Also scalars without a unit, as most of them are angles.
            Some(unit) => {
                let angle = unit * (b - a);
                (angle - TAU * (angle / TAU).round()).abs() <= SAME_MOTION
            }
            None => (a - b).abs() <= SAME_MOTION * largest(&[a, b, rate / speed]),
        }
    };
    let are_same = |size: f64, first: &[f64], later: &[f64]| {
        first.iter().zip(later).all(|(a, b)| (a - b).abs() <= SAME_MOTION * size)
    };
    let fastest = largest(&first.q_dot);
    coordinates.iter().enumerate().all(is_same_place)
        && are_same(fastest, &first.q_dot, &later.q_dot)
        // Where nothing accelerates, accelerations are rounding errors.
        && are_same(largest(&first.q_ddot).max(speed * fastest), &first.q_ddot, &later.q_ddot)
}

/// The largest magnitude.
fn largest<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> f64 {
    numbers.into_iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))
}
