//! The trait that `#[mechanism]` implements.

use crate::evaluation::curve::CurvePoint;
use crate::model::Model;
use crate::plan::{Depth, Solved};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::workspace::{Array, Evaluation, Instant, Subset};

mod length;
mod workspaces;

pub use length::LengthError;
pub use workspaces::{Observations, Workspace};

/// A planar mechanism with closed-form constraints, written by `#[mechanism]`.
///
/// Shapes: n coordinates, s rows. q, q̇ are slices of n numbers in the order of [`Model::coordinates`]; Φ, Φ_t, γ have
/// s numbers in the order of [`Model::rows`]; Φ_q is given by its non-zeros in the order of
/// [`Model::constraint_pattern`]. Lengths in the user's unit, angles in radians, counter-clockwise.
///
/// The evaluation path needs neither `std` nor an allocator.
pub trait Mechanism: Sized {
    /// n, the number of generalized coordinates.
    const COORDINATES: usize;
    /// s, the number of rows of Φ.
    const ROWS: usize;
    /// The number of parameters, array fields element by element.
    const PARAMETERS: usize;
    /// The number of inputs.
    const INPUTS: usize;
    /// The number of lengths that joints keep: of links, cylinders and drivers of distances. There are never more than rows.
    const LENGTHS: usize = 0;

    /// `[T; PARAMETERS]`.
    type Parameters<T: Scalar>: Array<T>;
    /// `[Signal<T>; INPUTS]`.
    type Inputs<T: Scalar>: Array<Signal<T>>;
    /// `[T; COORDINATES]`.
    type Coordinates<T: Scalar>: Array<T>;
    /// `[T; ROWS]`.
    type Rows<T: Scalar>: Array<T>;
    /// One `T` for every entry of the pattern of Φ_q.
    type NonZeros<T: Scalar>: Array<T>;
    /// One `T` for every observable.
    type Observables<T: Scalar>: Array<T>;
    /// One `T` for every entry of the pattern of the observables' Jacobian.
    type ObservableNonZeros<T: Scalar>: Array<T>;
    /// What [`factorise_with`](Self::factorise_with) leaves for one right-hand side after another; without a plan empty.
    type Factors<T: Scalar>: Array<T>;
    /// Where among the factors it says how far they are from being singular, as margins do: first place and end.
    const REGULAR: (usize, usize) = (0, 0);

    /// Names, rows, patterns and geometry.
    fn model() -> &'static Model;

    /// The parameters as the scalar `T`, in the order of [`Model::parameters`].
    fn parameters<T: Scalar>(&self) -> Self::Parameters<T>;

    /// Sets the parameter at `index` of [`Model::parameters`]; false when there is no such index.
    fn set_parameter(&mut self, index: usize, value: f64) -> bool;

    /// (f, f′, f″) at `x` of the supplied function at `index` of [`Model::functions`]; `None` when there is none.
    fn evaluate_function(&self, index: usize, x: f64) -> Option<[f64; 3]> {
        let _ = (index, x);
        None
    }

