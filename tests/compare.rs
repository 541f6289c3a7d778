//! Comparison of numbers with failure messages that say what differs, where, and by how much.

use kin_runtime::{Motion, State};
use std::fmt::Display;

/// The largest magnitude of `values`; 0 when there are none.
#[must_use]
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// Collects differences, and reports all of them together.
#[derive(Debug, Default)]
pub struct Differences {
    place: String,
    found: Vec<String>,
    compared: usize,
}

impl Differences {
    /// A collection without differences.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the description (case, mode, instant) with which the next differences are reported.
    pub fn at(&mut self, place: impl Display) {
        self.place = place.to_string();
    }

    /// Reports a failure that is not a difference of numbers.
    pub fn report(&mut self, what: impl Display) {
        self.found.push(format!("{}: {what}", self.place));
    }

    /// Reports a difference unless `found` equals `expected`.
    pub fn equal<T: PartialEq + std::fmt::Debug>(&mut self, what: impl Display, expected: T, found: T) {
        self.compared += 1;
        if expected != found {
            self.report(format_args!("{what}: expected {expected:?}, found {found:?}"));
        }
    }

    /// Reports a difference unless |found − expected| ≤ `tolerance`; NaN always differs.
    pub fn number(&mut self, what: impl Display, expected: f64, found: f64, tolerance: f64) {
        self.compared += 1;
        let difference = (found - expected).abs();
        if difference.is_nan() || difference > tolerance {
            self.report(format_args!(
                "{what}: expected {expected:e}, found {found:e}, difference {difference:.3e} > {tolerance:.1e}"
            ));
        }
    }

    /// Compares two vectors entry by entry with the same tolerance; `name` gives the name of an entry from its index.
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

    /// Fails if there were differences, or if nothing was compared.
    ///
    /// # Panics
    /// If there were differences.
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

/// Asserts that the bodies and points in a state agree with its motion.
///
/// They agree up to rounding: the rate of an observable is computed as a sum of products, while that of a coordinate is
/// read from the state.
#[track_caller]
pub fn assert_shows(state: &State, motion: &Motion) {
    let same = |what: &dyn Display, shown: [f64; 3], expected: [f64; 3]| {
        for (a, b) in shown.iter().zip(expected) {
            let tolerance = 1e-12 * b.abs().max(1.0);
            assert!((a - b).abs() <= tolerance, "{what} at t = {}: {shown:?} and {expected:?}", state.t);
        }
    };
    assert_eq!((state.bodies.len(), state.points.len()), (motion.bodies.len(), motion.points.len()));
    for ((shown, expected), info) in state.bodies.iter().zip(&motion.bodies).zip(motion.model.bodies) {
        same(&info.name, [shown.x, shown.y, shown.phi], [expected.x, expected.y, expected.phi]);
        same(&info.name, shown.velocity().into(), expected.velocity().into());
        same(&info.name, shown.acceleration().into(), expected.acceleration().into());
    }
    for ((shown, expected), info) in state.points.iter().zip(&motion.points).zip(motion.model.points) {
        for axis in 0..2 {
            let of = |p: &kin_runtime::PointMotion| [p.r[axis], p.v[axis], p.a[axis]];
            same(&info.name, of(shown), of(expected));
        }
    }
}
