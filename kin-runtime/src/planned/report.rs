//! Further results for controllers, without an allocator: a point with its Jacobian with respect to the inputs, and
//! forces.
//!
//! A point r(q, u, t) moves with ṙ = r_q q̇ + r_u u̇ + r_t, and Φ_q q̇ = −Φ_u u̇ − Φ_t. Both are linear in u̇, so that
//! the column of an input is the difference of two velocities at the same configuration: with the rate of this input 1,
//! and with all rates 0.

use super::{PlanError, Planned};
use crate::mechanism::{LengthError, Mechanism};
use crate::model::{ForceModel, Point};
use crate::signal::{Instant, Signal};
use crate::workspace::{Array, Subset};

impl<M: Mechanism> Planned<'_, M> {
    /// r, ṙ and r̈ of a named point at the last accepted state, in the inertial frame.
    ///
    /// # Errors
    /// [`PlanError::Length`] for the handle of another mechanism.
    pub fn point(&self, point: Point) -> Result<[[f64; 2]; 3], PlanError> {
        let seen = seen::<M>(point)?;
        let (q, q_dot, q_ddot) = (self.q(), self.q_dot(), self.q_ddot());
        let mut observations = M::observations::<f64>();
        let at = Instant { t: self.t(), inputs: self.follower.inputs.as_ref() };
        self.mechanism().observe_with(self.follower.parameters.as_ref(), &at, q, q_dot, &mut observations)?;
        let along = |row: usize, rates: &[f64]| along::<M>(row, observations.phi_q(), rates);
        Ok([
            seen.map(|k| observations.phi()[k]),
            seen.map(|k| along(k, q_dot) + observations.phi_t()[k]),
            seen.map(|k| along(k, q_ddot) - observations.gamma()[k]),
        ])
    }

    /// Writes dr/du of a named point at the last accepted state, where q follows the inputs so that Φ = 0: one column
    /// for every input. From it a controller of the point computes the rates of the inputs. Without inputs it is empty.
    ///
    /// # Errors
    /// [`PlanError::Length`] if `jacobian` does not have one column for every input, and for the handle of another
    /// mechanism.
    pub fn point_jacobian(&self, point: Point, jacobian: &mut [[f64; 2]]) -> Result<(), PlanError> {
        if jacobian.len() != M::INPUTS {
            let found = jacobian.len();
            return Err(LengthError { what: "jacobian", expected: M::INPUTS, found }.into());
        }
        let seen = seen::<M>(point)?;
        let parameters = self.follower.parameters.as_ref();
        let mut factors = M::Factors::<f64>::filled(0.0);
        let at = Instant { t: self.t(), inputs: self.follower.inputs.as_ref() };
        self.mechanism().factorise_with(parameters, &at, self.q(), &mut factors)?;
        let still = self.velocity(seen, &factors, None)?;
        for (k, column) in jacobian.iter_mut().enumerate() {
            let moved = self.velocity(seen, &factors, Some(k))?;
            *column = [moved[0] - still[0], moved[1] - still[1]];
        }
        Ok(())
    }

    /// The velocity of a point where the input `moving` has the rate 1 and all others 0.
    fn velocity(
        &self,
        seen: [usize; 2],
        factors: &M::Factors<f64>,
        moving: Option<usize>,
    ) -> Result<[f64; 2], PlanError> {
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        for (k, (input, measured)) in inputs.as_mut().iter_mut().zip(self.follower.inputs.as_ref()).enumerate() {
            *input = Signal::new(measured.value, if Some(k) == moving { 1.0 } else { 0.0 }, 0.0);
        }
        let (at, parameters) = (Instant { t: self.t(), inputs: inputs.as_ref() }, self.follower.parameters.as_ref());
        let mut rest = M::Coordinates::<f64>::filled(0.0);
        let mut workspace = M::workspace::<f64>();
        let (mechanism, q) = (self.mechanism(), self.q());
        mechanism.evaluate_with(parameters, Subset::TIME_DERIVATIVE, &at, q, rest.as_ref(), &mut workspace)?;
        let mut nu = M::Rows::<f64>::filled(0.0);
        nu.as_mut().iter_mut().zip(workspace.phi_t()).for_each(|(nu, phi_t)| *nu = -phi_t);
        M::solve_factorised(factors, nu.as_ref(), rest.as_mut())?;
        let mut observations = M::observations::<f64>();
        mechanism.observe_with(parameters, &at, q, rest.as_ref(), &mut observations)?;
        Ok(seen.map(|k| along::<M>(k, observations.phi_q(), rest.as_ref()) + observations.phi_t()[k]))
    }

    /// Writes the numbers of all forces at the last accepted state, [`ForceModel::count`] of them. Returns `None` and
    /// writes nothing for a mechanism without masses and loads, and where λ has no closed form
    /// ([`ForceModel::solved`]).
    ///
    /// # Errors
    /// [`PlanError::Length`] where `forces` has another length; [`PlanError::NonFinite`] where a number is not finite, as
    /// for a spring between points that coincide.
    pub fn forces(&self, forces: &mut [f64]) -> Result<Option<&'static ForceModel>, PlanError> {
        let Some(model) = M::model().forces.filter(|model| model.solved) else { return Ok(None) };
        let at = Instant { t: self.t(), inputs: self.follower.inputs.as_ref() };
        let (q, q_dot, q_ddot) = (self.q(), self.q_dot(), self.q_ddot());
        self.mechanism().forces_with(self.follower.parameters.as_ref(), &at, q, q_dot, q_ddot, &[], forces)?;
        match forces.iter().position(|number| !number.is_finite()) {
            Some(index) => Err(PlanError::NonFinite { what: "forces", index, name: "", t: self.t() }),
            None => Ok(Some(model)),
        }
    }
}

/// The indices of a point's coordinates among the observables.
fn seen<M: Mechanism>(point: Point) -> Result<[usize; 2], LengthError> {
    let points = M::model().points;
    let unknown = LengthError { what: "points", expected: points.len(), found: point.0 + 1 };
    points.get(point.0).map(|point| point.observables).ok_or(unknown)
}

/// Σ o_q q̇ of an observable; the pattern is sorted by rows.
fn along<M: Mechanism>(row: usize, phi_q: &[f64], rates: &[f64]) -> f64 {
    let entries = M::model().observable_pattern.entries;
    let first = entries.partition_point(|&(other, _)| other < row);
    let of_row = entries.iter().zip(phi_q).skip(first).take_while(|((other, _), _)| *other == row);
    of_row.map(|(&(_, column), entry)| entry * rates[column]).sum()
}
