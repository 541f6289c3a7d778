//! Counts of the operations of programs.

use core::fmt;

/// The operations of a program, for example of one combined evaluation of Φ, Φ_q, Φ_t and γ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OperationCount {
    /// Additions and subtractions.
    pub add: usize,
    /// Multiplications.
    pub mul: usize,
    /// Negations.
    pub neg: usize,
    /// Divisions.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Sine and cosine pairs.
    pub sincos: usize,
    /// Every other function (tan, atan2, exp, powers with an exponent that is not a small integer, …).
    pub function: usize,
}

impl OperationCount {
    /// Additions, multiplications, negations and divisions.
    pub const fn flops(&self) -> usize {
        self.add + self.mul + self.neg + self.div
    }
}

/// `50: 19 mul, 24 add, 4 neg, 3 sincos`; operations that do not occur are left out.
impl fmt::Display for OperationCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { add, mul, neg, div, sqrt, sincos, function } = *self;
        let names = ["mul", "add", "neg", "div", "sqrt", "sincos", "function"];
        let counts = [mul, add, neg, div, sqrt, sincos, function];
        write!(f, "{}", counts.iter().sum::<usize>())?;
        let occurring = counts.iter().zip(names).filter(|(count, _)| **count > 0);
        occurring
            .enumerate()
            .try_for_each(|(k, (count, operation))| write!(f, "{} {count} {operation}", if k == 0 { ":" } else { "," }))
    }
}
