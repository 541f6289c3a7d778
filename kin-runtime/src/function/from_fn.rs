//! Closures as supplied functions.

use super::ScalarFunction;
use core::fmt;

/// A closure that returns (f, f′, f″).
///
/// ```
/// use kin_runtime::{ScalarFunction, function::FromFn};
///
/// let square = FromFn(|x: f64| [x * x, 2.0 * x, 2.0]);
/// assert_eq!(square.evaluate(3.0), [9.0, 6.0, 2.0]);
/// ```
#[derive(Clone, Copy)]
pub struct FromFn<F>(pub F);

impl<F: Fn(f64) -> [f64; 3]> ScalarFunction for FromFn<F> {
    #[inline]
    fn evaluate(&self, x: f64) -> [f64; 3] {
        (self.0)(x)
    }
}

impl<F> fmt::Debug for FromFn<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("FromFn(…)")
    }
}

impl<F> fmt::Display for FromFn<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a function of one variable")
    }
}
