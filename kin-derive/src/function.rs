//! The functions of the language at numbers.

use kin_core::mechanism::Function;

/// The value of `function` at `a`; NaN or infinite where it has none.
pub(crate) fn value(function: Function, a: f64) -> f64 {
    match function {
        Function::Sin => a.sin(),
        Function::Cos => a.cos(),
        Function::Tan => a.tan(),
        Function::Asin => a.asin(),
        Function::Acos => a.acos(),
        Function::Atan => a.atan(),
        Function::Sqrt => a.sqrt(),
        Function::Exp => a.exp(),
        Function::Ln => a.ln(),
        Function::Abs => a.abs(),
    }
}
