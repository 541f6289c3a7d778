//! Closed forms held against dual numbers.

use core::fmt;

/// How a cross-check chooses its configurations.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossCheckOptions {
    /// Number of random configurations.
    pub configurations: usize,
    /// Seed of the random numbers; the same seed gives the same configurations.
    pub seed: u64,
    /// Configurations of the caller, compared before the random ones.
    pub given: Vec<Configuration>,
    /// Also perturb the parameters, by up to ten per cent.
    pub perturb_parameters: bool,
}

impl Default for CrossCheckOptions {
    fn default() -> Self {
        Self { configurations: 32, seed: 0x6b69_6e00, given: Vec::new(), perturb_parameters: true }
    }
}

/// A configuration to compare at; it need not be assembled.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Time.
    pub t: f64,
    /// q, n numbers.
    pub q: Vec<f64>,
    /// q̇, n numbers.
    pub q_dot: Vec<f64>,
    /// The inputs; empty where the mechanism has none.
    pub inputs: Vec<crate::workspace::Signal>,
}

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
    /// Largest error over all entries.
    pub max_error: f64,
}

impl CrossCheck {
    /// True when no error exceeds `tolerance`.
    pub fn passes(&self, tolerance: f64) -> bool {
        self.max_error <= tolerance
    }
}

impl fmt::Display for CrossCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} entries at {} configurations", self.entries, self.configurations)?;
        if self.skipped > 0 {
            write!(f, " ({} skipped)", self.skipped)?;
        }
        let worst = &self.worst;
        write!(f, ": worst error {:.1e} in {}[{}", worst.error, worst.matrix, worst.row_name)?;
        if !worst.column_name.is_empty() {
            write!(f, ", {}", worst.column_name)?;
        }
        write!(f, "] at t = {}: closed form {}, automatic {}", worst.t, worst.closed_form, worst.automatic)
    }
}
