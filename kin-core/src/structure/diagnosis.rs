//! The generic rank of Φ_q, and the rows that do not raise it.

use super::field::Draw;
use super::partials;
use super::place::Places;
use super::rank::{Elimination, Row};
use super::residue::Residues;
use super::turn::Turns;
use crate::system::KinematicSystem;
use core::fmt;

/// Draws that a redundant row has to survive.
pub(super) const DRAWS: [u64; 3] = [0x6b69_6e31, 0x6b69_6e32, 0x6b69_6e33];

/// A row that repeats, or contradicts, what other rows say: together they depend on one another at every pose and for
/// all dimensions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Redundancy {
    /// The row; of a circuit, the one declared last, where driving rows count as later than all others.
    pub row: usize,
    /// The other rows of the circuit, in order of declaration: without any of them the row would not be redundant.
    pub circuit: Vec<usize>,
}

/// What a mechanism can do, from its symbols alone.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Structure {
    /// n.
    pub coordinates: usize,
    /// Rows.
    pub rows: usize,
    /// Rank of all rows.
    pub rank: usize,
    /// Rank of the rows that do not drive.
    pub rank_without_driving: usize,
    /// Rank of the rows of position level that do not drive.
    pub rank_of_position: usize,
    /// Redundant rows: those that do not drive first, each in order of declaration.
    pub redundant: Vec<Redundancy>,
}

impl Structure {
    /// δ = n − rank of the rows that do not drive.
    pub fn degrees_of_freedom(&self) -> usize {
        self.coordinates - self.rank_without_driving
    }

    /// n − rank of all rows.
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

/// The structure of a system.
pub fn diagnose(system: &KinematicSystem) -> Structure {
    let first = at(system, Draw(DRAWS[0]));
    if first.redundant.is_empty() {
        return first;
    }
    // A draw can be unlucky, with a probability of about 1e-15; the best of some is not.
    let others = DRAWS[1..].iter().map(|seed| at(system, Draw(*seed)));
    others.fold(first, |best, other| if other.rank > best.rank { other } else { best })
}

/// Φ_q at a drawn pose, row by row.
pub(super) struct Drawn<'a> {
    system: &'a KinematicSystem,
    rows: Vec<Row>,
    /// Entries per column.
    weights: Vec<usize>,
}

impl<'a> Drawn<'a> {
    pub(super) fn new(system: &'a KinematicSystem, draw: Draw) -> Self {
        let set = &system.set;
        let turns = Turns::new(system, draw);
        let places = Places::new(system, &turns, draw);
        let mut residues = Residues::new(set, &turns, &places, draw);
        let rows: Vec<Row> = (0..set.rows.len()).map(|row| partials::row(system, &mut residues, row)).collect();
        let mut weights = vec![0; set.coordinates.len()];
        rows.iter().flatten().for_each(|(column, _)| weights[*column] += 1);
        Self { system, rows, weights }
    }

    /// Goes through the rows by ascending key, those of one key in order of declaration; `seen` is told every row with
    /// the rank so far. Gives the rows that add no rank.
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

    /// The rank of some rows.
    pub(super) fn rank_of(&self, rows: &[usize]) -> usize {
        let columns = self.weights.len();
        let mut elimination = Elimination::new(self.weights.clone());
        rows.iter().filter(|&&row| elimination.push(row, &self.rows[row], columns).is_ok()).count()
    }

    /// Driving rows come last here, so that it is they that are superfluous.
    pub(super) fn drivers_last(&self) -> impl Fn(usize) -> (bool, bool) + use<'_> {
        |row| (self.system.classes[row].driving, !self.system.classes[row].holonomic)
    }
}

/// The structure as one draw shows it.
fn at(system: &KinematicSystem, draw: Draw) -> Structure {
    let drawn = Drawn::new(system, draw);
    let (coordinates, rows) = (drawn.weights.len(), drawn.rows.len());
    let mut structure = Structure { coordinates, rows, ..Structure::default() };
    let redundant = drawn.redundant(drawn.drivers_last(), |row, rank| {
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