    /// The arguments at which supplied functions are evaluated, one for every entry of [`Model::arguments`].
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn write_arguments<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        arguments: &mut [T],
    ) -> Result<(), LengthError> {
        let _ = (parameters, at, q);
        length::empty("arguments", arguments)
    }

    /// Φ, Φ_q, Φ_t, γ, or any subset of them, at parameters that the caller supplies; all shared work is done once.
    ///
    /// Units follow the parameters. Parts that `subset` does not ask for may be overwritten or left alone.
    ///
    /// # Errors
    /// When `parameters`, the inputs, `q` or `q_dot` have the wrong length.
    fn evaluate_with<T: Scalar>(
        &self,
        parameters: &[T],
        subset: Subset,
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        workspace: &mut Workspace<Self, T>,
    ) -> Result<(), LengthError>;

    /// Φ(q, t) alone. A scalar that is only used here, a dual number for example, compiles nothing of the derivatives.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn constraints_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        phi: &mut Self::Rows<T>,
    ) -> Result<(), LengthError> {
        let mut workspace = Self::workspace::<T>();
        let rest = Self::Coordinates::<T>::filled(T::from_f64(0.0));
        self.evaluate_with(parameters, Subset::PHI, at, q, rest.as_ref(), &mut workspace)?;
        *phi = *workspace.parts_mut().0;
        Ok(())
    }

    /// η of the rows of velocity level, η = B(q, t) q̇ + b(q, t), for any scalar type; 0 in all other rows.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn velocity_constraints_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        eta: &mut [T],
    ) -> Result<(), LengthError> {
        // Without rows of velocity level there is nothing to evaluate.
        let _ = (parameters, at, q, q_dot);
        eta.fill(T::from_f64(0.0));
        Ok(())
    }

    /// q, q̇ and q̈, as far as `depth` goes, by the plan ([`Model::plan`]): every group in closed form where it has one.
    ///
    /// `modes` has a sign, ±1, for every mode of the plan; angles come out within half a turn of those in `start`, n
    /// numbers, and iterations start there. What is written is good only where all margins are positive; nothing is
    /// written where there is no plan.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn solve_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        modes: &[T],
        start: &[T],
        depth: Depth,
        solved: Solved<'_, T>,
    ) -> Result<(), LengthError> {
        let _ = (parameters, at, modes, start, depth, solved);
        Ok(())
    }

    /// For every mode of the plan, a number in −1 ≤ w ≤ 1 whose sign is the mode of the configuration q and whose
    /// size says how far the two closures are apart: 0 where they meet.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn closures_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        closures: &mut [T],
    ) -> Result<(), LengthError> {
        let _ = (parameters, at, q, closures);
        Ok(())
    }

    /// What tells the branches of every group of the plan apart at the configuration q: the numbers of
    /// [`closures_with`](Self::closures_with), and behind them such a number for every group that is solved by iteration
    /// ([`Plan::orientations`](crate::plan::Plan::orientations)), the determinant of its own small system, normalised.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn branches_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        branches: &mut [T],
    ) -> Result<(), LengthError> {
        self.closures_with(parameters, at, q, branches)
    }

    /// What x with Φ_q x = b needs of Φ_q at q, by the blocks of the plan; nothing is written where there is no plan.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn factorise_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        factors: &mut Self::Factors<T>,
    ) -> Result<(), LengthError> {
        let _ = (parameters, at, q, factors);
        Ok(())
    }

    /// x with Φ_q x = b, s numbers b, n numbers x, given the factors of Φ_q; nothing is written where there is no plan.
    /// Where Φ_q is singular, x is not finite or far too large: whoever asks for it checks Φ_q x = b, or the margins of
    /// a solution.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn solve_factorised<T: Scalar>(factors: &Self::Factors<T>, b: &[T], x: &mut [T]) -> Result<(), LengthError> {
        let _ = (factors, b, x);
        Ok(())
    }

    /// The observables with their Jacobian, time derivative and acceleration right-hand side.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn observe_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        observations: &mut Observations<Self, T>,
    ) -> Result<(), LengthError>;

    /// Local points, axes and values of all joints and points, [`Model::geometry`] numbers.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn write_geometry<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        geometry: &mut [T],
    ) -> Result<(), LengthError> {
        let _ = (parameters, at);
        length::empty("geometry", geometry)
    }

    /// The lengths that joints keep, [`LENGTHS`](Self::LENGTHS) numbers in the order of their joints. A row of such a joint
    /// holds the square, which says nothing of the sign: a negative length is an error.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn lengths_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        lengths: &mut [T],
    ) -> Result<(), LengthError> {
        let _ = (parameters, at);
        length::empty("lengths", lengths)
    }

    /// r = Q − M q̈, n numbers: what loads and inertia leave for the constraints, Φ_qᵀ λ = r.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    fn generalized_forces_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        q_ddot: &[T],
        generalized: &mut [T],
    ) -> Result<(), LengthError> {
        let _ = (parameters, at, q, q_dot, q_ddot, generalized);
        Ok(())
    }

    /// Efforts, reactions, energies and powers at a solved q, q̇, q̈: the numbers of [`ForceModel`](crate::model::ForceModel).
    /// `right` is λ, s numbers; or nothing, where the closed forms solve it along the plan.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    #[allow(clippy::too_many_arguments)]
    fn forces_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        q_ddot: &[T],
        right: &[T],
        forces: &mut [T],
    ) -> Result<(), LengthError> {
        let _ = (parameters, at, q, q_dot, q_ddot, right, forces);
        Ok(())
    }

    /// The guessed values of the coordinates listed in [`Model::guesses`].
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn write_guesses<T: Scalar>(&self, parameters: &[T], guesses: &mut [T]) -> Result<(), LengthError> {
        let _ = parameters;
        length::empty("guesses", guesses)
    }

    /// A point of the curve of `joint`, a place in [`Model::joints`], at the argument `s` (see [`CurvePoint`]); `None`
    /// for a joint without a curve and for one in implicit form. The cam's own outline, whatever `roller` runs on it.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn curve_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        joint: usize,
        s: T,
    ) -> Result<Option<CurvePoint<T>>, LengthError> {
        let _ = (parameters, at, joint, s);
        Ok(None)
    }

    /// [`curve_with`](Self::curve_with) at the struct's own parameters.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn curve_point<T: Scalar>(
        &self,
        at: &Instant<'_, T>,
        joint: usize,
        s: T,
    ) -> Result<Option<CurvePoint<T>>, LengthError> {
        self.curve_with(self.parameters::<T>().as_ref(), at, joint, s)
    }

    /// A workspace with the constant entries of Φ_q in place.
    fn workspace<T: Scalar>() -> Workspace<Self, T> {
        Evaluation::new(&Self::model().constraint_pattern)
    }

    /// A workspace for the observables with the constant entries of their Jacobian in place.
    fn observations<T: Scalar>() -> Observations<Self, T> {
        Evaluation::new(&Self::model().observable_pattern)
    }

    /// Φ, Φ_q, Φ_t, γ, or any subset of them, at the struct's own parameters.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    #[inline(always)]
    fn evaluate<T: Scalar>(
        &self,
        subset: Subset,
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        workspace: &mut Workspace<Self, T>,
    ) -> Result<(), LengthError> {
        let parameters = self.parameters::<T>();
        self.evaluate_with(parameters.as_ref(), subset, at, q, q_dot, workspace)
    }

    /// Φ(q, t), s numbers.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn constraints<T: Scalar>(&self, at: &Instant<'_, T>, q: &[T]) -> Result<Self::Rows<T>, LengthError> {
        let mut phi = Self::Rows::<T>::filled(T::from_f64(0.0));
        self.constraints_with(self.parameters::<T>().as_ref(), at, q, &mut phi)?;
        Ok(phi)
    }

    /// The non-zeros of Φ_q(q, t), in the order of [`Model::constraint_pattern`].
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn jacobian<T: Scalar>(&self, at: &Instant<'_, T>, q: &[T]) -> Result<Self::NonZeros<T>, LengthError> {
        let mut workspace = Self::workspace::<T>();
        let rest = Self::Coordinates::<T>::filled(T::from_f64(0.0));
        self.evaluate(Subset::JACOBIAN, at, q, rest.as_ref(), &mut workspace)?;
        Ok(*workspace.parts_mut().1)
    }

    /// Φ_t(q, t), s numbers; ν = −Φ_t.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn time_derivative<T: Scalar>(&self, at: &Instant<'_, T>, q: &[T]) -> Result<Self::Rows<T>, LengthError> {
        let mut workspace = Self::workspace::<T>();
        let rest = Self::Coordinates::<T>::filled(T::from_f64(0.0));
        self.evaluate(Subset::TIME_DERIVATIVE, at, q, rest.as_ref(), &mut workspace)?;
        Ok(*workspace.parts_mut().2)
    }

    /// γ(q, q̇, t) = −(Φ_q q̇)_q q̇ − 2 Φ_qt q̇ − Φ_tt, s numbers.
    ///
    /// # Errors
    /// As [`evaluate_with`](Self::evaluate_with).
    fn gamma<T: Scalar>(&self, at: &Instant<'_, T>, q: &[T], q_dot: &[T]) -> Result<Self::Rows<T>, LengthError> {
        let mut workspace = Self::workspace::<T>();
        self.evaluate(Subset::GAMMA, at, q, q_dot, &mut workspace)?;
        Ok(*workspace.parts_mut().3)
    }
}
