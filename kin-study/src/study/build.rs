//! Studies written in Rust.

use super::{Closures, Histogram, Ramp, Study};
use crate::sampling::{Range, Sampling};
use crate::scores::Score;
use kin_runtime::Sign;
use std::fmt;

impl Study {
    /// An empty study.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of sets of dimensions; a grid determines it by its lists.
    #[must_use]
    pub fn rows(mut self, rows: u64) -> Self {
        self.rows = Some(rows);
        self
    }

    /// The seed of the random numbers, 0 by default.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// How values are chosen from the ranges.
    #[must_use]
    pub fn sampling(mut self, sampling: Sampling) -> Self {
        self.sampling = sampling;
        self
    }

    /// The range of a parameter; parameters without a range keep their defaults. A name that is no parameter of the
    /// mechanism is a column that formulas may use.
    #[must_use]
    pub fn parameter(mut self, name: &str, range: Range) -> Self {
        self.parameters.push((name.to_owned(), range));
        self
    }

    /// A parameter, or a column for later formulas, given by an SQL expression of the columns before it.
    #[must_use]
    pub fn derived(mut self, name: &str, formula: &str) -> Self {
        self.derived.push((name.to_owned(), formula.to_owned()));
        self
    }

    /// A condition on parameters and derived columns, an SQL expression: rows that do not meet it are not solved.
    #[must_use]
    pub fn condition(mut self, condition: &str) -> Self {
        self.before.push(condition.to_owned());
        self
    }

    /// A condition on a row with its scores, an SQL expression: rows that do not meet it are not kept. The scores of a
    /// row whose motion ended early are null, and comparisons with null are not met.
    #[must_use]
    pub fn keep_where(mut self, condition: &str) -> Self {
        self.after.push(condition.to_owned());
        self
    }

    /// The motion from one instant to another, `steps` + 1 instants.
    #[must_use]
    pub fn turn(mut self, from: f64, to: f64, steps: usize) -> Self {
        self.times = grid(from, to, steps);
        self
    }

    /// The motion at these instants.
    #[must_use]
    pub fn times(mut self, times: &[f64]) -> Self {
        self.times = times.to_vec();
        self
    }

    /// The values of an input over the motion.
    #[must_use]
    pub fn input(mut self, name: &str, ramp: Ramp) -> Self {
        self.inputs.push((name.to_owned(), ramp));
        self
    }

    /// The sign of an assembly mode; all other modes have the signs of the guess.
    #[must_use]
    pub fn mode(mut self, name: &str, sign: Sign) -> Self {
        let mut signs = match self.modes {
            Closures::Signs(signs) => signs,
            _ => Vec::new(),
        };
        signs.push((name.to_owned(), sign));
        self.modes = Closures::Signs(signs);
        self
    }

    /// Every combination of the signs of all modes, a row for each.
    #[must_use]
    pub fn all_modes(mut self) -> Self {
        self.modes = Closures::All;
        self
    }

    /// A score, in a column of this name.
    #[must_use]
    pub fn score(mut self, name: &str, score: Score) -> Self {
        self.scores.push((name.to_owned(), score));
        self
    }

    /// Keeps only the best rows, in an order as SQL writes it: `swing desc, l2`.
    #[must_use]
    pub fn keep_best(mut self, count: usize, by: &str) -> Self {
        self.best = Some((count, by.to_owned()));
        self
    }

    /// Counts how often the values of a column fall into each of several intervals, over all rows that meet all
    /// conditions.
    #[must_use]
    pub fn histogram(mut self, histogram: Histogram) -> Self {
        self.histograms.push(histogram);
        self
    }

    /// The line of an entry in the file of the study, if it was read from one.
    pub(crate) fn line(&self, place: &str) -> Option<usize> {
        self.lines.get(place).copied()
    }

    /// Keeps no rows, only histograms.
    #[must_use]
    pub fn keep_no_rows(mut self) -> Self {
        self.no_rows = true;
        self
    }
}

/// Equal steps from one instant to another.
pub(super) fn grid(from: f64, to: f64, steps: usize) -> Vec<f64> {
    let last = steps.max(1) as f64;
    (0..=steps).map(|k| if k == steps && k > 0 { to } else { from + (to - from) * (k as f64 / last) }).collect()
}

/// Everything that determines the results: two studies with the same text have the same rows.
impl fmt::Debug for Study {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Study")
            .field("rows", &self.rows)
            .field("seed", &self.seed)
            .field("sampling", &self.sampling)
            .field("parameters", &self.parameters)
            .field("derived", &self.derived)
            .field("before", &self.before)
            .field("after", &self.after)
            .field("times", &self.times)
            .field("modes", &self.modes)
            .field("inputs", &self.inputs)
            .field("scores", &self.scores)
            .field("best", &self.best)
            .field("histograms", &self.histograms)
            .field("no_rows", &self.no_rows)
            .finish()
    }
}

impl fmt::Display for Study {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counted = |count: usize, noun: &str| match count {
            1 => format!("1 {noun}"),
            count => format!("{count} {noun}s"),
        };
        let [parameters, scores, instants] =
            [(self.parameters.len(), "parameter"), (self.scores.len(), "score"), (self.times.len(), "instant")]
                .map(|(count, noun)| counted(count, noun));
        write!(f, "a study of {parameters} and {scores} at {instants}")
    }
}
