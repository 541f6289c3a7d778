//! The workspaces of a mechanism.

use super::{LengthError, Mechanism};
use crate::scalar::Scalar;
use crate::workspace::{Array, Evaluation, Instant, Subset};

/// A workspace for Φ, Φ_q, Φ_t and γ of the mechanism `M`.
pub type Workspace<M, T = f64> = Evaluation<<M as Mechanism>::Rows<T>, <M as Mechanism>::NonZeros<T>>;

/// A workspace for the observables of the mechanism `M`: poses, points, defines and joint quantities.
#[doc(hidden)]
pub type Observations<M, T = f64> =
    Evaluation<<M as Mechanism>::Observables<T>, <M as Mechanism>::ObservableNonZeros<T>>;

/// A workspace in which the mechanism has evaluated a subset of Φ, Φ_q, Φ_t and γ; q̇ is 0 if it is not given.
///
/// # Errors
/// As [`Mechanism::evaluate_with`].
pub(super) fn evaluated<M: Mechanism, T: Scalar>(
    mechanism: &M,
    parameters: &[T],
    subset: Subset,
    at: &Instant<'_, T>,
    q: &[T],
    q_dot: Option<&[T]>,
) -> Result<Workspace<M, T>, LengthError> {
    let mut workspace = M::workspace::<T>();
    let rest = M::Coordinates::<T>::filled(T::from_f64(0.0));
    mechanism.evaluate_with(parameters, subset, at, q, q_dot.unwrap_or(rest.as_ref()), &mut workspace)?;
    Ok(workspace)
}
