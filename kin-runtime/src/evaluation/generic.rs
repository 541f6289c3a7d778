//! Mechanisms that are generic over their scalar type.

use crate::mechanism::LengthError;
use crate::scalar::Scalar;
use crate::signal::Instant;
use crate::workspace::{Array, Subset};

/// A mechanism whose struct is generic over the type of its numbers, and which is evaluated in that scalar type.
///
/// `#[mechanism]` implements this trait for every [`Scalar`] where the struct has one type parameter for its numbers,
/// `struct FourBar<T> { l1: T, l: [T; 3] }`. No number is converted to `f64`: a length that is a dual number gives the
/// derivatives of Φ with respect to that length, a length with SIMD lanes is a different length in each lane, and an
/// `f32` stays an `f32`. Fields of other types (`n: f64` beside `l: T`) are converted.
///
/// [`Mechanism`](crate::Mechanism), which the solver and the command line use, is implemented where the numbers are
/// `f64` or `f32`. That trait gives the names, patterns and sizes, and evaluates at parameters that the caller
/// supplies.
///
/// ```
/// use kin_runtime::{GenericMechanism, Instant, Subset, mechanism};
///
/// #[mechanism]
/// #[bodies(arm)]
/// #[revolute(O: ground @ (0, 0), arm @ (-l, 0))]
/// #[driver(drive: arm.phi = omega * t)]
/// #[derive(Clone, Copy)]
/// struct Arm<T> {
///     #[param(0.5)]
///     l: T,
///     #[param(2)]
///     omega: T,
/// }
///
/// let arm = Arm::<f32>::default();
/// let mut workspace = Arm::own_workspace();
/// arm.evaluate_own(Subset::PHI, &Instant::at(0.0), &[0.5, 0.0, 0.25], &[0.0; 3], &mut workspace)?;
/// assert_eq!(0.25, workspace.phi()[2]);
/// # Ok::<(), kin_runtime::LengthError>(())
/// ```
pub trait GenericMechanism {
    /// The scalar type of the fields.
    type Scalar: Scalar;
    /// An array of all parameters.
    type Parameters: Array<Self::Scalar>;
    /// A buffer for Φ, Φ_q, Φ_t and γ, like [`Workspace`](crate::Workspace).
    type Workspace;
    /// A buffer for the observables, like [`Workspace`](crate::Workspace).
    type Observations;

    /// A workspace with the constant entries of Φ_q in place.
    fn own_workspace() -> Self::Workspace;

    /// A workspace for the observables with the constant entries of their Jacobian in place.
    fn own_observations() -> Self::Observations;

    /// The parameters in their own scalar type, in the order of [`Model::parameters`](crate::model::Model::parameters).
    fn own_parameters(&self) -> Self::Parameters;

    /// Evaluates Φ, Φ_q, Φ_t, γ, or any subset of them, at the struct's own parameters.
    ///
    /// # Errors
    /// When the inputs, `q` or `q_dot` have the wrong length.
    fn evaluate_own(
        &self,
        subset: Subset,
        at: &Instant<'_, Self::Scalar>,
        q: &[Self::Scalar],
        q_dot: &[Self::Scalar],
        workspace: &mut Self::Workspace,
    ) -> Result<(), LengthError>;

    /// Evaluates the observables with their Jacobian, time derivative and acceleration right-hand side.
    ///
    /// # Errors
    /// When the inputs, `q` or `q_dot` have the wrong length.
    fn observe_own(
        &self,
        at: &Instant<'_, Self::Scalar>,
        q: &[Self::Scalar],
        q_dot: &[Self::Scalar],
        observations: &mut Self::Observations,
    ) -> Result<(), LengthError>;
}
