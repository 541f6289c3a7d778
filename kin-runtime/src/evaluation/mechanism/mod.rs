//! The trait that `#[mechanism]` implements.

use crate::evaluation::curve::CurvePoint;
use crate::model::Model;
use crate::plan::{Depth, Solved};
use crate::scalar::{Interval, Scalar};
use crate::signal::{Instant, Signal};
use crate::workspace::{Array, Evaluation, Subset};

mod length;
mod workspaces;

pub use length::LengthError;
pub use workspaces::{Observations, Workspace};

/// A planar mechanism with closed-form constraints, implemented by `#[mechanism]`.
///
/// Shapes: n coordinates, s rows. q and q̇ are slices of n numbers in the order of [`Model::coordinates`]; Φ, Φ_t and γ
/// have s numbers in the order of [`Model::rows`]; Φ_q is given by its non-zeros in the order of
/// [`Model::constraint_pattern`]. Lengths are in the user's unit, angles in radians, counter-clockwise.
///
/// The evaluation path needs neither `std` nor an allocator. Every method that returns a [`Result`] returns an error when
/// an argument has the wrong length.
#[allow(unused_variables, reason = "a default is for mechanisms without what it writes")]
pub trait Mechanism: Sized {
    /// n, the number of generalized coordinates.
    const COORDINATES: usize;
    /// s, the number of rows of Φ.
    const ROWS: usize;
    /// The number of parameters, where array fields count element by element.
    const PARAMETERS: usize;
    /// The number of inputs.
    const INPUTS: usize;
    /// The number of lengths that joints prescribe (of links, cylinders and drivers of distances), at most `ROWS`.
    const LENGTHS: usize = 0;
    /// Whether the mechanism implements [`turns_with`](Self::turns_with).
    const ROWS_TURN: bool = false;
    /// Whether rows contain distances of points that may coincide, as between the points of a rope.
    const DISTANCES_IN_ROWS: bool = false;
    /// Whether the branch values of groups that the plan solves in closed form must be looked at within steps, too.
    const CLOSED_ROWS_TURN: bool = false;
    /// Whether the plan iterates on rows with curves, whose gradients may turn faster than bodies do.
    const ROWS_CURVE: bool = false;
    /// Whether a coordinate may move between two configurations otherwise than these show: a row contains a function of
    /// time, of an input, or of a coordinate for which the plan does not iterate on the row, and more than one sinusoid.
    const KNOWN_VALUES_CURVE: bool = false;
    /// Whether a row contains a sinusoid of an input, or a product or power of what inputs change, which may change and return
    /// between two values of the inputs.
    const INPUTS_CURVE: bool = false;

    /// The supplied functions whose arguments [`known_curves_with`](Self::known_curves_with) writes, in their order.
    const FUNCTIONS_IN_CURVES: &'static [usize] = &[];

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
    /// The factors that [`factorise_with`](Self::factorise_with) computes; empty without a plan.
    type Factors<T: Scalar>: Array<T>;
    /// One `T` for every number that [`known_curves_with`](Self::known_curves_with) writes.
    type KnownCurves<T: Scalar>: Array<T>;
    /// The factors that measure the distance from singularity, as margins do: the first index and one past the last.
    const REGULAR: (usize, usize) = (0, 0);

    /// Names, rows, patterns and geometry.
    fn model() -> &'static Model;

    /// The parameters as the scalar `T`, in the order of [`Model::parameters`].
    fn parameters<T: Scalar>(&self) -> Self::Parameters<T>;

    /// Sets the parameter at `index` of [`Model::parameters`]; false when the index is out of range.
    fn set_parameter(&mut self, index: usize, value: f64) -> bool;

    /// (f, f′, f″) at `x` of the supplied function at `index` of [`Model::functions`]; `None` when it is out of range.
    fn evaluate_function(&self, index: usize, x: f64) -> Option<[f64; 3]> {
        None
    }

    /// The values of the supplied function at `index` of [`Model::functions`] over an interval of its argument; undefined
    /// where they are not known (see [`ScalarFunction::enclose`](crate::ScalarFunction::enclose)).
    fn enclose_function(&self, index: usize, x: Interval) -> Interval {
        Interval::UNDEFINED
    }

