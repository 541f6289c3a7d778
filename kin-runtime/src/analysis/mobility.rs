//! Degrees of freedom, independent coordinates and redundant rows.
//!
//! All results come from the scaled Φ_q at one configuration. The pivot columns of a column-pivoted factorisation of
//! the rows that do not drive are the dependent coordinates u; the other columns are the independent coordinates w.
//! Columns are weighted first, so that coordinates in driving rows become pivots last, and angles before them.
//!
//! Rows of velocity level restrict velocities, not positions: a car reaches every pose in the plane, although it cannot
//! move sideways. So degrees of freedom are counted on both levels: of velocity, with all rows (Φ_q includes B), and of
//! position, with the rows of position level alone, which is the dimension of the space of configurations. Without rows
//! of velocity level the two are the same.
//!
//! The symbolic equations give ranks at a general pose and for general dimensions
//! ([`Structure`](crate::model::Structure)). Rows that are redundant beyond these are so because of the dimensions, or
//! in this configuration only.

use crate::analysis::singular::rank_nearby;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::{Dependency, Factorization, dependencies, null_space};
use crate::model::Level;
use crate::workspace::Subset;
use core::fmt;
use nalgebra::{ColPivQR, DMatrix};

/// Why a row is redundant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Cause {
    /// Because of the equations themselves: at every pose, whatever the dimensions.
    Structure,
    /// Because of these dimensions: not in general, but everywhere around this configuration.
    Dimensions,
    /// In this configuration only, which is singular.
    Configuration,
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Structure => "whatever the dimensions",
            Self::Dimensions => "because of the dimensions",
            Self::Configuration => "in this singular configuration",
        })
    }
}

/// A row that other rows imply: the last one of a set of dependent rows, in order of declaration, with driving rows
/// after all others and prescribed coordinates after these.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RedundantRow {
    /// Index in Φ.
    pub row: usize,
    /// Its name.
    pub name: &'static str,
    /// Its joint.
    pub joint: &'static str,
    /// The other joints of the dependency, in order of declaration.
    pub circuit: Vec<&'static str>,
    /// False when the row contradicts the others instead of repeating them.
    pub consistent: bool,
    /// The cause; `None` if the model has no structural analysis.
    pub cause: Option<Cause>,
}

/// Degrees of freedom and redundant rows in one configuration.
///
/// Ranks are those of the scaled Φ_q (see [`Options::rank_tolerance`](crate::Options::rank_tolerance)).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Mobility {
    /// n.
    pub coordinates: usize,
    /// s, prescribed coordinates not counted.
    pub rows: usize,
    /// Driving rows: declared by `driver` or `speed`, or with t or an input in their own length, angle, offset or
    /// right-hand side.
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
    /// n − rank of the rows of position level: the degrees of freedom of the position that the initial configuration of
    /// a motion determines.
    pub position_degrees_of_freedom_left: usize,
    /// w: independent coordinates, δ of them, indices of q.
    pub independent: Vec<usize>,
    /// u: dependent coordinates.
    pub dependent: Vec<usize>,
    /// Rank of all rows at a general pose and for general dimensions, prescribed coordinates not counted; `None` if the
    /// model has no structural analysis.
    pub generic_rank: Option<usize>,
    /// δ at a general pose and for general dimensions: less than [`degrees_of_freedom`](Self::degrees_of_freedom) if
    /// special dimensions or this configuration allow more.
    pub generic_degrees_of_freedom: Option<usize>,
    /// Rows that others imply, those that do not drive first.
    pub redundant: Vec<RedundantRow>,
    /// Singular values of the scaled Φ_q, largest first.
    pub singular_values: Vec<f64>,
    /// Largest over smallest singular value within the rank.
    pub condition: f64,
    /// Coordinates that are not determined yet, each of which could be given.
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
        if let Some(generic) = self.generic_degrees_of_freedom.filter(|generic| *generic < self.degrees_of_freedom) {
            write!(f, "; {generic} in general")?;
        }
        for row in &self.redundant {
            write!(f, "; {row}")?;
        }
        Ok(())
    }
}

