//! Functions that the caller supplies: cam tables, splines, motion laws.

/// A scalar function with its first two derivatives, known at run time.
pub trait ScalarFunction {
    /// (f, f′, f″) at `x`.
    fn evaluate(&self, x: f64) -> [f64; 3];
}
