//! What a cross-check has found.

use super::functions::FunctionCheck;
use core::fmt;

/// The entry with the largest error.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WorstEntry {
    /// `Φ_q`, `Φ_t` or `γ`.
    pub matrix: &'static str,
    /// Row.
    pub row_name: &'static str,
    /// Column of Φ_q; empty for Φ_t and γ.
    pub column_name: &'static str,
    /// The closed form's value.
    pub closed_form: f64,
    /// The dual numbers' value.
    pub automatic: f64,
    /// The error, see [`CrossCheck::max_error`].
    pub error: f64,
    /// q of that configuration.
    pub q: Vec<f64>,
    /// q̇ of that configuration.
    pub q_dot: Vec<f64>,
    /// Time of that configuration.
    pub t: f64,
}

/// Result of a cross-check.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CrossCheck {
    /// Configurations compared.
    pub configurations: usize,
    /// Configurations skipped because Φ itself is not finite there.
    pub skipped: usize,
    /// Numbers compared.
    pub entries: usize,
    /// The entry with the largest error; without names where a mechanism has no rows.
    pub worst: WorstEntry,
    /// Largest error over all entries: |closed form − automatic|, relative to the largest entry of that row of Φ_q,
    /// to Φ_t, or to γ (or that row of Φ_q times the largest q̇ squared, if larger), but to no less than one. Whatever
    /// is not a number has an infinite error.
    pub max_error: f64,
    /// Every supplied function that is evaluated: f, f′ and f″ against one another, by differences.
    pub functions: Vec<FunctionCheck>,
}

impl CrossCheck {
    /// True when no error exceeds `tolerance`, and no supplied function differs from its own differences by more than
    /// these can tell ([`FunctionCheck::TOLERANCE`], or `tolerance` if that is larger).
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
        write!(f, "{} entries at {} configurations", self.entries, self.configurations)?;
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

/// `error 4.1e-17 in γ[B.x] at t = 0: closed form …, automatic …`.
impl fmt::Display for WorstEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error {:.1e} in {}[{}", self.error, self.matrix, self.row_name)?;
        if !self.column_name.is_empty() {
            write!(f, ", {}", self.column_name)?;
        }
        write!(f, "] at t = {}: closed form {}, automatic {}", self.t, self.closed_form, self.automatic)
    }
}
