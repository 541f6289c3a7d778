//! Degrees of freedom, independent coordinates and redundant rows.
//!
//! All from the scaled Φ_q at one configuration. The columns that a column-pivoted factorisation of the rows that do
//! not drive takes as pivots are the dependent coordinates u; those it leaves are the independent ones w. Columns are
//! weighted before, so that coordinates that driving rows mention are taken last, then angles.
//!
//! Rows of velocity level take velocities away, not positions: a car reaches every place of the plane although it moves
//! in one way at a time. So degrees of freedom are counted on both levels: of velocity, with all rows (B stands in Φ_q),
//! and of position, with the rows of position level alone, which is the dimension of the space of configurations.
//! Without rows of velocity level the two are the same.

use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::{Dependency, Factorization, dependencies, null_space};
use crate::model::{Component, CoordinateKind, Level};
use crate::scale::Scale;
use crate::workspace::Subset;
use core::fmt;
use nalgebra::{ColPivQR, DMatrix};

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
    /// δ = n − rank without driving rows, rows of velocity level included.
    pub degrees_of_freedom: usize,
    /// n − rank of all rows; 0 when fully driven.
    pub degrees_of_freedom_left: usize,
    /// Rank of the rows of position level, prescribed coordinates included.
    pub position_rank: usize,
    /// Rank of the rows of position level that do not drive.
    pub position_rank_without_driving: usize,
    /// n − rank of the rows of position level without driving rows: the dimension of the space of configurations.
    /// Never less than [`degrees_of_freedom`](Self::degrees_of_freedom).
    pub position_degrees_of_freedom: usize,
    /// n − rank of the rows of position level: how much of a position its equations leave open, so that the start of
    /// the motion decides it.
    pub position_degrees_of_freedom_left: usize,
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

impl fmt::Display for Mobility {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} coordinates, {} rows ({} driving), rank {}: {} degrees of freedom, {} left",
            self.coordinates,
            self.rows,
            self.driving_rows,
            self.rank,
            self.degrees_of_freedom,
            self.degrees_of_freedom_left
        )?;
        if self.velocity_level_rows > 0 {
            write!(
                f,
                "; of position: {} degrees of freedom, {} left ({} rows of velocity level)",
                self.position_degrees_of_freedom, self.position_degrees_of_freedom_left, self.velocity_level_rows
            )?;
        }
        for row in &self.redundant {
            let verb = if row.consistent { "repeats" } else { "contradicts" };
            write!(f, "; row `{}` of joint `{}` {verb} {}", row.name, row.joint, row.circuit.join(", "))?;
        }
        Ok(())
    }
}

/// Weight of a column that a driving row mentions, when dependent coordinates are chosen.
const DRIVEN: f64 = 1e-4;
/// Weight of an angle or scalar.
const ANGLE: f64 = 1e-2;
/// Components of null vectors below this do not move.
const MOVES: f64 = 1e-6;