    /// Writes the arguments at which supplied functions are evaluated, one for every entry of [`Model::arguments`].
    fn write_arguments<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        arguments: &mut [T],
    ) -> Result<(), LengthError> {
        length::empty("arguments", arguments)
    }

    /// Evaluates Φ, Φ_q, Φ_t, γ, or any subset, at parameters of the caller; common terms are computed once.
    /// Units follow the parameters. Parts that `subset` does not request may be overwritten or left unchanged.
    fn evaluate_with<T: Scalar>(
        &self,
        parameters: &[T],
        subset: Subset,
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        workspace: &mut Workspace<Self, T>,
    ) -> Result<(), LengthError>;

    /// Evaluates Φ(q, t) alone. A scalar type that only this method uses (a dual number) compiles no derivatives.
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

    /// Evaluates η = B(q, t) q̇ + b(q, t) of the rows of velocity level, for any scalar type; 0 in all other rows.
    fn velocity_constraints_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        eta: &mut [T],
    ) -> Result<(), LengthError> {
        eta.fill(T::from_f64(0.0));
        Ok(())
    }

    /// Computes q, q̇ and q̈, as far as `depth` requests them, by the plan ([`Model::plan`]): in closed form where
    /// possible. `modes` has a sign, ±1, for every mode of the plan. Angles are within half a turn of those in `start`,
    /// n numbers, from which iterations start. The results are valid only where all margins are positive; nothing is
    /// written without a plan.
    fn solve_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        modes: &[T],
        start: &[T],
        depth: Depth,
        solved: Solved<'_, T>,
    ) -> Result<(), LengthError> {
        Ok(())
    }

    /// Writes the branch values of all groups of the plan at the configuration q. First come those of the modes,
    /// −1 ≤ w ≤ 1: the sign of w is the mode of the configuration, and its size measures the distance between the two
    /// closures, 0 where they meet. A number follows for every group of
    /// [`Plan::orientations`](crate::plan::Plan::orientations), the normalised determinant of the group's system.
    fn branches_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        branches: &mut [T],
    ) -> Result<(), LengthError> {
        Ok(())
    }

    /// Writes how far the gradients of rows turn with each coordinate, in radians per unit of the coordinate: of rows that
    /// the plan iterates, and of those that it solves in closed form for lengths or scalars.
    fn turns_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        turns: &mut [T],
    ) -> Result<(), LengthError> {
        turns.fill(T::from_f64(0.0));
        Ok(())
    }

    /// Writes for every row the sum of 1/d² over the distances d of points in it; 0 for a row without any.
    fn closeness_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        closeness: &mut [T],
    ) -> Result<(), LengthError> {
        closeness.fill(T::from_f64(0.0));
        Ok(())
    }

    /// Writes the functions in rows that are known where the motion is, because they depend on time and inputs alone or on a
    /// single coordinate, and that may hide motion (see [`KNOWN_VALUES_CURVE`](Self::KNOWN_VALUES_CURVE)); then the
    /// arguments of the supplied functions among them, [`FUNCTIONS_IN_CURVES`](Self::FUNCTIONS_IN_CURVES).
    fn known_curves_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        curves: &mut [T],
    ) -> Result<(), LengthError> {
        length::empty("curves", curves)
    }

    /// Factorises Φ_q at q for systems Φ_q x = b, by the blocks of the plan; nothing is written where there is no plan.
    fn factorise_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        factors: &mut Self::Factors<T>,
    ) -> Result<(), LengthError> {
        Ok(())
    }

    /// Solves Φ_q x = b for x (n numbers) from b (s numbers) and the factors of Φ_q; nothing is written where there is
    /// no plan. Where Φ_q is singular, x is not finite or far too large: the caller must check Φ_q x = b, or the
    /// margins of a solution.
    fn solve_factorised<T: Scalar>(factors: &Self::Factors<T>, b: &[T], x: &mut [T]) -> Result<(), LengthError> {
        Ok(())
    }

    /// Evaluates the observables with their Jacobian, time derivative and acceleration right-hand side.
    fn observe_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        observations: &mut Observations<Self, T>,
    ) -> Result<(), LengthError>;

    /// Writes local points, axes and values of all joints and points, [`Model::geometry`] numbers.
    fn write_geometry<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        geometry: &mut [T],
    ) -> Result<(), LengthError> {
        length::empty("geometry", geometry)
    }

    /// Writes the lengths that joints prescribe, [`LENGTHS`](Self::LENGTHS) numbers in the order of their joints. A row
    /// of such a joint contains the square, which hides a negative length; solvers report one as an error.
    fn lengths_with<T: Scalar>(&self, parameters: &[T], at: &Instant<'_, T>, out: &mut [T]) -> Result<(), LengthError> {
        length::empty("lengths", out)
    }

    /// Writes r = Q − M q̈, n numbers: the generalized forces that the constraints must balance, Φ_qᵀ λ = r.
    fn generalized_forces_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        q_ddot: &[T],
        generalized: &mut [T],
    ) -> Result<(), LengthError> {
        Ok(())
    }

    /// Writes what gravity, applied loads and springs exert on bodies at q and q̇: for each of the model's
    /// [`loads`](crate::model::ForceModel::loads) the point and the force in the inertial frame, or the couple.
    fn loads_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        loads: &mut [T],
    ) -> Result<(), LengthError> {
        length::empty("loads", loads)
    }

    /// Writes efforts, reactions, energies and powers at a solved q, q̇, q̈, the numbers of
    /// [`ForceModel`](crate::model::ForceModel). `right` is λ, s numbers; if it is empty, closed forms along the plan
    /// compute λ.
    #[allow(clippy::too_many_arguments, reason = "one argument per quantity that the forces depend on")]
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
        Ok(())
    }

    /// Writes the guessed values of the coordinates listed in [`Model::guesses`].
    fn write_guesses<T: Scalar>(&self, parameters: &[T], guesses: &mut [T]) -> Result<(), LengthError> {
        length::empty("guesses", guesses)
    }

    /// A point of the curve of `joint`, an index in [`Model::joints`], at the argument `s` (see [`CurvePoint`]); `None`
    /// for a joint without a curve and for one in implicit form. With a roller it is the profile on which the roller
    /// runs, not the path of its centre.
    fn curve_with<T: Scalar>(
        &self,
        parameters: &[T],
        at: &Instant<'_, T>,
        joint: usize,
        s: T,
    ) -> Result<Option<CurvePoint<T>>, LengthError> {
        Ok(None)
    }

    /// [`curve_with`](Self::curve_with) at the struct's own parameters.
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

    /// Evaluates Φ, Φ_q, Φ_t, γ, or any subset of them, at the struct's own parameters.
    #[inline(always)]
    fn evaluate<T: Scalar>(
        &self,
        subset: Subset,
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        workspace: &mut Workspace<Self, T>,
    ) -> Result<(), LengthError> {
        self.evaluate_with(self.parameters::<T>().as_ref(), subset, at, q, q_dot, workspace)
    }

    /// Φ(q, t), s numbers.
    fn constraints<T: Scalar>(&self, at: &Instant<'_, T>, q: &[T]) -> Result<Self::Rows<T>, LengthError> {
        let mut phi = Self::Rows::<T>::filled(T::from_f64(0.0));
        self.constraints_with(self.parameters::<T>().as_ref(), at, q, &mut phi)?;
        Ok(phi)
    }

    /// The non-zeros of Φ_q(q, t), in the order of [`Model::constraint_pattern`].
    fn jacobian<T: Scalar>(&self, at: &Instant<'_, T>, q: &[T]) -> Result<Self::NonZeros<T>, LengthError> {
        let mut workspace = Self::workspace::<T>();
        let rest = Self::Coordinates::<T>::filled(T::from_f64(0.0));
        self.evaluate(Subset::JACOBIAN, at, q, rest.as_ref(), &mut workspace)?;
        Ok(*workspace.parts_mut().1)
    }

    /// Φ_t(q, t), s numbers; ν = −Φ_t.
    fn time_derivative<T: Scalar>(&self, at: &Instant<'_, T>, q: &[T]) -> Result<Self::Rows<T>, LengthError> {
        let mut workspace = Self::workspace::<T>();
        let rest = Self::Coordinates::<T>::filled(T::from_f64(0.0));
        self.evaluate(Subset::TIME_DERIVATIVE, at, q, rest.as_ref(), &mut workspace)?;
        Ok(*workspace.parts_mut().2)
    }

    /// γ(q, q̇, t) = −(Φ_q q̇)_q q̇ − 2 Φ_qt q̇ − Φ_tt, s numbers.
    fn gamma<T: Scalar>(&self, at: &Instant<'_, T>, q: &[T], q_dot: &[T]) -> Result<Self::Rows<T>, LengthError> {
        let mut workspace = Self::workspace::<T>();
        self.evaluate(Subset::GAMMA, at, q, q_dot, &mut workspace)?;
        Ok(*workspace.parts_mut().3)
    }
}
