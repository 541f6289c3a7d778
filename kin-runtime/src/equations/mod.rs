//! The equations of one analysis at a current instant: the rows of the mechanism, then one row per prescribed
//! coordinate.

use crate::course::{InputFunction, InputPath, PathShape};
use crate::equations::scale::Scale;
use crate::equations::system::System;
use crate::error::SolveError;
use crate::linear::Ordered;
use crate::mechanism::LengthError;
use crate::model::{Level, Model};
use crate::observer::Observed;
use crate::options::Options;
use crate::signal::{Instant, Signal};
use kept_length::{KeptLength, lengths_exist};
use nalgebra::DVector;

pub(crate) mod contact;
pub(crate) mod dimensions;
mod entries;
mod evaluation;
pub(crate) mod factorisation;
pub(crate) mod geometry;
mod kept_length;
pub(crate) mod placement;
pub(crate) mod residual;
pub(crate) mod scale;
pub(crate) mod system;
mod turns;

/// A coordinate that the caller prescribes: the row q_k − value.
#[derive(Clone, Copy, Debug)]
struct Given {
    coordinate: usize,
    /// The signal at the instant at which the analysis started.
    start: Signal,
    /// The signal at the current instant.
    now: Signal,
}

/// The rows of the mechanism and of prescribed coordinates, with results in the rows' own units.
pub(crate) struct Equations<'a> {
    pub(crate) system: Box<dyn System + 'a>,
    pub(crate) model: &'static Model,
    pub(crate) options: Options,
    pub(crate) scale: Scale,
    /// True where the motion of bodies and points can be read off q, q̇ and q̈.
    pub(crate) poses_are_coordinates: bool,
    given: Vec<Given>,
    start_time: f64,
    input_function: InputFunction<'a>,
    /// The path of the inputs where they are known only at both ends of a step.
    pub(crate) path: Option<InputPath>,
    /// The observer of a sweep.
    pub(crate) observed: Observed<'a>,
    /// The distances that joints keep. Those that depend on time or inputs are checked at every instant.
    lengths: Vec<KeptLength>,
    /// The current time.
    pub(crate) t: f64,
    /// The inputs at the current time.
    pub(crate) inputs: Vec<Signal>,
    /// Φ.
    pub(crate) phi: DVector<f64>,
    /// The entries of Φ_q, in the order of the pattern, followed by those of prescribed coordinates.
    pub(crate) phi_q: Vec<f64>,
    /// The pattern of these entries, sorted by rows, with the order of elimination.
    pub(crate) ordered: Ordered,
    /// Φ_t.
    pub(crate) phi_t: DVector<f64>,
    /// γ.
    pub(crate) gamma: DVector<f64>,
    /// A buffer for local points, axes and values.
    pub(crate) geometry: Vec<f64>,
    /// Zeros, used as the rates at rest.
    pub(crate) still: Vec<f64>,
    /// Buffers for the contribution of time itself, see `without_time`.
    reversed: Vec<f64>,
    moving: Vec<Signal>,
}