/// The mobility at q.
pub(crate) fn mobility(equations: &mut Equations<'_>, q: &[f64]) -> Result<Mobility, SolveError> {
    equations.check("q", q)?;
    equations.scale = Scale::around(equations, q);
    equations.evaluate(Subset { phi: true, ..Subset::VELOCITY }, q, None)?;
    let n = equations.coordinates();
    let tolerance = equations.options.rank_tolerance;
    let all: Vec<usize> = (0..equations.rows()).collect();
    let passive = equations.rows_where(|e, row| !e.drives(row));
    let rank_of = |rows: &[usize]| {
        Factorization::absolute(&equations.scaled_rows(rows), &equations.scale.columns, tolerance).rank
    };
    let (rank, rank_without_driving) = (rank_of(&all), rank_of(&passive));
    let position_rank = rank_of(&equations.rows_where(Equations::holonomic));
    let position_rank_without_driving = rank_of(&equations.rows_where(|e, row| e.holonomic(row) && !e.drives(row)));
    let scaled = equations.scaled(&all);
    let (dependent, independent) = choose(equations, &passive, rank_without_driving);
    let mut singular_values = singular_values(&scaled);
    singular_values.truncate(all.len().min(n));
    let condition = match (singular_values.first(), rank.checked_sub(1).and_then(|k| singular_values.get(k))) {
        (Some(largest), Some(smallest)) => largest / smallest,
        _ => 1.0,
    };
    let free = null_space(&scaled, tolerance);
    Ok(Mobility {
        coordinates: n,
        rows: equations.model.rows.len(),
        driving_rows: equations.model.rows.iter().filter(|r| r.driving).count(),
        velocity_level_rows: equations.model.rows.iter().filter(|r| r.level == Level::Velocity).count(),
        rank,
        rank_without_driving,
        degrees_of_freedom: n - rank_without_driving,
        degrees_of_freedom_left: n - rank,
        position_rank,
        position_rank_without_driving,
        position_degrees_of_freedom: n - position_rank_without_driving,
        position_degrees_of_freedom_left: n - position_rank,
        independent,
        dependent,
        redundant: dependencies(&scaled, tolerance).into_iter().map(|d| redundant(equations, d)).collect(),
        singular_values,
        condition,
        could_be_given: (0..n).filter(|&k| free.ncols() > 0 && free.row(k).amax() > MOVES).collect(),
    })
}

/// Singular values, largest first.
fn singular_values(matrix: &DMatrix<f64>) -> Vec<f64> {
    if matrix.is_empty() {
        return Vec::new();
    }
    let mut values: Vec<f64> = matrix.singular_values().iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// Dependent and independent coordinates, each in order.
fn choose(equations: &Equations<'_>, passive: &[usize], rank: usize) -> (Vec<usize>, Vec<usize>) {
    let n = equations.coordinates();
    let mut matrix = equations.scaled(passive);
    let driving = equations.rows_where(|e, row| e.drives(row));
    for k in 0..n {
        let mut weight = 1.0;
        if driving.iter().any(|&row| equations.jacobian[(row, k)] != 0.0) {
            weight *= DRIVEN;
        }
        let length = matches!(
            equations.model.coordinates[k].kind,
            CoordinateKind::Pose { component: Component::X | Component::Y, .. }
        );
        if !length {
            weight *= ANGLE;
        }
        matrix.column_mut(k).scale_mut(weight);
    }
    let mut order = DMatrix::from_fn(1, n, |_, j| j as f64);
    if !matrix.is_empty() {
        ColPivQR::new(matrix).p().permute_columns(&mut order);
    }
    let order: Vec<usize> = order.iter().map(|&k| k as usize).collect();
    let (mut dependent, mut independent) = (order[..rank].to_vec(), order[rank..].to_vec());
    dependent.sort_unstable();
    independent.sort_unstable();
    (dependent, independent)
}

/// A dependency by names; consistent if position and velocity of the row are what the others imply.
fn redundant(equations: &Equations<'_>, dependency: Dependency) -> RedundantRow {
    let Dependency { row, combination } = dependency;
    let joint = equations.joint_name(row);
    let mut circuit: Vec<&'static str> = Vec::new();
    for &(other, _) in &combination {
        let name = equations.joint_name(other);
        if name != joint && !circuit.contains(&name) {
            circuit.push(name);
        }
    }
    let agrees = |values: &nalgebra::DVector<f64>, floor: f64| {
        let at = |k: usize| values[k] * equations.scale.rows[k];
        let implied: f64 = combination.iter().map(|&(k, factor)| factor * at(k)).sum();
        let size = combination.iter().map(|&(k, factor)| (factor * at(k)).abs()).fold(at(row).abs(), f64::max);
        (at(row) - implied).abs() <= equations.options.consistency_tolerance * size.max(floor)
    };
    // Where rows of velocity level take part, positions imply nothing.
    let of_position = equations.holonomic(row) && combination.iter().all(|&(other, _)| equations.holonomic(other));
    let consistent = (!of_position || agrees(&equations.phi, 1.0)) && agrees(&equations.phi_t, f64::MIN_POSITIVE);
    RedundantRow { row, name: equations.row_name(row), joint, circuit, consistent }
}
