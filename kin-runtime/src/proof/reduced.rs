//! Elimination of coordinates that occur in rows with constant factors.
//!
//! The x and y of bodies occur in the rows of pins with factors ±1. In sums and differences of rows they cancel
//! exactly. The resulting equations contain only other coordinates, mostly angles: they are the closure equations of
//! loops. The remaining rows determine x and y afterwards.

use super::krawczyk::Square;
use crate::scalar::Interval;
use nalgebra::DMatrix;

/// The largest factor of a row: sums of integers up to this size are exact.
const LARGEST: f64 = 1_048_576.0;

/// A sum of rows with integer factors.
type Sum = Vec<(usize, f64)>;

/// The rows of a mechanism, reduced.
pub(super) struct Reduced {
    /// The sums of rows that do not depend on eliminated coordinates.
    equations: Vec<Sum>,
    /// The eliminated coordinates, each with the sum of rows that determines it and its factor in that sum.
    taken: Vec<(usize, Sum, f64)>,
    /// The remaining coordinates.
    pub(super) left: Vec<usize>,
}

impl Reduced {
    /// Eliminates every coordinate whose entries are all literal integers.
    pub(super) fn new(square: &Square) -> Self {
        let n = square.coordinates();
        let mut constant = vec![true; n];
        let mut matrix = DMatrix::<f64>::zeros(n, n);
        for (&(row, column), value) in square.entries().iter().zip(square.constants()) {
            match value.filter(|value| value.fract() == 0.0 && value.abs() <= LARGEST) {
                Some(value) => matrix[(row, column)] += value,
                None => constant[column] = false,
            }
        }
        // Row k of this matrix says of which rows the reduced row k is the sum.
        let mut sums = DMatrix::<f64>::identity(n, n);
        let (mut free, mut taken) = ((0..n).collect::<Vec<usize>>(), Vec::new());
        for column in (0..n).filter(|&column| constant[column]) {
            let Some(at) = free.iter().position(|&row| matrix[(row, column)].abs() == 1.0) else { continue };
            let pivot = free[at];
            let factors: Vec<f64> = (0..n).map(|row| matrix[(row, column)] / matrix[(pivot, column)]).collect();
            let (mut reduced, mut added) = (matrix.clone(), sums.clone());
            for row in (0..n).filter(|&row| row != pivot && factors[row] != 0.0) {
                for k in 0..n {
                    reduced[(row, k)] -= factors[row] * matrix[(pivot, k)];
                    added[(row, k)] -= factors[row] * sums[(pivot, k)];
                }
            }
            if reduced.iter().chain(added.iter()).any(|factor| factor.abs() > LARGEST) {
                continue;
            }
            (matrix, sums) = (reduced, added);
            free.remove(at);
            taken.push((column, pivot));
        }
        let sum =
            |row: usize| (0..n).map(|k| (k, sums[(row, k)])).filter(|(_, factor)| *factor != 0.0).collect::<Sum>();
        let left = (0..n).filter(|column| taken.iter().all(|(of, _)| of != column)).collect();
        let equations = free.iter().map(|&row| sum(row)).collect();
        let taken = taken.iter().map(|&(column, row)| (column, sum(row), matrix[(row, column)])).collect();
        Self { equations, taken, left }
    }

    /// The reduced equations' values, given those of the rows.
    pub(super) fn values(&self, rows: &[Interval]) -> Vec<Interval> {
        self.equations.iter().map(|sum| total(sum, rows)).collect()
    }

    /// The derivatives of the reduced equations by the remaining coordinates, row by row, given the entries of the
    /// rows.
    pub(super) fn jacobian(&self, square: &Square, entries: &[Interval]) -> Vec<Vec<Interval>> {
        let n = square.coordinates();
        let mut dense = vec![Interval::from(0.0); n * n];
        for (&(row, column), &entry) in square.entries().iter().zip(entries) {
            dense[column * n + row] = dense[column * n + row] + entry;
        }
        let of = |sum: &Sum| self.left.iter().map(|&column| total(sum, &dense[column * n..][..n])).collect();
        self.equations.iter().map(of).collect()
    }

    /// Writes the eliminated coordinates, given the values of the rows with these coordinates at 0.
    pub(super) fn complete(&self, rows: &[Interval], q: &mut [Interval]) {
        for (column, sum, factor) in &self.taken {
            q[*column] = -(total(sum, rows) / Interval::from(*factor));
        }
    }
}

fn total(sum: &Sum, rows: &[Interval]) -> Interval {
    let term = |&(row, factor): &(usize, f64)| match factor {
        1.0 => rows[row],
        -1.0 => -rows[row],
        _ => Interval::from(factor) * rows[row],
    };
    sum.iter().map(term).fold(Interval::from(0.0), |sum, term| sum + term)
}
