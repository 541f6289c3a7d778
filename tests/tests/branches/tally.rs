//! Counts of verdicts over many motions, and the condition that they must satisfy.

use crate::case::Verdict;
use crate::ways::WAYS;
use std::fmt::Write;

/// The number of sweeps in a usual run, for all families together; `KIN_SWEEPS` sets another number.
const USUAL: f64 = 1500.0;

/// The number of motions for a family with this share of all sweeps; each motion is followed by all methods.
pub(crate) fn motions(share: f64) -> usize {
    let asked = std::env::var("KIN_SWEEPS").ok().and_then(|number| number.parse().ok());
    (share * asked.unwrap_or(USUAL) / WAYS.len() as f64).ceil() as usize
}

/// The counts by method and verdict, with the first case of every undesired verdict.
#[derive(Default)]
pub(crate) struct Tally {
    counts: [[usize; 5]; WAYS.len()],
    first: Vec<(usize, Verdict, String)>,
}

impl Tally {
    pub(crate) fn count(&mut self, way: usize, verdict: Verdict, words: impl FnOnce() -> String) {
        let count = &mut self.counts[way][verdict as usize];
        *count += 1;
        if *count == 1 && verdict > Verdict::Refused {
            self.first.push((way, verdict, words()));
        }
    }

    /// Asserts that no state is wrong, and that less than one motion in a hundred is refused unnecessarily.
    #[track_caller]
    pub(crate) fn obeys(&self, family: &str) {
        let mut table = format!("{family}: right, refused in place, refused early, inexact, on another branch\n");
        let mut bad = false;
        for (name, counts) in WAYS.iter().zip(&self.counts) {
            let [.., early, inexact, flips] = counts;
            let all: usize = counts.iter().sum();
            bad |= inexact + flips > 0 || 100 * early >= all.max(1);
            let _ = writeln!(table, "  {name:14} {counts:?} of {all}");
        }
        for (way, verdict, words) in &self.first {
            let _ = writeln!(table, "  first {verdict:?} of {}: {words}", WAYS[*way]);
        }
        assert!(!bad, "{table}");
    }
}
