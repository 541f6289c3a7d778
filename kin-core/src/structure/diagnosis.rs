//! The generic rank of Φ_q, and the rows that do not increase it.

use super::field::Draw;
use super::partials;
use super::place::RandomPositions;
use super::rank::{Elimination, Row};
use super::residue::Residues;
use super::turn::PoseTurns;
use crate::system::KinematicSystem;
use core::fmt;

/// Seeds of the random poses. If rows are redundant at the first pose, the pose with the largest rank is used.
pub(super) const POSE_SEEDS: [u64; 3] = [0x6b69_6e31, 0x6b69_6e32, 0x6b69_6e33];

/// A redundant row and its circuit: a minimal set of linearly dependent rows of Φ_q, dependent at every pose and for
/// all dimensions. The row repeats or contradicts the others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Redundancy {
    /// The row of the circuit that is declared last; driving rows count as later than all others.
    pub row: usize,
    /// The other rows of the circuit, in order of declaration; without any one of them the row would not be redundant.
    pub circuit: Vec<usize>,
}

/// The structural analysis of a mechanism, which depends on symbols and not on numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Structure {
    /// The number n of coordinates.
    pub coordinates: usize,
    /// The number of rows.
    pub rows: usize,
    /// The generic rank of all rows.
    pub rank: usize,
    /// The generic rank of the rows that are not driving.
    pub rank_without_driving: usize,
    /// The generic rank of the holonomic rows that are not driving.
    pub rank_of_position: usize,
    /// The redundant rows: first those that are not driving, each group in order of declaration.
    pub redundant: Vec<Redundancy>,
}

impl Structure {
    /// The degrees of freedom δ = n − rank of the rows that are not driving.
    pub fn degrees_of_freedom(&self) -> usize {
        self.coordinates - self.rank_without_driving
    }

    /// The degrees of freedom left by all rows, n − rank.
    pub fn degrees_of_freedom_left(&self) -> usize {
        self.coordinates - self.rank
    }
}

impl fmt::Display for Structure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} coordinates, {} rows, generic rank {}: {} degrees of freedom, {} left",
            self.coordinates,
            self.rows,
            self.rank,
            self.degrees_of_freedom(),
            self.degrees_of_freedom_left()
        )
    }
}

/// Analyses the structure of a system.
pub fn diagnose(system: &KinematicSystem) -> Structure {
    let first = at(system, Draw(POSE_SEEDS[0]));
    if first.redundant.is_empty() {
        return first;
    }
    // A single random pose may have a smaller rank than the generic one, with a probability of about 1e-15; the
    // largest rank of several poses is taken.
    let other_poses = POSE_SEEDS[1..].iter().map(|seed| at(system, Draw(*seed)));
    other_poses.fold(first, |best, other| if other.rank > best.rank { other } else { best })
}

/// Φ_q at a random pose, row by row.
pub(super) struct RandomJacobian<'a> {
    system: &'a KinematicSystem,
    rows: Vec<Row>,
    /// The number of entries per column.
    weights: Vec<usize>,
}

impl<'a> RandomJacobian<'a> {
    pub(super) fn new(system: &'a KinematicSystem, draw: Draw) -> Self {
        let set = &system.set;
        let turns = PoseTurns::new(system, draw);
        let places = RandomPositions::new(system, &turns, draw);
        let mut residues = Residues::new(set, &turns, &places, draw);
        let rows: Vec<Row> = (0..set.rows.len()).map(|row| partials::row(system, &mut residues, row)).collect();
        let mut weights = vec![0; set.coordinates.len()];
        rows.iter().flatten().for_each(|(column, _)| weights[*column] += 1);
        Self { system, rows, weights }
    }

    /// Eliminates the rows in order of ascending key, rows of equal key in order of declaration. After each row, `seen`
    /// is called with the row and the current rank. Returns the rows that do not increase the rank.
    pub(super) fn redundant<K: Ord>(
        &self,
        key: impl Fn(usize) -> K,
        mut seen: impl FnMut(usize, usize),
    ) -> Vec<Redundancy> {
        let columns = self.weights.len();
        let mut elimination = Elimination::new(self.weights.clone());
        let mut order: Vec<usize> = (0..self.rows.len()).collect();
        order.sort_by_key(|&row| key(row));
        let mut redundant = Vec::new();
        for row in order {
            if let Err(combination) = elimination.push(row, &self.rows[row], columns) {
                let circuit = combination.into_iter().map(|(row, _)| row).collect();
                redundant.push(Redundancy { row, circuit });
            }
            seen(row, elimination.rank());
        }
        redundant
    }

    /// The rank of some of the rows.
    pub(super) fn rank_of(&self, rows: &[usize]) -> usize {
        let columns = self.weights.len();
        let mut elimination = Elimination::new(self.weights.clone());
        rows.iter().filter(|&&row| elimination.push(row, &self.rows[row], columns).is_ok()).count()
    }

    /// A key by which driving rows come last, so that they are reported as redundant.
    pub(super) fn drivers_last(&self) -> impl Fn(usize) -> (bool, bool) + use<'_> {
        |row| (self.system.classes[row].driving, !self.system.classes[row].holonomic)
    }
}

/// The structure according to one random pose.
fn at(system: &KinematicSystem, draw: Draw) -> Structure {
    let jacobian = RandomJacobian::new(system, draw);
    let (coordinates, rows) = (jacobian.weights.len(), jacobian.rows.len());
    let mut structure = Structure { coordinates, rows, ..Structure::default() };
    let redundant = jacobian.redundant(jacobian.drivers_last(), |row, rank| {
        structure.rank = rank;
        let class = system.classes[row];
        if !class.driving {
            structure.rank_without_driving = rank;
            if class.holonomic {
                structure.rank_of_position = rank;
            }
        }
    });
    Structure { redundant, ..structure }
}
