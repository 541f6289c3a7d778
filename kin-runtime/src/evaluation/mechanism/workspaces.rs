//! The workspaces of a mechanism.

use super::Mechanism;
use crate::scalar::Scalar;
use crate::workspace::{Array, Evaluation};

/// A workspace for Φ, Φ_q, Φ_t and γ of the mechanism `M`.
pub type Workspace<M, T = f64> = Evaluation<<M as Mechanism>::Rows<T>, <M as Mechanism>::NonZeros<T>>;

/// A workspace for the observables of the mechanism `M`: poses, points, defines and joint quantities.
#[doc(hidden)]
pub type Observations<M, T = f64> =
    Evaluation<<M as Mechanism>::Observables<T>, <M as Mechanism>::ObservableNonZeros<T>>;

/// q̇ = 0.
pub(super) fn at_rest<M: Mechanism, T: Scalar>() -> M::Coordinates<T> {
    M::Coordinates::<T>::filled(T::from_f64(0.0))
}
