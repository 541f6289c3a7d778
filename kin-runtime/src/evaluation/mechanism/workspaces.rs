//! The workspaces of a mechanism.

use super::Mechanism;
use crate::workspace::Evaluation;

/// A workspace for Φ, Φ_q, Φ_t and γ of the mechanism `M`.
pub type Workspace<M, T = f64> = Evaluation<<M as Mechanism>::Rows<T>, <M as Mechanism>::NonZeros<T>>;

/// A workspace for the observables of the mechanism `M`: poses, points, defines and joint quantities.
#[doc(hidden)]
pub type Observations<M, T = f64> =
    Evaluation<<M as Mechanism>::Observables<T>, <M as Mechanism>::ObservableNonZeros<T>>;
