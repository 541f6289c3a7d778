//! The thin generic layer: what checks evaluate of a mechanism.

use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::scalar::Scalar;
use crate::signal::Instant;
use crate::workspace::{Array, Subset};
use num_dual::{Dual2_64, Dual64};

/// The entries of Φ_q in the order of its pattern, Φ_t and γ.
pub(super) type ClosedForms = [Vec<f64>; 3];

/// A mechanism that is compared with dual numbers.
pub(crate) trait Checked {
    fn model(&self) -> &'static Model;
    /// The struct's own parameters.
    fn own_parameters(&self) -> Vec<f64>;
    /// The closed forms at parameters of the caller.
    fn closed_forms(
        &self,
        parameters: &[f64],
        at: &Instant<'_>,
        q: &[f64],
        q_dot: &[f64],
    ) -> Result<ClosedForms, LengthError>;
    /// Φ over dual numbers.
    fn first_order(
        &self,
        parameters: &[Dual64],
        at: &Instant<'_, Dual64>,
        q: &[Dual64],
    ) -> Result<Vec<Dual64>, LengthError>;
    /// Φ over dual numbers of second order.
    fn second_order(
        &self,
        parameters: &[Dual2_64],
        at: &Instant<'_, Dual2_64>,
        q: &[Dual2_64],
    ) -> Result<Vec<Dual2_64>, LengthError>;
    /// η over dual numbers.
    fn velocity_level(
        &self,
        parameters: &[Dual64],
        at: &Instant<'_, Dual64>,
        q: &[Dual64],
        q_dot: &[Dual64],
    ) -> Result<Vec<Dual64>, LengthError>;
    /// Writes the arguments of supplied functions.
    fn arguments(
        &self,
        parameters: &[f64],
        at: &Instant<'_>,
        q: &[f64],
        arguments: &mut [f64],
    ) -> Result<(), LengthError>;
    /// (f, f′, f″) of a supplied function.
    fn function(&self, index: usize, x: f64) -> Option<[f64; 3]>;
}

impl<M: Mechanism> Checked for M {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn own_parameters(&self) -> Vec<f64> {
        self.parameters::<f64>().as_ref().to_vec()
    }

    fn closed_forms(
        &self,
        parameters: &[f64],
        at: &Instant<'_>,
        q: &[f64],
        q_dot: &[f64],
    ) -> Result<ClosedForms, LengthError> {
        let mut workspace = M::workspace::<f64>();
        self.evaluate_with(parameters, Subset::ALL, at, q, q_dot, &mut workspace)?;
        Ok([workspace.phi_q(), workspace.phi_t(), workspace.gamma()].map(<[f64]>::to_vec))
    }

    fn first_order(
        &self,
        parameters: &[Dual64],
        at: &Instant<'_, Dual64>,
        q: &[Dual64],
    ) -> Result<Vec<Dual64>, LengthError> {
        constraints(self, parameters, at, q)
    }

    fn second_order(
        &self,
        parameters: &[Dual2_64],
        at: &Instant<'_, Dual2_64>,
        q: &[Dual2_64],
    ) -> Result<Vec<Dual2_64>, LengthError> {
        constraints(self, parameters, at, q)
    }

    fn velocity_level(
        &self,
        parameters: &[Dual64],
        at: &Instant<'_, Dual64>,
        q: &[Dual64],
        q_dot: &[Dual64],
    ) -> Result<Vec<Dual64>, LengthError> {
        let mut eta = vec![Dual64::from_re(0.0); M::ROWS];
        self.velocity_constraints_with(parameters, at, q, q_dot, &mut eta)?;
        Ok(eta)
    }

    fn arguments(
        &self,
        parameters: &[f64],
        at: &Instant<'_>,
        q: &[f64],
        arguments: &mut [f64],
    ) -> Result<(), LengthError> {
        self.write_arguments(parameters, at, q, arguments)
    }

    fn function(&self, index: usize, x: f64) -> Option<[f64; 3]> {
        self.evaluate_function(index, x)
    }
}

fn constraints<M: Mechanism, T: Scalar>(
    mechanism: &M,
    parameters: &[T],
    at: &Instant<'_, T>,
    q: &[T],
) -> Result<Vec<T>, LengthError> {
    let mut phi = M::Rows::<T>::filled(T::from_f64(0.0));
    mechanism.constraints_with(parameters, at, q, &mut phi)?;
    Ok(phi.as_ref().to_vec())
}
