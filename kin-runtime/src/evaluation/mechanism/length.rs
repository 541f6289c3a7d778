//! The error for arguments of the wrong length.

/// An argument has the wrong number of entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthError {
    /// The name of the argument.
    pub what: &'static str,
    /// The number of entries that it must have.
    pub expected: usize,
    /// The number of entries that it has.
    pub found: usize,
}

impl core::fmt::Display for LengthError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let entries = if self.found == 1 { "entry" } else { "entries" };
        write!(f, "{} has {} {entries} and must have {}", self.what, self.found, self.expected)?;
        if self.what == "inputs" && self.found == 0 {
            f.write_str("; pass inputs in `Instant::inputs`, and for sweeps by `Solver::with_inputs`")?;
        }
        Ok(())
    }
}

impl core::error::Error for LengthError {}

/// Checks that a list is empty: the default implementation of methods that write a list which the mechanism does not
/// have.
pub(super) const fn empty<T>(what: &'static str, list: &[T]) -> Result<(), LengthError> {
    match list.len() {
        0 => Ok(()),
        found => Err(LengthError { what, expected: 0, found }),
    }
}
