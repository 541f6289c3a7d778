//! The result of a cross-check.

use super::functions::FunctionCheck;
use core::fmt;

/// The number with the largest error.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WorstEntry {
    /// The quantity: `Φ_q`, `Φ_t` or `γ`; for a plan `Φ`, `Φ_q q̇ = −Φ_t` or `Φ_q q̈ = γ`, or `q`, `q̇` or `q̈`.
    pub matrix: &'static str,
    /// The row, or the coordinate in the case of q, q̇ and q̈.
    pub row_name: &'static str,
    /// The column of Φ_q; empty for everything else.
    pub column_name: &'static str,
    /// The value of the closed form, or by the plan; for an equation its residual.
    pub found: f64,
    /// The value by dual numbers, or by full Newton; for an equation 0.
    pub expected: f64,
    /// The error, see [`CrossCheck::max_error`].
    pub error: f64,
    /// q of that configuration.
    pub q: Vec<f64>,
    /// q̇ of that configuration.
    pub q_dot: Vec<f64>,
    /// Time of that configuration.
    pub t: f64,
}

/// The result of a comparison: of closed forms with dual numbers, or of the plan with the equations and with full
/// Newton.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CrossCheck {
    /// The number of configurations compared.
    pub configurations: usize,
    /// The number of configurations skipped: Φ is not finite there, or the plan has no solution away from limits.
    pub skipped: usize,
    /// The number of values compared.
    pub entries: usize,
    /// The value with the largest error; without names where nothing was compared.
    pub worst: WorstEntry,
    /// The largest error of all values, |found − expected|. It is relative to the largest entry of that row of Φ_q, to
    /// Φ_t, or to γ (or that row of Φ_q times the largest q̇ squared, if that is larger), but at least to one. For an
    /// equation it is relative to the largest of its terms, which in the acceleration equation are coefficients times
    /// an acceleration or times two rates; for q, q̇ and q̈ to the largest number of the vector, but at least to one.
    /// The error of NaN is infinite.
    pub max_error: f64,
    /// For every supplied function that is evaluated, the comparison of f, f′ and f″ with one another by differences.
    /// Empty for a plan, which evaluates the same functions.
    pub functions: Vec<FunctionCheck>,
}

impl CrossCheck {
    /// A result without any comparison.
    pub(super) fn new() -> Self {
        let (matrix, row_name, column_name) = ("", "", "");
        let (q, q_dot) = (Vec::new(), Vec::new());
        let worst =
            WorstEntry { matrix, row_name, column_name, found: 0.0, expected: 0.0, error: -1.0, q, q_dot, t: 0.0 };
        Self { configurations: 0, skipped: 0, entries: 0, worst, max_error: 0.0, functions: Vec::new() }
    }

    /// Adds one compared value; NaN counts as an infinite error.
    pub(super) fn add(
        &mut self,
        [matrix, row_name, column_name]: [&'static str; 3],
        [found, expected]: [f64; 2],
        error: f64,
        (t, q, q_dot): (f64, &[f64], &[f64]),
    ) {
        self.entries += 1;
        let error = if error.is_finite() { error } else { f64::INFINITY };
        if error > self.worst.error {
            self.max_error = error;
            let (q, q_dot) = (q.to_vec(), q_dot.to_vec());
            self.worst = WorstEntry { matrix, row_name, column_name, found, expected, error, q, q_dot, t };
        }
    }

    /// True when no error exceeds `tolerance`, and no supplied function differs from its difference quotients by more
    /// than these can resolve ([`FunctionCheck::TOLERANCE`], or `tolerance` if that is larger).
    pub fn passes(&self, tolerance: f64) -> bool {
        let of_functions = tolerance.max(FunctionCheck::TOLERANCE);
        self.max_error <= tolerance && self.functions.iter().all(|function| function.error <= of_functions)
    }

    /// The supplied function with the largest error.
    pub fn worst_function(&self) -> Option<&FunctionCheck> {
        self.functions.iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }
}

impl fmt::Display for CrossCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} numbers at {} configurations", self.entries, self.configurations)?;
        if self.skipped > 0 {
            write!(f, " ({} skipped)", self.skipped)?;
        }
        write!(f, ": worst {}", self.worst)?;
        match self.worst_function() {
            Some(function) => write!(f, "; function {function}"),
            None => Ok(()),
        }
    }
}

/// For example `error 4.1e-17 in γ[B.x] at t = 0: … instead of …`.
impl fmt::Display for WorstEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error {:.1e} in {}[{}", self.error, self.matrix, self.row_name)?;
        if !self.column_name.is_empty() {
            write!(f, ", {}", self.column_name)?;
        }
        write!(f, "] at t = {}: {} instead of {}", self.t, self.found, self.expected)
    }
}
