//! Comparing numbers so that a failure says what differs, where, and by how much.

use std::fmt::Display;

/// The largest magnitude of `values`; 0 when there are none.
#[must_use]
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// Collects differences, and fails with all of them at once.
#[derive(Debug, Default)]
pub struct Differences {
    place: String,
    found: Vec<String>,
    compared: usize,
}

impl Differences {
    /// None so far.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the place that the next differences are reported with: case, mode, instant.
    pub fn at(&mut self, place: impl Display) {
        self.place = place.to_string();
    }

    /// Reports something that is not a comparison of numbers.
    pub fn report(&mut self, what: impl Display) {
        self.found.push(format!("{}: {what}", self.place));
    }

    /// Reports unless `found` is `expected`.
    pub fn equal<T: PartialEq + std::fmt::Debug>(&mut self, what: impl Display, expected: T, found: T) {
        self.compared += 1;
        if expected != found {
            self.report(format_args!("{what}: expected {expected:?}, found {found:?}"));
        }
    }

    /// Reports unless |found − expected| ≤ `tolerance`. NaN always differs.
    pub fn number(&mut self, what: impl Display, expected: f64, found: f64, tolerance: f64) {
        self.compared += 1;
        let difference = (found - expected).abs();
        if difference.is_nan() || difference > tolerance {
            self.report(format_args!(
                "{what}: expected {expected:e}, found {found:e}, difference {difference:.3e} > {tolerance:.1e}"
            ));
        }
    }

    /// Compares entry by entry, each to `tolerance`; `name` names an entry by its place.
    pub fn vector<N: Display>(
        &mut self,
        what: &str,
        name: impl Fn(usize) -> N,
        expected: &[f64],
        found: &[f64],
        tolerance: f64,
    ) {
        self.equal(format_args!("length of {what}"), expected.len(), found.len());
        for (place, (&expected, &found)) in expected.iter().zip(found).enumerate() {
            self.number(format_args!("{what} of {}", name(place)), expected, found, tolerance);
        }
    }

    /// Fails when there were differences, or nothing was compared.
    ///
    /// # Panics
    /// That is its purpose.
    pub fn finish(self) {
        let shown = 40;
        assert!(
            self.found.is_empty(),
            "{} differences in {} comparisons:\n{}",
            self.found.len(),
            self.compared,
            self.found.iter().take(shown).cloned().collect::<Vec<_>>().join("\n")
        );
        assert!(self.compared > 0, "nothing was compared");
    }
}
