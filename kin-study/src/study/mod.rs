//! A study: its designs, their motion, the scores, and the rows that are kept.

mod build;
mod read;
mod write;

use crate::sampling::{Range, Sampling};
use crate::scores::Score;
use kin_runtime::Sign;
use std::collections::BTreeMap;

/// A study: its designs, their motion, the scores, and the rows that are kept.
///
/// ```
/// use kin_study::{Range, Score, Study};
///
/// let study = Study::new()
///     .rows(1000)
///     .parameter("l2", Range::Uniform { from: 0.3, to: 0.6 })
///     .parameter("l3", Range::steps(0.25, 0.35, 3))
///     .condition("l2 > l3")
///     .turn(0.0, 6.28, 99)
///     .score("swing", Score::Range("rocker.phi".into()))
///     .keep_best(10, "swing desc");
/// assert_eq!(study.to_string(), "a study of 2 parameters and 1 score at 100 instants");
/// ```
///
/// The same as a file, [`Study::from_toml`]:
///
/// ```
/// # let text = r#"
/// rows = 1000
///
/// [parameters]
/// l2 = { from = 0.3, to = 0.6 }
/// l3 = { from = 0.25, to = 0.35, values = 3 }
///
/// [conditions]
/// before = ["l2 > l3"]
///
/// [motion]
/// to = 6.28
/// steps = 99
///
/// [scores]
/// swing = { range = "rocker.phi" }
///
/// [keep]
/// best = 10
/// by = "swing desc"
/// # "#;
/// # let study = kin_study::Study::from_toml(text).expect("it makes sense");
/// # assert_eq!(study.to_string(), "a study of 2 parameters and 1 score at 100 instants");
/// ```
#[derive(Clone, Default)]
pub struct Study {
    pub(crate) rows: Option<u64>,
    pub(crate) seed: u64,
    pub(crate) sampling: Sampling,
    pub(crate) parameters: Vec<(String, Range)>,
    pub(crate) derived: Vec<(String, String)>,
    pub(crate) before: Vec<String>,
    pub(crate) after: Vec<String>,
    pub(crate) times: Vec<f64>,
    pub(crate) modes: Closures,
    pub(crate) inputs: Vec<(String, Ramp)>,
    pub(crate) scores: Vec<(String, Score)>,
    pub(crate) best: Option<(usize, String)>,
    pub(crate) histograms: Vec<Histogram>,
    /// Only histograms are kept.
    pub(crate) no_rows: bool,
    /// The lines of the entries of a file: of a parameter by `parameters.l2`, of a condition by `conditions.before.0`.
    pub(crate) lines: BTreeMap<String, usize>,
}

/// The closures of a mechanism that a study computes.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Closures {
    /// The closure that the mechanism's guess leads to, with its default dimensions and the fixed ones of the study.
    #[default]
    OfGuess,
    /// The same with these signs of the modes with these names.
    Signs(Vec<(String, Sign)>),
    /// Every combination of signs: a row for each for every set of dimensions, distinguished by the column `mode`.
    All,
}

/// An input of the mechanism over the motion: it changes from one value to another at a constant rate. At a single instant
/// it has the first value and rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// Its value at the first instant.
    pub from: f64,
    /// Its value at the last instant.
    pub to: f64,
}

/// How often the values of a column fall into each of several intervals of the same width.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// A parameter, a derived column or a score.
    pub of: String,
    /// The lower end of the first interval.
    pub from: f64,
    /// The upper end of the last interval; numbers outside are counted in the first or the last.
    pub to: f64,
    /// How many intervals there are.
    pub bins: usize,
}
