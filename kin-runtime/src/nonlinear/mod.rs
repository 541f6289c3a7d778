//! Numerical methods that are independent of mechanisms: Newton's iteration, roots in brackets, Runge–Kutta steps.

pub(crate) mod dormand_prince;
pub(crate) mod newton;
#[cfg(any(feature = "cli", feature = "design"))]
pub(crate) mod peak;
pub(crate) mod root;
