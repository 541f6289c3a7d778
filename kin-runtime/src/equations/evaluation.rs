//! Construction and evaluation of the equations. Geometry that is degenerate at the parameters or at q gives an error
//! that names the joint.

use super::kept_length::kept_lengths;
use super::{Equations, Given, dimensions, finite, finite_signal};
use crate::course::InputFunction;
use crate::equations::contact;
use crate::equations::geometry;
use crate::equations::scale::Scale;
use crate::equations::system::System;
use crate::error::SolveError;
use crate::linear::Ordered;
use crate::model::Model;
use crate::observer::Observed;
use crate::options::Options;
use crate::scalar::compare::all_finite;
use crate::signal::{Instant, Signal};
use crate::workspace::Subset;
use nalgebra::DVector;

impl<'a> Equations<'a> {
    /// The equations of `system` at `at`, with prescribed coordinates (index in q, signal at that instant).
    pub(crate) fn new(
        system: Box<dyn System + 'a>,
        options: Options,
        given: &[(usize, Signal)],
        input_function: InputFunction<'a>,
        at: &Instant<'_>,
    ) -> Result<Self, SolveError> {
        options.check()?;
        let model = system.model();
        let n = model.coordinates.len();
        let rows = model.rows.len() + given.len();
        for (k, &(coordinate, signal)) in given.iter().enumerate() {
            if coordinate >= n {
                return Err(SolveError::UnknownCoordinate { index: coordinate, coordinates: n });
            }
            let name = model.coordinates[coordinate].name;
            finite_signal("given", k, name, signal)?;
        }
        for (index, &value) in system.parameters().iter().enumerate() {
            let name = model.parameters.get(index).map_or("", |p| p.name);
            finite("parameters", index, name, value)?;
        }
        let ordered = pattern(model, given.iter().map(|given| given.0));
        let mut equations = Self {
            system,
            model,
            options,
            scale: Scale::unit(rows, n),
            poses_are_coordinates: model.poses_are_coordinates(),
            given: given.iter().map(|&(coordinate, start)| Given { coordinate, start, now: start }).collect(),
            start_time: at.t,
            input_function,
            path: None,
            observed: Observed::new(None, 0),
            lengths: Vec::new(),
            t: at.t,
            inputs: Vec::new(),
            phi: DVector::zeros(rows),
            phi_q: vec![1.0; ordered.entries().len()],
            ordered,
            phi_t: DVector::zeros(rows),
            gamma: DVector::zeros(rows),
            geometry: vec![0.0; model.geometry],
            still: vec![0.0; n],
            reversed: vec![0.0; n],
            moving: Vec::new(),
        };
        equations.set_instant(at)?;
        equations.lengths = kept_lengths(model);
        equations.check_lengths(at, |_| true)?;
        dimensions::check(&equations)?;
        Ok(equations)
    }

    /// Evaluates a subset at q and q̇ (`None` where γ is not requested).
    pub(crate) fn evaluate(&mut self, subset: Subset, q: &[f64], q_dot: Option<&[f64]>) -> Result<(), SolveError> {
        self.evaluate_rows(subset, q, q_dot).map_err(|error| {
            let error = contact::explain(self, q, error);
            geometry::explain(self, error).at(self.t)
        })
    }