/// Weight of a column with an entry in a driving row, when dependent coordinates are chosen.
const DRIVEN: f64 = 1e-4;
/// Weight of an angle or scalar.
const ANGLE: f64 = 1e-2;
/// Coordinates whose components of null vectors are below this do not move.
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
    let could_be_given = (0..n).filter(|&k| free.ncols() > 0 && free.row(k).amax() > MOVES).collect();
    let mut redundant = redundant_rows(equations, tolerance);
    let structure = equations.model.structure;
    explain(equations, q, [(&passive, rank_without_driving), (&all, rank)], &mut redundant);
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
        generic_rank: structure.map(|s| s.rank),
        generic_degrees_of_freedom: structure.map(|s| n - s.rank_without_driving),
        redundant,
        singular_values,
        condition,
        could_be_given,
    })
}

/// The redundant rows, in the order in which the structure of a mechanism is analysed: passive rows before driving
/// ones, those of position level before those of velocity level, prescribed coordinates last.
fn redundant_rows(equations: &Equations<'_>, tolerance: f64) -> Vec<RedundantRow> {
    let declared = equations.model.rows.len();
    let mut order: Vec<usize> = (0..equations.rows()).collect();
    order.sort_by_key(|&row| (row >= declared, equations.drives(row), !equations.holonomic(row)));
    let found = dependencies(&equations.scaled(&order), tolerance);
    let in_q = |Dependency { row, combination }: Dependency| {
        let mut combination: Vec<_> = combination.into_iter().map(|(k, factor)| (order[k], factor)).collect();
        combination.sort_unstable_by_key(|(row, _)| *row);
        redundant(equations, Dependency { row: order[row], combination })
    };
    found.into_iter().map(in_q).collect()
}

/// Fills in why rows are redundant. Those that are redundant by structure are known; the others are so because of the
/// dimensions if they are redundant everywhere around `q`. Leaves `equations` evaluated at another configuration.
fn explain(
    equations: &mut Equations<'_>,
    q: &[f64],
    [passive, all]: [(&[usize], usize); 2],
    redundant: &mut [RedundantRow],
) {
    let Some(structure) = equations.model.structure else { return };
    let mut around = [None, None];
    for found in redundant {
        if structure.redundant.iter().any(|generic| generic.row == found.row) {
            found.cause = Some(Cause::Structure);
            continue;
        }
        let side = usize::from(equations.drives(found.row));
        let (rows, rank) = [passive, all][side];
        let usual = *around[side].get_or_insert_with(|| rank_nearby(equations, q, rank, rows));
        found.cause = Some(if usual > rank { Cause::Configuration } else { Cause::Dimensions });
    }
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
        if driving.iter().any(|&row| equations.entry(row, k) != 0.0) {
            weight *= DRIVEN;
        }
        if !equations.model.coordinates[k].kind.is_length() {
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

/// A dependency with names; consistent if position and velocity of the row agree with what the others imply.
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
    // A dependency with rows of velocity level implies nothing about positions.
    let of_position = equations.holonomic(row) && combination.iter().all(|&(other, _)| equations.holonomic(other));
    let consistent = (!of_position || agrees(&equations.phi, 1.0)) && agrees(&equations.phi_t, f64::MIN_POSITIVE);
    RedundantRow { row, name: equations.row_name(row), joint, circuit, consistent, cause: None }
}

/// `row B.y of joint B repeats C, A`.
impl RedundantRow {
    /// How it depends on the other joints, which are separated by `separator`.
    pub(crate) fn relation(&self, separator: &str) -> String {
        let (other_rows, cause) =
            (self.circuit.join(separator), self.cause.map_or_else(String::new, |cause| format!(" {cause}")));
        match (self.consistent, self.cause) {
            (true, _) => format!("repeats {other_rows}{cause}"),
            (false, None) => format!("contradicts {other_rows}"),
            // It is the dependence that has the cause; whether there is a contradiction, the dimensions decide.
            (false, Some(_)) => format!("contradicts {other_rows}; they are dependent{cause}"),
        }
    }
}

impl fmt::Display for RedundantRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "row `{}` of joint `{}` {}", self.name, self.joint, self.relation(", "))
    }
}