impl<'a> Equations<'a> {
    /// The inputs as functions of time, where the caller has supplied them.
    pub(crate) const fn input_function(&self) -> InputFunction<'a> {
        self.input_function
    }

    /// The number of coordinates n.
    pub(crate) fn coordinates(&self) -> usize {
        self.still.len()
    }

    /// The number of rows, including prescribed coordinates.
    pub(crate) fn rows(&self) -> usize {
        self.phi.len()
    }

    /// The number of prescribed coordinates, whose rows are the last.
    pub(crate) fn given(&self) -> usize {
        self.given.len()
    }

    /// Index in q of the k-th prescribed coordinate.
    pub(crate) fn given_coordinate(&self, k: usize) -> Option<usize> {
        self.given.get(k).map(|given| given.coordinate)
    }

    /// Name and value of the k-th prescribed coordinate.
    pub(crate) fn given_value(&self, k: usize) -> (&'static str, f64) {
        self.given.get(k).map_or(("", f64::NAN), |g| (self.model.coordinates[g.coordinate].name, g.now.value))
    }

    /// The name of a row.
    pub(crate) fn row_name(&self, row: usize) -> &'static str {
        match self.model.rows.get(row) {
            Some(info) => info.name,
            None => self.given_value(row - self.model.rows.len()).0,
        }
    }

    /// The name of the joint of a row; `given` for a prescribed coordinate.
    pub(crate) fn joint_name(&self, row: usize) -> &'static str {
        self.model.rows.get(row).map_or("given", |info| self.model.joints.get(info.joint).map_or("", |j| j.name))
    }

    /// True for driving rows, which include prescribed coordinates.
    pub(crate) fn drives(&self, row: usize) -> bool {
        self.model.rows.get(row).is_none_or(|info| info.driving)
    }

    /// True for rows of position level.
    pub(crate) fn holonomic(&self, row: usize) -> bool {
        self.model.rows.get(row).is_none_or(|info| info.level == Level::Position)
    }

    /// The rows for which the condition is true.
    pub(crate) fn rows_where(&self, condition: impl Fn(&Self, usize) -> bool) -> Vec<usize> {
        (0..self.rows()).filter(|&row| condition(self, row)).collect()
    }

    /// Checks the time, the inputs and the kept distances of an instant.
    pub(crate) fn check_instant(&mut self, at: &Instant<'_>) -> Result<(), SolveError> {
        finite("t", 0, "t", at.t)?;
        length("inputs", self.model.inputs.len(), at.inputs.len())?;
        self.check_inputs(at.inputs)?;
        self.check_lengths(at, |length| length.moves)
    }

    /// An error where one of the selected kept distances is negative at this instant.
    fn check_lengths(&mut self, at: &Instant<'_>, which: impl Fn(&KeptLength) -> bool) -> Result<(), SolveError> {
        let mut lengths = self.lengths.iter().filter(|length| which(length)).peekable();
        if lengths.peek().is_none() {
            return Ok(());
        }
        self.system.write_geometry(at, &mut self.geometry)?;
        lengths_exist(&self.geometry, lengths, at.t)
    }

    fn check_inputs(&self, inputs: &[Signal]) -> Result<(), SolveError> {
        let mut numbered = inputs.iter().enumerate();
        numbered.try_for_each(|(index, &signal)| finite_signal("inputs", index, self.model.inputs[index], signal))
    }

    /// Moves to another instant; prescribed coordinates continue with constant acceleration.
    pub(crate) fn set_instant(&mut self, at: &Instant<'_>) -> Result<(), SolveError> {
        self.check_instant(at)?;
        self.set_checked_instant(at);
        Ok(())
    }

    /// True if joints keep distances.
    pub(crate) fn keeps_lengths(&self) -> bool {
        !self.lengths.is_empty()
    }

    /// As [`set_instant`](Self::set_instant), for an instant that was checked.
    pub(crate) fn set_checked_instant(&mut self, at: &Instant<'_>) {
        self.set_time(at.t);
        self.inputs.clear();
        self.inputs.extend_from_slice(at.inputs);
    }

    /// Restarts the prescribed coordinates at time `t`; returns the time of their previous start.
    pub(crate) fn begin_at(&mut self, t: f64) -> f64 {
        core::mem::replace(&mut self.start_time, t)
    }

    fn set_time(&mut self, t: f64) {
        self.t = t;
        let elapsed = t - self.start_time;
        for given in &mut self.given {
            given.now = given.start.after(elapsed);
        }
    }

    /// The time at a place of the course; without a course, places are times.
    pub(crate) fn time_at(&self, s: f64) -> f64 {
        self.path.as_ref().map_or(s, |path| path.time(s))
    }

    /// Moves to a place of the course: inputs follow the course or their functions of time, and prescribed coordinates
    /// continue with constant acceleration.
    pub(crate) fn move_to(&mut self, s: f64) -> Result<(), SolveError> {
        self.move_from(s, 0.0)
    }

    /// As [`move_to`](Self::move_to), to the place `since` after another one. If `from` is large, their sum is rounded; the
    /// path of inputs does not depend on that.
    pub(crate) fn move_from(&mut self, from: f64, since: f64) -> Result<(), SolveError> {
        let s = from + since;
        finite("t", 0, "t", s)?;
        self.set_time(self.time_at(s));
        match (&self.path, self.input_function) {
            (Some(path), _) => path.write(from, since, &mut self.inputs),
            (None, Some(function)) => function(s, &mut self.inputs),
            (None, None) => {}
        }
        self.check_inputs(&self.inputs).map_err(|error| error.at(self.t))?;
        let inputs = core::mem::take(&mut self.inputs);
        let checked = self.check_lengths(&Instant { t: self.t, inputs: &inputs }, |length| length.moves);
        self.inputs = inputs;
        checked
    }

    /// Calls `evaluate` so that derivatives are taken with respect to time, whatever the course is.
    pub(crate) fn by_time<R>(&mut self, evaluate: impl FnOnce(&mut Self) -> R) -> R {
        let path = self.path.take();
        let result = evaluate(self);
        self.path = path;
        result
    }

    /// Calls `evaluate` so that derivatives are taken with respect to the inputs only, with time frozen: Φ_t is Φ_u u′,
    /// γ is −(Φ_q q′)_q q′ − 2 Φ_qu u′ q′ − (Φ_u u′)_u u′.
    pub(crate) fn by_inputs<R>(&mut self, evaluate: impl FnOnce(&mut Self) -> R) -> R {
        let path = self.path.replace(InputPath::frozen());
        let result = evaluate(self);
        self.path = path;
        result
    }

    /// Evaluates with constant time and constant inputs, except for the given input, whose rate is 1.
    pub(crate) fn along<R>(
        &mut self,
        input: Option<usize>,
        evaluate: impl FnOnce(&mut Self) -> Result<R, SolveError>,
    ) -> Result<R, SolveError> {
        let inputs = self.inputs.clone();
        for (k, u) in self.inputs.iter_mut().enumerate() {
            *u = Signal::new(u.value, if Some(k) == input { 1.0 } else { 0.0 }, 0.0);
        }
        let result = self.by_inputs(evaluate);
        self.inputs = inputs;
        result
    }

    /// The current instant.
    pub(crate) fn instant(&self) -> Instant<'_> {
        Instant { t: self.t, inputs: &self.inputs }
    }

    /// True where time is frozen, so that derivatives are taken along the course of the inputs.
    pub(crate) fn is_frozen(&self) -> bool {
        self.path.as_ref().is_some_and(|path| path.kind == PathShape::Frozen)
    }

    /// Writes the branch value of every group of the plan at q and the current instant, whose sign distinguishes its
    /// closures; an empty list if there is no plan, or if coordinates are prescribed.
    pub(crate) fn write_branch_values(&self, q: &[f64], groups: &mut Vec<f64>) {
        groups.clear();
        if self.given() > 0 {
            return;
        }
        groups.resize(self.model.plan.signs(), 0.0);
        if self.system.branches(&self.instant(), q, groups).is_err() {
            groups.fill(f64::NAN);
        }
    }

    /// Checks that q or q̇ has the right length and is finite.
    pub(crate) fn check(&self, what: &'static str, q: &[f64]) -> Result<(), SolveError> {
        length(what, self.coordinates(), q.len())?;
        for (index, &value) in q.iter().enumerate() {
            finite(what, index, self.model.coordinates[index].name, value)?;
        }
        Ok(())
    }
}

/// An error unless `value` is finite.
pub(crate) fn finite(what: &'static str, index: usize, name: &'static str, value: f64) -> Result<(), SolveError> {
    if value.is_finite() { Ok(()) } else { Err(SolveError::NonFinite { what, index, name, t: None }) }
}

/// An error unless value, rate and acceleration are finite.
fn finite_signal(what: &'static str, index: usize, name: &'static str, signal: Signal) -> Result<(), SolveError> {
    [signal.value, signal.rate, signal.acceleration].into_iter().try_for_each(|v| finite(what, index, name, v))
}

/// An error unless both lengths are equal.
pub(crate) fn length(what: &'static str, expected: usize, found: usize) -> Result<(), SolveError> {
    if expected == found { Ok(()) } else { Err(SolveError::Length(LengthError { what, expected, found })) }
}