    fn evaluate_rows(&mut self, subset: Subset, q: &[f64], q_dot: Option<&[f64]>) -> Result<(), SolveError> {
        let at = Instant { t: self.t, inputs: &self.inputs };
        self.system.evaluate(subset, &at, q, q_dot.unwrap_or(&self.still))?;
        let parts = self.system.constraints();
        let declared = self.model.rows.len();
        if subset.phi {
            copy("Φ", self.model, parts.phi, &mut self.phi)?;
        }
        if subset.phi_t {
            copy("Φ_t", self.model, parts.phi_t, &mut self.phi_t)?;
        }
        if subset.gamma {
            copy("γ", self.model, parts.gamma, &mut self.gamma)?;
        }
        if subset.phi_q {
            if !all_finite(parts.phi_q) {
                let entries = self.model.constraint_pattern.entries;
                for (&(row, _), &value) in entries.iter().zip(parts.phi_q) {
                    finite("Φ_q", row, self.model.rows.get(row).map_or("", |r| r.name), value)?;
                }
            }
            self.phi_q[..parts.phi_q.len()].copy_from_slice(parts.phi_q);
        }
        let frozen = self.is_frozen();
        for (k, given) in self.given.iter().enumerate() {
            self.phi[declared + k] = q[given.coordinate] - given.now.value;
            self.phi_t[declared + k] = if frozen { 0.0 } else { -given.now.rate };
            self.gamma[declared + k] = if frozen { 0.0 } else { given.now.acceleration };
        }
        if frozen { self.without_time(subset, q, q_dot) } else { Ok(()) }
    }

    /// Subtracts from Φ_t and γ the contribution of time itself, so that they are derivatives along the course of the
    /// inputs:
    ///
    /// ```text
    /// Φ_u u′ = Φ_t(u′) − Φ_t(0)        ½ [γ(q′, u′) + γ(−q′, −u′)] − γ(0, 0)
    /// ```
    ///
    /// The second formula is the part of γ that is quadratic in the rates; on a straight course u″ = 0.
    fn without_time(&mut self, subset: Subset, q: &[f64], q_dot: Option<&[f64]>) -> Result<(), SolveError> {
        let declared = self.model.rows.len();
        let mut moving = core::mem::take(&mut self.moving);
        if subset.phi_t {
            moving.clear();
            moving.extend(self.inputs.iter().map(|u| Signal::constant(u.value)));
            self.system.evaluate(Subset::TIME_DERIVATIVE, &Instant { t: self.t, inputs: &moving }, q, &self.still)?;
            let still = self.system.constraints();
            self.phi_t.iter_mut().take(declared).zip(still.phi_t).for_each(|(whole, part)| *whole -= part);
        }
        if subset.gamma {
            let q_dot = q_dot.unwrap_or(&self.still);
            self.reversed.iter_mut().zip(q_dot).for_each(|(back, forward)| *back = -forward);
            moving.clear();
            moving.extend(self.inputs.iter().map(|u| Signal::new(u.value, -u.rate, 0.0)));
            self.system.evaluate(Subset::GAMMA, &Instant { t: self.t, inputs: &moving }, q, &self.reversed)?;
            let backward = self.system.constraints();
            self.gamma
                .iter_mut()
                .take(declared)
                .zip(backward.gamma)
                .for_each(|(half, other)| *half = 0.5 * (*half + other));
            moving.iter_mut().for_each(|u| u.rate = 0.0);
            self.system.evaluate(Subset::GAMMA, &Instant { t: self.t, inputs: &moving }, q, &self.still)?;
            let still = self.system.constraints();
            self.gamma.iter_mut().take(declared).zip(still.gamma).for_each(|(even, part)| *even -= part);
        }
        self.moving = moving;
        Ok(())
    }
}

/// The pattern of Φ_q, including the rows of prescribed coordinates.
fn pattern(model: &Model, given: impl Iterator<Item = usize>) -> Ordered {
    let mut entries = model.constraint_pattern.entries.to_vec();
    entries.extend(given.enumerate().map(|(k, coordinate)| (model.rows.len() + k, coordinate)));
    Ordered::new(model.coordinates.len(), entries)
}

/// Copies the rows of the mechanism and checks that they are finite.
fn copy(what: &'static str, model: &'static Model, from: &[f64], to: &mut DVector<f64>) -> Result<(), SolveError> {
    if !all_finite(from) {
        for (index, &value) in from.iter().enumerate() {
            finite(what, index, model.rows.get(index).map_or("", |r| r.name), value)?;
        }
    }
    to.as_mut_slice()[..from.len()].copy_from_slice(from);
    Ok(())
}
