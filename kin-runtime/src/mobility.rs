//! Degrees of freedom, independent coordinates and redundant rows.

/// A row that the rows declared before it already imply.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RedundantRow {
    /// Place in Φ.
    pub row: usize,
    /// Its name.
    pub name: &'static str,
    /// Its joint.
    pub joint: &'static str,
    /// The other joints of the dependency, in order of declaration.
    pub circuit: Vec<&'static str>,
    /// False when the row contradicts the others instead of repeating them.
    pub consistent: bool,
}

/// What can move, and what is said twice, in one configuration.
///
/// Ranks are those of the scaled Φ_q (see [`Options::rank_tolerance`](crate::Options::rank_tolerance)).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Mobility {
    /// n.
    pub coordinates: usize,
    /// s, prescribed coordinates not counted.
    pub rows: usize,
    /// Driving rows: declared by `driver` or `speed`, or rheonomic.
    pub driving_rows: usize,
    /// Rows of velocity level.
    pub velocity_level_rows: usize,
    /// Rank of all rows, prescribed coordinates included.
    pub rank: usize,
    /// Rank of the rows that do not drive.
    pub rank_without_driving: usize,
    /// δ = n − rank without driving rows.
    pub degrees_of_freedom: usize,
    /// n − rank of all rows; 0 when fully driven.
    pub degrees_of_freedom_left: usize,
    /// w: independent coordinates, δ of them, places in q.
    pub independent: Vec<usize>,
    /// u: dependent coordinates.
    pub dependent: Vec<usize>,
    /// Rows that earlier ones imply.
    pub redundant: Vec<RedundantRow>,
    /// Singular values of the scaled Φ_q, largest first.
    pub singular_values: Vec<f64>,
    /// Largest over smallest singular value within the rank.
    pub condition: f64,
    /// Coordinates that still move, so that each of them could be given.
    pub could_be_given: Vec<usize>,
}
