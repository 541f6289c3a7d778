//! What generated kernels of power series compute with.

use crate::mechanism::{LengthError, Mechanism};

/// An arithmetic of power series in τ, the time from an instant on, in which a kernel runs.
///
/// Every run goes through the same operations in the same order, so that an arithmetic may note at each of them what it
/// needs there in its next run. What depends on parameters alone are numbers.
pub trait Arithmetic {
    /// A series, or as much of it as this arithmetic carries.
    type Value: Copy;

    /// Numbers that depend on parameters alone.
    fn constants<const N: usize>(&mut self, compute: impl FnOnce() -> [f64; N]) -> [f64; N];
    /// The series of a number.
    fn constant(c: f64) -> Self::Value;
    /// t + τ.
    fn time(&mut self) -> Self::Value;
    /// A generalized coordinate.
    fn coordinate(&mut self, k: usize) -> Self::Value;
    /// Its rate.
    fn rate(&mut self, k: usize) -> Self::Value;
    /// An input, or its derivative of this order.
    fn input(&mut self, k: usize, order: usize) -> Self::Value;
    /// Writes a row.
    fn row(&mut self, row: usize, value: Self::Value);

    /// −a.
    fn neg(&mut self, a: Self::Value) -> Self::Value;
    /// a + b.
    fn add(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// a − b.
    fn sub(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// a + c.
    fn shift(&mut self, a: Self::Value, c: f64) -> Self::Value;
    /// c − a.
    fn below(&mut self, a: Self::Value, c: f64) -> Self::Value;
    /// c a.
    fn scale(&mut self, a: Self::Value, c: f64) -> Self::Value;
    /// a / c.
    fn over(&mut self, a: Self::Value, c: f64) -> Self::Value;
    /// a b.
    fn mul(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// a².
    fn square(&mut self, a: Self::Value) -> Self::Value;
    /// a / b.
    fn div(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// Sines and cosines of several angles.
    fn sin_cos<const N: usize>(&mut self, angles: [Self::Value; N]) -> [(Self::Value, Self::Value); N];
    /// Tangent.
    fn tan(&mut self, a: Self::Value) -> Self::Value;
    /// Inverse sine.
    fn asin(&mut self, a: Self::Value) -> Self::Value;
    /// Inverse cosine.
    fn acos(&mut self, a: Self::Value) -> Self::Value;
    /// Inverse tangent.
    fn atan(&mut self, a: Self::Value) -> Self::Value;
    /// Angle of the vector (x, y).
    fn atan2(&mut self, y: Self::Value, x: Self::Value) -> Self::Value;
    /// Square root.
    fn sqrt(&mut self, a: Self::Value) -> Self::Value;
    /// Exponential.
    fn exp(&mut self, a: Self::Value) -> Self::Value;
    /// Natural logarithm.
    fn ln(&mut self, a: Self::Value) -> Self::Value;
    /// Absolute value.
    fn abs(&mut self, a: Self::Value) -> Self::Value;
    /// Sign, ±1.
    fn signum(&mut self, a: Self::Value) -> Self::Value;
    /// Integer power.
    fn powi(&mut self, a: Self::Value, n: i32) -> Self::Value;
    /// Real constant power.
    fn powf(&mut self, a: Self::Value, n: f64) -> Self::Value;
    /// Supplied function `number` and its first two derivatives at `a`; those above `used` are not needed. `f` writes
    /// f, f′, f″, … as far as they are known and says how many.
    fn supplied(
        &mut self,
        number: usize,
        used: usize,
        a: Self::Value,
        f: &impl Fn(f64, &mut [f64]) -> usize,
    ) -> [Self::Value; 3];
}

/// A mechanism whose rows can be expanded in powers of time, written by `#[mechanism]`.
///
/// [`Solver::derivatives`](crate::Solver::derivatives) and [`HigherOrders`](super::HigherOrders) use it.
pub trait PowerSeries: Mechanism {
    /// Φ(q, t); rows of velocity level are 0.
    ///
    /// # Errors
    /// When `parameters` has the wrong length.
    fn constraint_series<X: Arithmetic>(&self, parameters: &[f64], x: &mut X) -> Result<(), LengthError>;

    /// η(q, q̇, t) of the rows of velocity level; the others are not written.
    ///
    /// # Errors
    /// When `parameters` has the wrong length.
    fn velocity_series<X: Arithmetic>(&self, parameters: &[f64], x: &mut X) -> Result<(), LengthError> {
        // Without rows of velocity level there is nothing to expand.
        let _ = (parameters, x);
        Ok(())
    }

    /// The observables: poses, points, defines, joint quantities and conditions.
    ///
    /// # Errors
    /// When `parameters` has the wrong length.
    fn observable_series<X: Arithmetic>(&self, parameters: &[f64], x: &mut X) -> Result<(), LengthError>;
}
